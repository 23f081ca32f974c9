#pragma once

#include <string>

namespace vicon::viewer {

/// What the wall is coloured by in the view from inside.
enum class WallColors {
    mucosa,  ///< as an endoscopist sees it
    bone,    ///< white, which shows the shape alone
    depth,   ///< from near, warm and bright, to far, blue
};

/// "mucosa", "bone" or "depth".
std::string nameOf(WallColors colors);
/// Throws Error{wrong_use} for any other name.
WallColors wallColorsFrom(const std::string& name);

/// How the wall looks. Each reader has a taste; none of it changes the surface.
struct WallLook {
    WallColors colors = WallColors::mucosa;
    bool ambient_occlusion = true;  ///< less light where the wall is less open, see opennessOf()
    bool tagging = false;           ///< blue where tagging touches the wall, see taggingOf()
    /// As acquired: from where the densities leave gas, tagged fluid and stool standing. Else the surface, cleansed.
    bool acquired = false;
    friend bool operator==(const WallLook&, const WallLook&) = default;
};

}  // namespace vicon::viewer
