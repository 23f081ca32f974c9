#include "vicon/viewer/model/hanging.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace vicon::viewer {
namespace {

constexpr double kLeastWidth_hu = 1, kMostHu = 10000, kMostThick_mm = 50;

/// A number that is there and in its range. Throws nlohmann::json::exception or std::out_of_range.
double number(const nlohmann::json& json, const char* key, double least, double most)
{
    const double value = json.at(key).get<double>();
    if (!(value >= least && value <= most))
        throw std::out_of_range(key);
    return value;
}

template <class Choice>
Choice choice(const nlohmann::json& json, const char* key, Choice last)
{
    return Choice(int(number(json, key, 0, double(last))));
}

}  // namespace

std::array<Hanging, kHangings> usualHangings()
{
    std::array<Hanging, kHangings> all;
    for (std::size_t n = 0; n < kHangings; ++n) {
        all[n].layout = ViewLayout(n);
        all[n].slices.window.name.clear();
        all[n].slices.tracks = all[n].layout == ViewLayout::two_d_first;
    }
    return all;
}

std::string nameOf(ViewLayout layout)
{
    switch (layout) {
        case ViewLayout::three_d_first:
            return "3D first";
        case ViewLayout::two_d_first:
            return "2D first";
        case ViewLayout::both_scans:
            return "supine and prone";
        default:
            return "three planes";
    }
}

std::string toText(const Hanging& hanging)
{
    const WindowLevel& window = hanging.slices.window;
    return nlohmann::json{{"layout", int(hanging.layout)},
                          {"plane", int(hanging.plane)},
                          {"window", window.name},
                          {"width_hu", window.width_hu},
                          {"level_hu", window.level_hu},
                          {"unit", window.unit},
                          {"of", int(hanging.slices.thick.kind)},
                          {"thickness_mm", hanging.slices.thick.thickness_mm},
                          {"tracks", hanging.slices.tracks}}
        .dump();
}

Hanging hangingFrom(const std::string& text, const Hanging& otherwise)
{
    try {
        const auto json = nlohmann::json::parse(text);
        Hanging read;
        read.layout = choice(json, "layout", ViewLayout::planes);
        read.plane = choice(json, "plane", SlicePlane::across);
        read.slices.window = {json.at("window").get<std::string>(), number(json, "width_hu", kLeastWidth_hu, kMostHu),
                              number(json, "level_hu", -kMostHu, kMostHu), json.value("unit", "HU")};
        read.slices.thick = {choice(json, "of", ThickSlice::Kind::minimum),
                             number(json, "thickness_mm", 0, kMostThick_mm)};
        read.slices.tracks = json.at("tracks").get<bool>();
        return read;
    } catch (const nlohmann::json::exception&) {
        return otherwise;
    } catch (const std::out_of_range&) {
        return otherwise;
    }
}

}  // namespace vicon::viewer
