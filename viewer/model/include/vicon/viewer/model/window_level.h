#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vicon::viewer {

/// Which densities a grey picture spreads between black and white.
struct WindowLevel {
    std::string name = "colon";
    double width_hu = 1500;
    double level_hu = -200;

    /// 0 at level - width/2 and below, 255 at level + width/2 and above.
    std::uint8_t greyOf(double density_hu) const;
};

/// The presets of config/windows.toml that are offered for an organ, its default first, the others in the file's order.
std::vector<WindowLevel> windowPresets(const std::string& organ);

/// The preset of that name, whichever organ it is offered for. Throws Error{wrong_use} naming those there are.
WindowLevel windowPreset(const std::string& name);

}  // namespace vicon::viewer
