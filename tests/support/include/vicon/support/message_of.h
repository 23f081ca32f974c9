#pragma once

#include <functional>
#include <string>

#include "vicon/core/error.h"

namespace vicon::support {

/// What the Error that an action throws says; empty where it throws none.
inline std::string messageOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& e) {
        return e.what();
    }
    return {};
}

}  // namespace vicon::support
