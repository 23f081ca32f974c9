#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pictures.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {
namespace {

// In a window the projection is small, its words are not.
double captionHeight(const SnapshotRequest& request)
{
    constexpr double kLeast_px = 11;
    if (request.text_px > 0)
        return request.text_px;
    return std::max(0.8 * textHeightFor(request.width, request.height, request.pixel_ratio),
                    kLeast_px * request.pixel_ratio);
}

double wordsHeight(const SnapshotRequest& request)
{
    constexpr double kLeast_px = 12;
    if (request.text_px > 0)
        return request.text_px;
    return std::max(textHeightFor(request.width, request.height, request.pixel_ratio), kLeast_px * request.pixel_ratio);
}

constexpr double kMostCaptionShare = 0.47;  // of the width

/// What the caption takes of a corner, wherever the eye is.
TextSize captionSize(const PreparedScan& scan, const SnapshotRequest& request)
{
    if (!request.captioned)
        return {};
    const double text_px = textHeightFor(request.width, request.height, request.pixel_ratio),
                 line_px = captionHeight(request);
    const double length_mm = scan.frames().length_mm();
    auto lines = captionLines(request.caption, length_mm, length_mm, scan.words());
    TextSize size{0, double(lines.size()) * 1.35 * line_px + 0.48 * text_px};
    for (OverlayText& line : lines) {
        line.height_px = line_px;
        size.width_px = std::max(size.width_px, textSize(line).width_px + line_px);
    }
    size.width_px = std::min(size.width_px, kMostCaptionShare * request.width);
    return size;
}

/// The whole projection below the caption or, where it is drawn larger so, beside it; with a margin for letters.
PlaneView viewOfAll(const Projection& projection, int width, int height, const TextSize& caption, double margin_px)
{
    const double across_mm = projection.width * projection.pixel_mm, down_mm = projection.height * projection.pixel_mm;
    const auto mmPerPixel = [&](double left_px, double top_px) {
        return std::max(across_mm / (width - 2 * margin_px - left_px), down_mm / (height - 2 * margin_px - top_px));
    };
    const bool beside = mmPerPixel(caption.width_px, 0) < mmPerPixel(0, caption.height_px);
    const double least = beside ? mmPerPixel(caption.width_px, 0) : mmPerPixel(0, caption.height_px);
    PlaneView view{{}, projection.right, projection.down, least, width, height};
    const double to_caption_px = (width - across_mm / least) / 2 - margin_px;  // where it lies in the middle
    const double right_px = beside ? std::max(0.0, caption.width_px - to_caption_px) : 0;
    const double down_px = beside ? 0 : caption.height_px / 2;
    view.centre_mm = projection.first_pixel_mm +
                     view.right * ((across_mm - projection.pixel_mm) / 2 - right_px * view.mm_per_pixel) +
                     view.down * ((down_mm - projection.pixel_mm) / 2 - down_px * view.mm_per_pixel);
    return view;
}

using Ink = std::array<double, 4>;  ///< colour times opacity, and opacity

// Between four pixels; beyond the border there is nothing.
Ink inkAt(const Projection& from, double column, double row)
{
    const int x = int(std::floor(column)), y = int(std::floor(row));
    Ink ink{};
    for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const double weight = std::abs(1 - dx - (column - x)) * std::abs(1 - dy - (row - y));
        if (x + dx < 0 || y + dy < 0 || x + dx >= from.width || y + dy >= from.height)
            continue;
        const auto* p = &from.rgba[4 * (std::size_t(y + dy) * std::size_t(from.width) + std::size_t(x + dx))];
        const double opacity = weight * p[3] / 255.0;
        for (std::size_t c = 0; c < 3; ++c)
            ink[c] += opacity * p[c];
        ink[3] += opacity;
    }
    return ink;
}

// The mean of a few places in each pixel, so that a small picture of a large projection is smooth.
Picture drawn(const Projection& from, const PlaneView& view, const Progress* wanted)
{
    constexpr Rgb kGround{10, 13, 18};
    const double step = view.mm_per_pixel / from.pixel_mm;  // projection's pixels in a pixel
    const int finer = std::clamp(int(std::ceil(step)), 1, 8);
    const Point3 corner = view.pointAt({0, 0});
    const double left = from.column(corner), top = from.row(corner);
    Picture picture(view.width, view.height);
    tbb::parallel_for(0, view.height, [&](int y) {
        if (wanted)
            wanted->check();
        for (int x = 0; x < view.width; ++x) {
            Ink sum{};
            for (int part = 0; part < finer * finer; ++part) {
                const int across = part % finer, down = part / finer;
                const Ink ink =
                    inkAt(from, left + step * (x + (across + 0.5) / finer), top + step * (y + (down + 0.5) / finer));
                for (std::size_t c = 0; c < 4; ++c)
                    sum[c] += ink[c] / (finer * finer);
            }
            const auto mixed = [&](std::size_t c, double ground) {
                return std::uint8_t(std::lround(std::min(255.0, sum[c] + (1 - sum[3]) * ground)));
            };
            picture.set(x, y, {mixed(0, kGround.red), mixed(1, kGround.green), mixed(2, kGround.blue)});
        }
    });
    return picture;
}

/// Where in a picture names are written already.
class Names {
public:
    Names(std::vector<Area> taken, const Overlay& overlay, const PlaneView& view)
        : picture_{0, 0, double(view.width), double(view.height)}, taken_(std::move(taken))
    {
        const std::vector<Area> written = textAreas(overlay);
        taken_.insert(taken_.end(), written.begin(), written.end());
    }

    /// Above, below, on the right or on the left of a place; false where there is no room.
    bool write(Overlay& overlay, OverlayText text, Pixel at, double aside_px, double above_px = 0)
    {
        for (const auto& [across, along] : {std::pair{Across::centre, Along::bottom},
                                            {Across::centre, Along::top},
                                            {Across::left, Along::middle},
                                            {Across::right, Along::middle}}) {
            text.across = across;
            text.along = along;
            const double by = across == Across::left ? aside_px : across == Across::right ? -aside_px : 0;
            const double up = along == Along::bottom ? above_px : along == Along::top ? -above_px : 0;
            text.at = {at.x + by, at.y - up};
            if (write(overlay, text))
                return true;
        }
        return false;
    }
    /// Where it is; false where there is no room.
    bool write(Overlay& overlay, const OverlayText& text)
    {
        const Area area = textArea(text);
        if (!free(area))
            return false;
        taken_.push_back(area);
        overlay.texts.push_back(text);
        return true;
    }

private:
    bool free(const Area& area) const
    {
        const bool inside =
            area.x >= 0 && area.y >= 0 && area.right() <= picture_.right() && area.bottom() <= picture_.bottom();
        return inside && std::none_of(taken_.begin(), taken_.end(), [&](const Area& other) {
                   return area.x < other.right() && other.x < area.right() && area.y < other.bottom() &&
                          other.y < area.bottom();
               });
    }

    Area picture_;
    std::vector<Area> taken_;
};

/// The parts between rectum and caecum, whose names stand at the tips: a dot where one begins, and the name at its
/// middle, or as near to it as other names leave room; where none is left it is not written.
void addParts(Overlay& overlay, const ColonPartRanges& parts, const Skeleton& skeleton, const PlaneView& view,
              double text_px)
{
    Names names({}, overlay, view);
    for (const ColonPartRange& range : parts) {
        if (range.part != ColonPart::rectum)
            overlay.discs.push_back(
                {view.toPixel(skeleton.at(range.from_mm).position_mm), 0.2 * text_px, kPathColor, 0});
        if (range.part == ColonPart::rectum || range.part == ColonPart::caecum)
            continue;
        const OverlayText name{{}, nameOf(range.part), 0.9 * text_px, kPathColor};
        for (const double along : {0.5, 0.35, 0.65, 0.2, 0.8}) {
            const double station = std::lerp(range.from_mm, range.to_mm, along);
            if (names.write(overlay, name, view.toPixel(skeleton.at(station).position_mm), 0.5 * text_px))
                break;
        }
    }
}

void addMarkers(Overlay& overlay, const std::vector<Marker>& markers, const PlaneView& view, double text_px)
{
    for (const Marker& marker : markers)
        overlay.discs.push_back({view.toPixel(marker.position_mm), 0.38 * text_px, colorOf(marker.color), 0});
}

/// Below the markers; their names where there is room.
void addPriors(Overlay& overlay, const SnapshotRequest& request, const OverviewGround& ground, double text_px)
{
    std::vector<Area> taken = ground.names;
    for (const Marker& marker : request.markers) {
        const Pixel at = ground.view.toPixel(marker.position_mm);
        taken.push_back({at.x - text_px / 2, at.y - text_px / 2, text_px, text_px});
    }
    for (const PriorPlace& place : request.priors)
        addPriorBand(overlay, ground.view, place, text_px);
    Names names(std::move(taken), overlay, ground.view);
    for (const PriorPlace& place : request.priors) {
        const OverlayText name{{}, place.label, 0.9 * text_px, place.color};
        for (const double away : {0.7, 1.8, 2.9, 4.0})  // in heights of the text
            if (names.write(overlay, name, ground.view.toPixel(place.position_mm), away * text_px, away * text_px))
                break;
    }
}

/// Beside their discs; where other names stand there, above, below or on the other side.
void addMarkerNames(Overlay& overlay, const std::vector<Marker>& markers, const OverviewGround& ground, double text_px)
{
    Names names(ground.names, overlay, ground.view);
    for (const Marker& marker : markers) {
        const Pixel at = ground.view.toPixel(marker.position_mm);
        OverlayText name{{at.x + 0.5 * text_px, at.y - 0.2 * text_px},
                         marker.id,
                         text_px,
                         labelColorOf(marker.color),
                         Across::left,
                         Along::bottom,
                         1e9};
        bool written = names.write(overlay, name);
        for (const double away : {0.6, 1.7, 2.8})  // in heights of the text
            written = written || names.write(overlay, name, at, away * text_px, away * text_px);
        if (!written)
            overlay.texts.push_back(name);
    }
}

}  // namespace

void addTips(Overlay& overlay, const Skeleton& skeleton, const OrganWords& words, const PlaneView& view, double text_px)
{
    if (skeleton.empty())
        return;
    const Pixel first = view.toPixel(skeleton.at(0).position_mm);
    const Pixel last = view.toPixel(skeleton.at(skeleton.length_mm()).position_mm);
    for (const auto& [at, name] : {std::pair{first, words.first_end}, std::pair{last, words.last_end}}) {
        overlay.discs.push_back({at, 0.25 * text_px, kPathColor, 0});
        overlay.texts.push_back(
            {{at.x, at.y + 0.4 * text_px}, name, 0.9 * text_px, kPathColor, Across::centre, Along::top, 1e9});
    }
}

OverviewGround overviewGround(const PreparedScan& scan, const SnapshotRequest& request, const Progress* wanted)
{
    const double text_px = textHeightFor(request.width, request.height, request.pixel_ratio);
    const Projection& projection = scan.coronalProjection();
    OverviewGround ground;
    ground.caption = captionSize(scan, request);
    ground.view = viewOfAll(projection, request.width, request.height, ground.caption, 2.2 * text_px);
    ground.wall = drawn(projection, ground.view, wanted);
    Overlay& overlay = ground.written;
    const bool tree = !scan.tree().empty();
    const double words_px = wordsHeight(request);
    addSkeleton(overlay, tree ? scan.tree().allBranches() : scan.skeleton(), ground.view, std::max(1.5, words_px / 9));
    addTips(overlay, scan.skeleton(), scan.words(), ground.view, words_px);
    addParts(overlay, scan.parts(), scan.skeleton(), ground.view, words_px);
    for (const OverlayText& name : overlay.texts)
        ground.names.push_back(textArea(name));
    ground.picture = ground.wall;
    paint(ground.picture, overlay);
    return ground;
}

Overlay overviewOverlay(const OverviewGround& ground, const PreparedScan& scan, const SnapshotRequest& request,
                        const SnapshotResult& place)
{
    const PlaneView& view = ground.view;
    const double text_px = wordsHeight(request);
    const auto lines = captionLines(request.caption, place.station_mm, scan.frames().length_mm(), scan.words());
    Overlay overlay;
    const Area area{0, 0, double(request.width), double(request.height)};
    addPriors(overlay, request, ground, text_px);
    addMarkers(overlay, request.markers, view, text_px);
    if (request.captioned)
        addHere(overlay, view, place.pose, 0.8 * text_px);
    addLetters(overlay, area, view.right, view.down, text_px);
    addScaleBar(overlay, area, view.mm_per_pixel, text_px);
    if (request.captioned)
        addLines(overlay, {0, 0, ground.caption.width_px, ground.caption.height_px}, lines, captionHeight(request));
    addMarkerNames(overlay, request.markers, ground, text_px);
    return overlay;
}

Picture overviewOver(const OverviewGround& ground, const PreparedScan& scan, const SnapshotRequest& request,
                     const SnapshotResult& place)
{
    Picture picture = ground.picture;
    paint(picture, overviewOverlay(ground, scan, request, place));
    return picture;
}

Picture overviewPicture(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    return overviewOver(overviewGround(scan, request), scan, request, place);
}

}  // namespace vicon::viewer
