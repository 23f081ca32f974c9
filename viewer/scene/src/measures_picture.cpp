#include "vicon/viewer/scene/measures_picture.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "pictures.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {
namespace {

constexpr Rgb kGround{10, 12, 16}, kBarColor{120, 190, 250}, kAxisColor{150, 150, 150}, kMeanColor{255, 214, 102};
constexpr double kLeastSpan_hu = 300;   // of the histogram's axis
constexpr double kFieldOfDiameter = 3;  // what the plane's picture shows around the finding
constexpr double kLeastField_mm = 40;
constexpr const char* kWindow = "soft-tissue";

struct Landmark {
    double from_hu, to_hu;
    const char* name;
};
/// Where readers look: soft tissue without contrast, and what fat and tagged stool have.
constexpr std::array<Landmark, 3> kLandmarks = {{{-200, -30, "fat"}, {0, 100, "tissue"}, {200, 3000, "tagged"}}};

std::string text(const char* pattern, double value)
{
    std::array<char, 48> words{};
    std::snprintf(words.data(), words.size(), pattern, value);
    return words.data();
}

OverlayText writtenAt(Pixel at, const std::string& what, double height_px, Rgb color, Across across, Along along)
{
    OverlayText made;
    made.at = at;
    made.text = what;
    made.height_px = height_px;
    made.color = color;
    made.across = across;
    made.along = along;
    return made;
}

/// The histogram's place in its picture, and which densities it spans.
struct Axes {
    Area area;
    double from_hu, to_hu, most;

    double x(double hu) const { return area.x + area.width * (hu - from_hu) / (to_hu - from_hu); }
    double y(double count) const { return area.bottom() - area.height * count / most; }
};

Axes axesFor(const DensitySample& sample, int width, int height, double text_px)
{
    const double first = sample.from_hu, last = first + DensitySample::kBin_hu * double(sample.counts.size());
    const double spare = std::max(kLeastSpan_hu - (last - first), 0.0) / 2;
    Axes axes{{2 * text_px, 4.6 * text_px, width - 4 * text_px, height - 8.2 * text_px},
              first - spare,
              last + spare,
              double(*std::max_element(sample.counts.begin(), sample.counts.end()))};
    return axes;
}

void addBars(Overlay& overlay, const DensitySample& sample, const Axes& axes)
{
    const double bar_px = std::max(1.0, axes.x(DensitySample::kBin_hu) - axes.x(0) - 1);
    for (std::size_t n = 0; n < sample.counts.size(); ++n) {
        if (sample.counts[n] == 0)
            continue;
        const double x = axes.x(sample.from_hu + DensitySample::kBin_hu * (double(n) + 0.5));
        // Its ends are round, and end at the axis and at the count.
        const double top = axes.y(double(sample.counts[n])), wide = std::min(bar_px, axes.area.bottom() - top);
        overlay.lines.push_back({{{x, axes.area.bottom() - wide / 2}, {x, top + wide / 2}}, kBarColor, wide, 0});
    }
}

void addAxis(Overlay& overlay, const Axes& axes, double text_px)
{
    const double below = axes.area.bottom();
    overlay.lines.push_back({{{axes.area.x, below}, {axes.area.right(), below}}, kAxisColor, 1.5, 0});
    constexpr std::array<double, 5> kSteps = {50, 100, 200, 500, 1000};
    double step = kSteps.back();
    for (const double s : kSteps)
        if ((axes.to_hu - axes.from_hu) / s <= 6) {
            step = s;
            break;
        }
    for (double hu = std::ceil(axes.from_hu / step) * step; hu <= axes.to_hu; hu += step) {
        overlay.lines.push_back({{{axes.x(hu), below}, {axes.x(hu), below + 0.4 * text_px}}, kAxisColor, 1.5, 0});
        overlay.texts.push_back(writtenAt({axes.x(hu), below + 0.5 * text_px}, text("%.0f", hu), 0.9 * text_px,
                                          kTextColor, Across::centre, Along::top));
    }
    for (const Landmark& mark : kLandmarks) {
        const double from = std::max(mark.from_hu, axes.from_hu), to = std::min(mark.to_hu, axes.to_hu);
        if (axes.x(to) - axes.x(from) < 3 * text_px)
            continue;
        const double y = below + 2.1 * text_px;
        overlay.lines.push_back({{{axes.x(from) + 2, y}, {axes.x(to) - 2, y}}, kAxisColor, 2, 0});
        overlay.texts.push_back(writtenAt({(axes.x(from) + axes.x(to)) / 2, y + 0.2 * text_px}, mark.name,
                                          0.9 * text_px, kTextColor, Across::centre, Along::top));
    }
}

}  // namespace

Picture histogramPicture(const DensitySample& sample, int width, int height, double pixel_ratio)
{
    Picture picture(width, height, kGround);
    if (sample.voxels == 0 || sample.counts.empty())
        return picture;
    const double text_px = textHeightFor(width, height, pixel_ratio) * 1.15;
    const Axes axes = axesFor(sample, width, height, text_px);
    Overlay overlay;
    addBars(overlay, sample, axes);
    addAxis(overlay, axes, text_px);
    const double mean = axes.x(sample.mean_hu);
    overlay.lines.push_back({{{mean, axes.area.y}, {mean, axes.area.bottom()}}, kMeanColor, 2, 4});
    OverlayText line;
    line.color = kMeanColor;
    line.text = text("%.0f", sample.mean_hu) + text(" \u00b1 %.0f HU", sample.sd_hu);
    std::vector<OverlayText> lines{line};
    line.color = kTextColor;
    line.text = std::to_string(sample.voxels) + " voxels within " + text("%.1f mm, ", sample.radius_mm) +
                text("%.1f mm off the lumen", sample.margin_mm);
    lines.push_back(line);
    line.text = text("%.0f %% of fat attenuation", 100 * sample.fat_fraction);
    lines.push_back(line);
    addLines(overlay, {0, 0, double(width), double(height)}, lines, text_px);
    paint(picture, overlay);
    return picture;
}

Picture planePicture(const PreparedScan& scan, const PlaneSize& size, const Caption& caption, int width, int height,
                     double pixel_ratio, const Progress* wanted)
{
    const PlaneView view = viewOf(size, width, height, std::max(kLeastField_mm, kFieldOfDiameter * size.diameter_mm));
    const WindowLevel window = scan.quantity() == Quantity::signal ? scan.windows().front() : windowPreset(kWindow);
    Picture picture(width, height);
    const auto densities = sliceDensities(scan.volume(), view, wanted);
    for (std::size_t n = 0; n < densities.size(); ++n)
        std::fill_n(picture.rgb.begin() + std::ptrdiff_t(3 * n), 3, window.greyOf(densities[n]));
    Overlay overlay;
    const Area area{0, 0, double(width), double(height)};
    const double text_px = textHeightFor(width, height, pixel_ratio) * 1.15;
    const Pixel from = view.toPixel(size.from_mm), to = view.toPixel(size.to_mm);
    overlay.lines.push_back({{from, to}, kMeanColor, 2, 4});
    for (const Pixel& end : {from, to})
        overlay.discs.push_back({end, 0.25 * text_px, kMeanColor, 0});
    addLetters(overlay, area, view.right, view.down, text_px);
    addScaleBar(overlay, area, view.mm_per_pixel, text_px);
    OverlayText line;
    line.color = kMeanColor;
    line.text = text("%.1f mm", size.diameter_mm) + " in the best plane";
    std::vector<OverlayText> lines{line};
    for (OverlayText& of : patientLines(caption))
        lines.push_back(of);
    addLines(overlay, {0, 0, area.width * 0.46, area.height}, lines, text_px);
    paint(picture, overlay);
    return picture;
}

std::optional<Picture> measuresPicture(const PreparedScan& scan, const Marker& marker, const Caption& caption, int side,
                                       double pixel_ratio, const Progress* wanted)
{
    std::vector<Picture> parts;
    if (marker.size && marker.size->plane)
        parts.push_back(planePicture(scan, *marker.size->plane, caption, side, side, pixel_ratio, wanted));
    if (marker.density && marker.density->voxels > 0)
        parts.push_back(histogramPicture(*marker.density, side, side, pixel_ratio));
    if (parts.empty())
        return std::nullopt;
    Picture all(side * int(parts.size()), side);
    for (std::size_t n = 0; n < parts.size(); ++n)
        copyInto(all, parts[n], int(n) * side, 0);
    return all;
}

}  // namespace vicon::viewer
