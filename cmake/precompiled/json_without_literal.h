// nlohmann's JSON, but for its literal "..."_json, of which only the declaration stays. Its body is inline and no
// template, so that every file which reads the header, precompiled or not, instantiates the whole parser: 0.7 s of
// processor time each. Here it becomes that of a template that nobody asks for.
#pragma once
#define _json(...)      \
    _json(__VA_ARGS__); \
    template <class>    \
    nlohmann::json unusedJsonLiteral(__VA_ARGS__)
#include <nlohmann/json.hpp>
#undef _json
