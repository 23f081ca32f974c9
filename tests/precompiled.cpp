// Nothing but what carries the precompiled headers of the tests.
