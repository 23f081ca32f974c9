#pragma once

#include <string>
#include <vector>

namespace vicon::report {

/// At least one part; "a^^b" has three.
inline std::vector<std::string> split(const std::string& text, char at)
{
    std::vector<std::string> parts;
    for (std::size_t from = 0;;) {
        const std::size_t to = text.find(at, from);
        parts.push_back(text.substr(from, to == text.npos ? to : to - from));
        if (to == text.npos)
            return parts;
        from = to + 1;
    }
}

}  // namespace vicon::report
