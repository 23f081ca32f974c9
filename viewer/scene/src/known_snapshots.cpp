#include "vicon/viewer/scene/known_snapshots.h"

#include <tbb/parallel_invoke.h>

#include <optional>

#include "pictures.h"
#include "seen_surface.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/openness.h"
#include "vicon/viewer/scene/cell_visibility.h"

namespace vicon::viewer {
namespace {

/// Gates alone: sight lines choose better, and take longer to make than they spare for a few pictures.
std::optional<CellVisibility> gatesFor(const PreparedScan& scan, const Progress* wanted)
{
    try {
        return CellVisibility(scan, CellVisibility::Means::gates, wanted);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled)
            throw;
        return std::nullopt;
    }
}

/// Whether each segment, by its number, is among these.
std::vector<char> marked(const std::vector<int>& segments)
{
    std::vector<char> among(UINT16_MAX + 1, 0);
    for (const int segment : segments)
        among.at(std::size_t(segment)) = 1;
    return among;
}

/// The cells of these segments, with their points alone.
CellSurface cellsOf(const CellSurface& all, const std::vector<int>& segments)
{
    constexpr std::uint32_t kNone = UINT32_MAX;
    const std::vector<char> wanted = marked(segments);
    CellSurface some;
    std::vector<std::uint32_t> number(all.pointCount(), kNone);
    const auto append = [](std::vector<float>& to, const std::vector<float>& from, std::size_t point) {
        if (3 * point + 3 <= from.size())
            to.insert(to.end(), &from[3 * point], &from[3 * point] + 3);
    };
    for (std::size_t corner = 0; corner < all.triangles.size(); ++corner) {
        if (!wanted[all.segment[corner / 3]])
            continue;
        const std::uint32_t point = all.triangles[corner];
        if (number[point] == kNone) {
            number[point] = std::uint32_t(some.pointCount());
            append(some.points_mm, all.points_mm, point);
            append(some.normals, all.normals, point);
        }
        some.triangles.push_back(number[point]);
        if (corner % 3 == 0)
            some.segment.push_back(all.segment[corner / 3]);
    }
    return some;
}

SeenSurface seenFrom(const PreparedScan& scan, std::vector<SeenSurface::From> places,
                     const std::optional<CellVisibility>& gates, const Progress* wanted)
{
    bool all = !gates;
    std::vector<int> segments;
    for (SeenSurface::From& place : places) {
        const VisibleParts parts = gates ? gates->visibleFrom(place.pose, place.lens) : VisibleParts();
        all = all || parts.everything;
        place.segments = parts.segments;
        segments.insert(segments.end(), parts.segments.begin(), parts.segments.end());
    }
    SeenSurface seen{
        .cells = all ? scan.cells() : cellsOf(scan.cells(), segments), .openness = {}, .places = std::move(places)};
    seen.openness = opennessOf(seen.cells.points_mm, seen.cells.normals, scan.lumen(), wanted);
    return seen;
}

}  // namespace

KnownSnapshots::KnownSnapshots(PreparedScan scan, std::vector<SnapshotRequest> requests, const Progress* wanted)
    : scan_(std::move(scan)), requests_(std::move(requests))
{
    std::optional<CellVisibility> gates;
    tbb::parallel_invoke([&] { gates = gatesFor(scan_, wanted); }, [&] { scan_.cells(); }, [&] { scan_.lumen(); });
    if (wanted)
        wanted->check();
    std::vector<SeenSurface::From> places;
    for (const SnapshotRequest& request : requests_) {
        places_.push_back(placeOf(scan_, request));
        places.push_back({places_.back().pose, {request.view_angle_deg, request.width, request.height}, {}});
    }
    seen_ = std::make_shared<const SeenSurface>(seenFrom(scan_, std::move(places), gates, wanted));
}

KnownSnapshots::~KnownSnapshots() = default;

DrawnSnapshot KnownSnapshots::draw(std::size_t place, const std::vector<Marker>& markers, const PeelRequest& peel)
{
    if (!endoscopic_)
        endoscopic_ = std::make_unique<EndoscopicPictures>(scan_, seen_);
    SnapshotRequest request = requests_.at(place);
    request.markers = markers;
    request.peel = peel;
    return {endoscopic_->draw(request, places_[place]), places_[place]};
}

std::size_t KnownSnapshots::triangles() const
{
    return seen_->cells.triangleCount();
}

}  // namespace vicon::viewer
