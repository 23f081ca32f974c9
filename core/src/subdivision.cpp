#include "vicon/core/subdivision.h"

#include <algorithm>

#include "vicon/core/error.h"

namespace vicon {
namespace {

constexpr const char* kUndivided = "none";

}  // namespace

std::string nameOf(const std::optional<SubdivideMethod>& method)
{
    return method ? nameIn(kSubdivideMethodNames, *method) : kUndivided;
}

std::optional<SubdivideMethod> subdivideMethodFrom(const std::string& name)
{
    if (name == kUndivided)
        return {};
    for (const auto& [method, known] : kSubdivideMethodNames)
        if (name == known)
            return method;
    throw Error(ErrorCode::bad_input, "a lumen is not divided so", "'" + name + "'");
}

}  // namespace vicon
