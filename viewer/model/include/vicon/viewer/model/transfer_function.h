#pragma once

#include <string>
#include <vector>

namespace vicon::viewer {

/// Colour and opacity of a density, for looking below the mucosa.
struct TransferPoint {
    double density_hu = 0;
    double red = 0, green = 0, blue = 0;  ///< 0 to 1
    double opacity_per_mm = 0;            ///< 0 to 1: part of the light that one millimetre stops
};

/// A named transfer function; values between its points are linear, outside they stay.
struct TransferFunction {
    std::string name;
    std::string title;
    std::vector<TransferPoint> points;  ///< by density, at least two

    TransferPoint at(double density_hu) const;
};

/// The presets of config/transfer_functions.toml, in its order.
const std::vector<TransferFunction>& transferFunctions();

/// The preset of that name. Throws Error{wrong_use} naming those there are.
const TransferFunction& transferFunction(const std::string& name);

}  // namespace vicon::viewer
