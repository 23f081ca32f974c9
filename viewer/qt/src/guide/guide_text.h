#pragma once

#include <vector>

namespace vicon::viewer {

/// A page of docs/user, of the build.
struct GuidePage {
    const char* file;  ///< its name, which other pages lead to
    const char* text;  ///< Markdown; its first heading is its title
};

/// In the order of reading, the first case first.
const std::vector<GuidePage>& guidePages();

}  // namespace vicon::viewer
