#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "presets_data.h"
#include "vicon/core/error.h"
#include "vicon/core/quantity.h"
#include "vicon/viewer/model/transfer_function.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {
namespace {

// The files are part of the program: what is wrong in them is found by the tests, at the first use.
double number(const toml::node_view<const toml::node>& node)
{
    return node.value<double>().value();
}

template <class Preset, class Read>
std::vector<Preset> presetsOf(std::string_view text, const char* table, Read read)
{
    const toml::table file = toml::parse(text);
    std::vector<Preset> presets;
    for (const toml::node& entry : *file[table].as_array())
        presets.push_back(read(*entry.as_table()));
    return presets;
}

template <class Preset>
const Preset& named(const std::vector<Preset>& presets, const std::string& name, const std::string& kind)
{
    std::string names;
    for (const Preset& preset : presets) {
        if (preset.name == name)
            return preset;
        names += (names.empty() ? "" : ", ") + preset.name;
    }
    throw Error(ErrorCode::wrong_use, "there is no " + kind + " of this name", "'" + name + "'", "use one of " + names);
}

struct OfferedWindow : WindowLevel {
    std::vector<std::string> organs;  // empty: all
    std::vector<std::string> default_for;
};

std::vector<std::string> names(const toml::node_view<const toml::node>& node)
{
    std::vector<std::string> all;
    if (const toml::array* entries = node.as_array())
        for (const toml::node& entry : *entries)
            all.push_back(entry.value<std::string>().value());
    return all;
}

OfferedWindow windowFrom(const toml::table& entry)
{
    return {{entry["name"].value<std::string>().value(), number(entry["width_hu"]), number(entry["level_hu"])},
            names(entry["organs"]),
            names(entry["default_for"])};
}

const std::vector<OfferedWindow>& allWindows()
{
    static const auto presets = presetsOf<OfferedWindow>(kWindowsToml, "window", windowFrom);
    return presets;
}

bool has(const std::vector<std::string>& all, const std::string& one)
{
    return std::find(all.begin(), all.end(), one) != all.end();
}

TransferFunction transferFunctionFrom(const toml::table& entry)
{
    TransferFunction function{
        entry["name"].value<std::string>().value(), entry["title"].value<std::string>().value(), {}};
    for (const toml::node& point : *entry["points"].as_array()) {
        const toml::node_view<const toml::node> p(point);
        function.points.push_back({number(p[0]), number(p[1]), number(p[2]), number(p[3]), number(p[4])});
    }
    return function;
}

}  // namespace

std::uint8_t WindowLevel::greyOf(double density_hu) const
{
    const double share = (density_hu - level_hu) / width_hu + 0.5;
    return std::uint8_t(std::lround(std::clamp(share, 0.0, 1.0) * 255));
}

std::string WindowLevel::words() const
{
    return std::to_string(std::lround(width_hu)) + " / " + std::to_string(std::lround(level_hu)) + " " + unit;
}

std::vector<WindowLevel> signalWindows(double lumen, double tissue)
{
    const char* const unit = unitOf(Quantity::signal);
    const double brightest = std::max({1.1 * lumen, 2.2 * tissue, 1.0}),
                 apart = std::max(1.0, std::abs(lumen - tissue));
    return {{"whole", brightest, brightest / 2, unit},
            {"wall", 1.4 * apart, (lumen + tissue) / 2, unit},
            {"tissue", std::max(1.0, tissue), tissue, unit}};
}

std::vector<WindowLevel> windowPresets(const std::string& organ)
{
    std::vector<WindowLevel> offered;
    for (const OfferedWindow& window : allWindows())
        if (window.organs.empty() || has(window.organs, organ))
            offered.insert(has(window.default_for, organ) ? offered.begin() : offered.end(), window);
    return offered;
}

WindowLevel windowPreset(const std::string& name)
{
    return named(allWindows(), name, "window preset");
}

TransferPoint TransferFunction::at(double density_hu) const
{
    const auto after = std::upper_bound(points.begin(), points.end(), density_hu,
                                        [](double d, const TransferPoint& p) { return d < p.density_hu; });
    if (after == points.begin())
        return points.front();
    if (after == points.end())
        return points.back();
    const TransferPoint &a = *(after - 1), &b = *after;
    const double t = (density_hu - a.density_hu) / (b.density_hu - a.density_hu);
    return {density_hu, std::lerp(a.red, b.red, t), std::lerp(a.green, b.green, t), std::lerp(a.blue, b.blue, t),
            std::lerp(a.opacity_per_mm, b.opacity_per_mm, t)};
}

const std::vector<TransferFunction>& transferFunctions()
{
    static const auto presets =
        presetsOf<TransferFunction>(kTransferFunctionsToml, "transfer_function", transferFunctionFrom);
    return presets;
}

const TransferFunction& transferFunction(const std::string& name)
{
    return named(transferFunctions(), name, "transfer function");
}

}  // namespace vicon::viewer
