#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vicon::viewer {

/// Which densities a grey picture spreads between black and white; of MR which signal, in its own unit.
struct WindowLevel {
    std::string name = "colon";
    double width_hu = 1500;
    double level_hu = -200;
    std::string unit = "HU";

    /// "1500 / -200 HU".
    std::string words() const;

    /// 0 at level - width/2 and below, 255 at level + width/2 and above.
    std::uint8_t greyOf(double density_hu) const;
};

/// The presets of config/windows.toml that are offered for an organ, its default first, the others in the file's order.
std::vector<WindowLevel> windowPresets(const std::string& organ);

/// Of a scan of MR signal, by what its lumen and its tissue give: "whole", "wall" and "tissue", the default first.
std::vector<WindowLevel> signalWindows(double lumen, double tissue);

/// The preset of that name, whichever organ it is offered for. Throws Error{wrong_use} naming those there are.
WindowLevel windowPreset(const std::string& name);

}  // namespace vicon::viewer
