// Nothing but what carries the precompiled headers that rooms share.
