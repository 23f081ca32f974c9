#include "vicon/viewer/scene/turned_picture.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pictures.h"
#include "seen_tint.h"
#include "vicon/viewer/model/annotate.h"

namespace vicon::viewer {
namespace {

constexpr int kTurnedSmooth = 2;
constexpr Rgb kOutsideGround{10, 13, 18};
constexpr std::array kOutside{0.93, 0.72, 0.60};
constexpr double kFarthestLight = 0.45;  // of the nearest

/// Where the points of a surface lie in a picture.
std::vector<FlatCorner> placedPoints(const CellSurface& surface, const PlaneView& view, int finer)
{
    std::vector<FlatCorner> places(surface.pointCount());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 8192), [&](const auto& some) {
        for (std::size_t n = some.begin(); n < some.end(); ++n) {
            const Point3 p = surface.point(n);
            const Pixel at = view.toPixel(p);
            places[n] = {float(at.x * finer), float(at.y * finer), float(view.depth_mm(p))};
        }
    });
    return places;
}

std::shared_ptr<const TriangleRaster> rasterOf(const CellSurface& surface, const std::vector<FlatCorner>& places,
                                               int width, int height)
{
    auto raster = std::make_shared<TriangleRaster>(width, height);
    raster->draw(surface.triangleCount(), [&](std::size_t t, std::vector<FlatTriangle>& out) {
        const std::uint32_t* p = &surface.triangles[3 * t];
        const FlatCorner &a = places[p[0]], &b = places[p[1]], &c = places[p[2]];
        // Fronts are seen from inside; from outside the other half of the wall is before them.
        if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 0)
            out.push_back({std::uint32_t(t), {a, b, c}});
    });
    return raster;
}

std::pair<double, double> depthsOf(const std::vector<FlatCorner>& places)
{
    float least = 1e30F, most = -1e30F;
    for (const FlatCorner& place : places) {
        least = std::min(least, place.depth);
        most = std::max(most, place.depth);
    }
    return {least, std::max(most, least + 1)};
}

/// The colour of the wall at a place of the raster.
class OutsideShader {
public:
    OutsideShader(const CellSurface& surface, const TurnedPicture& drawn, std::pair<double, double> depths_mm,
                  const std::vector<std::uint8_t>& seen)
        : surface_(surface),
          drawn_(drawn),
          seen_(seen),
          depths_(depths_mm),
          to_lamp_(normalized(-drawn.view.forward() - drawn.view.right * 0.4 - drawn.view.down * 0.5))
    {
    }

    Rgb at(int x, int y) const
    {
        const auto hit = drawn_.raster->at(x, y);
        if (!hit)
            return kOutsideGround;
        const std::uint32_t* corner = &surface_.triangles[3 * std::size_t(hit->triangle)];
        Vector3 inwards;
        double depth = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float* n = &surface_.normals[3 * std::size_t(corner[k])];
            inwards += Vector3{n[0], n[1], n[2]} * hit->weights[k];
            depth += drawn_.view.depth_mm(surface_.point(corner[k])) * hit->weights[k];
        }
        const double far = (depth - depths_.first) / (depths_.second - depths_.first);
        const double facing = std::max(0.0, dot(normalized(-inwards), to_lamp_));
        const double light = (0.15 + 0.85 * facing) * std::lerp(1.0, kFarthestLight, far);
        const auto byte = [&](std::size_t c) { return std::uint8_t(std::lround(255 * kOutside[c] * light)); };
        const Rgb own{byte(0), byte(1), byte(2)};
        return hit->triangle < seen_.size() && seen_[hit->triangle] ? seenTint(own) : own;
    }

private:
    const CellSurface& surface_;
    const TurnedPicture& drawn_;
    const std::vector<std::uint8_t>& seen_;
    std::pair<double, double> depths_;
    Vector3 to_lamp_;
};

void shade(TurnedPicture& drawn, const OutsideShader& shader, const Progress& progress)
{
    const int finer = drawn.finer;
    drawn.picture = Picture(drawn.view.width, drawn.view.height);
    tbb::parallel_for(0, drawn.picture.height, [&](int y) {
        for (int x = 0; x < drawn.picture.width && !progress.cancelled(); ++x) {
            std::array<int, 3> sum{};
            for (int part = 0; part < finer * finer; ++part) {
                const Rgb color = shader.at(x * finer + part % finer, y * finer + part / finer);
                sum[0] += color.red;
                sum[1] += color.green;
                sum[2] += color.blue;
            }
            const auto mean = [&](std::size_t c) { return std::uint8_t(sum[c] / (finer * finer)); };
            drawn.picture.set(x, y, {mean(0), mean(1), mean(2)});
        }
    });
}

/// A disc, or, where other wall lies before it, a ring.
void addTurnedMarkers(Overlay& overlay, const CellSurface& surface, const TurnedPicture& drawn,
                      const std::vector<Marker>& markers, double text_px)
{
    constexpr double kWall_mm = 12;  // a marker within the wall lies so far behind its outside at most
    for (const Marker& marker : markers) {
        const Pixel at = drawn.view.toPixel(marker.position_mm);
        const bool hidden = drawn.hides(surface, marker.position_mm, kWall_mm);
        overlay.discs.push_back({at, 0.38 * text_px, colorOf(marker.color), hidden ? 0.12 * text_px : 0});
        overlay.texts.push_back({{at.x + 0.5 * text_px, at.y - 0.2 * text_px},
                                 marker.id,
                                 text_px,
                                 labelColorOf(marker.color),
                                 Across::left,
                                 Along::bottom,
                                 1e9});
    }
}

Overlay turnedOverlay(const PreparedScan& scan, const TurnedPicture& drawn, const TurnedRequest& request)
{
    constexpr double kLeastText_px = 12;
    const double usual_px = std::max(textHeightFor(request.width, request.height, request.pixel_ratio),
                                     kLeastText_px * request.pixel_ratio);
    const double text_px = request.text_px > 0 ? request.text_px : usual_px;
    Overlay overlay;
    const Area area{0, 0, double(request.width), double(request.height)};
    addTips(overlay, scan.skeleton(), scan.words(), drawn.view, text_px);
    for (const PriorPlace& place : request.priors) {
        addPriorBand(overlay, drawn.view, place, text_px);
        addPriorName(overlay, drawn.view.toPixel(place.position_mm), place, text_px);
    }
    addTurnedMarkers(overlay, scan.cells(), drawn, request.markers, text_px);
    addHere(overlay, drawn.view, request.eye.pose, 0.8 * text_px);
    addLetters(overlay, area, drawn.view.right, drawn.view.down, text_px);
    addScaleBar(overlay, area, drawn.view.mm_per_pixel, text_px);
    const auto lines = captionLines(request.caption, request.eye.station_mm, scan.frames().length_mm(), scan.words());
    addLines(overlay, {0, 0, 0.47 * area.width, area.height}, lines,
             std::min(0.85 * text_px, heightOfText(lines.size(), area.height / 2 - text_px)));
    return overlay;
}

}  // namespace

std::optional<Point3> TurnedPicture::pointAt(const CellSurface& surface, Pixel at) const
{
    const int x = int(std::floor(at.x * finer)), y = int(std::floor(at.y * finer));
    if (!raster || x < 0 || y < 0 || x >= raster->width() || y >= raster->height())
        return std::nullopt;
    const auto hit = raster->at(x, y);
    return hit ? std::optional(pointOf(surface, *hit)) : std::nullopt;
}

bool TurnedPicture::hides(const CellSurface& surface, Point3 point, double within_mm) const
{
    const auto before = pointAt(surface, view.toPixel(point));
    return before && view.depth_mm(*before) < view.depth_mm(point) - within_mm;
}

TurnedPicture turnedPicture(const PreparedScan& scan, const TurnedRequest& request, Progress& progress)
{
    const CellSurface& surface = scan.cells();
    TurnedPicture drawn;
    drawn.finer = request.still ? kTurnedSmooth : 1;
    drawn.view = request.view.over(surface, request.width, request.height);
    progress.check();
    const auto places = placedPoints(surface, drawn.view, drawn.finer);
    drawn.raster = rasterOf(surface, places, request.width * drawn.finer, request.height * drawn.finer);
    progress.check();
    shade(drawn, OutsideShader(surface, drawn, depthsOf(places), request.seen), progress);
    progress.check();
    paint(drawn.picture, turnedOverlay(scan, drawn, request));
    return drawn;
}

}  // namespace vicon::viewer
