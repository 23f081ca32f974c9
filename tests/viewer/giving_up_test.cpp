// What the window's threads do for long asks, again and again, whether anybody still wants it.
#include <atomic>
#include <limits>
#include <numeric>

#include "scan_fixture.h"
#include "snapshot_fixture.h"
#include "vicon/cases/density_sample.h"
#include "vicon/cases/station_map.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/plane_size.h"
#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/model/unseen.h"
#include "vicon/viewer/model/wall_distance.h"
#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/measures_picture.h"
#include "vicon/viewer/scene/reading_pictures.h"
#include "vicon/viewer/scene/slice_pictures.h"

namespace vicon::viewer {
namespace {

/// Counts how often work asks; from `until` on it is not wanted.
class Asked : public NoProgress {
public:
    explicit Asked(int until = std::numeric_limits<int>::max()) : until_(until) {}
    bool cancelled() const override { return ++times_ > until_; }
    int times() const { return times_; }

private:
    const int until_;
    mutable std::atomic<int> times_ = 0;
};

class GivingUp : public test::ColonFixture {
protected:
    /// The work asks `least` times and more, and ends half-way with the word that it was cancelled.
    template <class Work>
    static void expectStops(const char* name, int least, Work work)
    {
        const Asked always;
        work(&always);
        EXPECT_GE(always.times(), least) << name;
        const Asked half_way(always.times() / 2);
        try {
            work(&half_way);
            ADD_FAILURE() << name << " goes on";
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::cancelled) << name;
        }
        constexpr int kThreads = 64;  // each of which may ask once more
        EXPECT_LE(half_way.times(), always.times() / 2 + kThreads) << name;
    }

    const PreparedScan scan_ = scan();
    const Point3 eye_ = scan_.frames().at(200).position_mm, on_wall_ = eye_ + Vector3{0, 0, 14};
};

TEST_F(GivingUp, OfWhatIsMeasured)
{
    const HuView& volume = scan_.volume();
    const InsideView& inside = scan_.inside();
    const CellSurface& cells = scan_.cells();
    expectStops("biopsy", 10, [&](const Progress* wanted) { sampleDensity(volume, inside, on_wall_, 20, {}, wanted); });
    expectStops("biopsy below the wall", 10, [&](const Progress* wanted) {
        sampleDensity(volume, inside, on_wall_, 20, CircledWall{on_wall_, {0, 0, 1}, 0}, wanted);
    });
    expectStops("over the wall", 10, [&](const Progress* wanted) {
        distanceOverWall(cells.points_mm, cells.triangles, eye_, scan_.frames().at(300).position_mm, wanted);
    });
    const Point3 polyp = colon.polyp_mm;
    const PathFrame on_path = scan_.frames().at(colon.polyp_station_mm);
    const Vector3 aside = on_path.forward * colon.polyp_radius_mm;
    expectStops("best plane", 10, [&](const Progress* wanted) {
        sizeOnBestPlane(inside, polyp - aside, polyp + aside, on_path.position_mm, wanted);
    });
    const PlaneSize plane{8, polyp, polyp + Vector3{8, 0, 0}, 50, polyp, {1, 0, 0}, {0, 0, 1}};
    Marker marker;
    marker.size.emplace();
    marker.size->plane = plane;
    expectStops("its picture", 100,
                [&](const Progress* wanted) { measuresPicture(scan_, marker, {}, 200, 1, wanted); });
}

TEST_F(GivingUp, OfTheSamePlacesOfTwoScans)
{
    expectStops("relief", 100, [&](const Progress* wanted) { reliefOf(scan_.inside(), scan_.skeleton(), wanted); });
    ColonProfile profile = profileOf(scan_.skeleton(), scan_.parts(), scan_.along());
    profile.relief = reliefOf(scan_.inside(), scan_.skeleton());
    expectStops("map", 100, [&](const Progress* wanted) { matchStations(profile, profile, wanted); });
}

TEST_F(GivingUp, OfSlices)
{
    const auto of = std::make_shared<const PreparedScan>(scan_);
    SliceRequest request;
    request.window = windowPreset("colon");
    request.plane = SlicePlane::sagittal;
    const auto draw = [&](SlicePictures& pictures, double x, const Progress* wanted) {
        request.point_mm = {x, 0, 10};
        request.view = sliceThrough(of->volume().grid, request.plane, request.point_mm, 200, 200);
        return pictures.draw(of, request, wanted);
    };
    SlicePictures pictures;
    expectStops("slice", 100, [&](const Progress* wanted) { draw(pictures, 0, wanted); });
    request.thick = {ThickSlice::Kind::mean, 20};
    expectStops("slab", 1000, [&](const Progress* wanted) { draw(pictures, 0, wanted); });
    request.thick = {};
    expectStops("slices to come", 10, [&](const Progress* wanted) {
        SlicePictures fresh;
        draw(fresh, 0, nullptr);
        draw(fresh, 1, nullptr);
        fresh.readAhead(wanted);
    });
    SlicePictures fresh;
    EXPECT_EQ(test::differing(draw(pictures, 2, nullptr), draw(fresh, 2, nullptr), 1), 0) << "what comes next is whole";
}

TEST_F(GivingUp, OfTheProjection)
{
    SnapshotRequest request;
    request.width = request.height = 300;
    const SnapshotResult place{{eye_, {0, 0, 1}, {0, 1, 0}}, 200, 10, true};
    ScanCoverage reviewed(triangleAreas_mm2(scan_.cells().points_mm, scan_.cells().triangles));
    std::vector<std::uint32_t> all(scan_.cells().triangleCount());
    std::iota(all.begin(), all.end(), 0U);
    reviewed.see(all);
    expectStops("projection", 100, [&](const Progress* wanted) {
        ReadingPictures fresh(scan_);
        fresh.overview(request, place, &reviewed, true, wanted);
    });
    ReadingPictures pictures(scan_), whole(scan_);
    for (const int until : {0, 100, 301})
        EXPECT_THROW(
            {
                const Asked asked(until);
                pictures.overview(request, place, &reviewed, true, &asked);
            },
            Error);
    EXPECT_EQ(test::differing(pictures.overview(request, place, &reviewed).picture,
                              whole.overview(request, place, &reviewed).picture, 1),
              0)
        << "what comes next is whole, and painted";
}

TEST_F(GivingUp, OfWhatIsReadAndFoundForAScan)
{
    const auto fresh = [&] { return PreparedScan::open(scan_.folder()); };
    expectStops("opening", 10, [&](const Progress* wanted) { fresh().readForFlight(wanted); });
    expectStops("sight lines", 10, [&](const Progress* wanted) {
        CellVisibility(scan_, CellVisibility::Means::gates_and_sight_lines, wanted);
    });
    const ScanCoverage none(triangleAreas_mm2(scan_.cells().points_mm, scan_.cells().triangles));
    expectStops("missed regions", 3,
                [&](const Progress* wanted) { unseenAreas_mm2(scan_.cells().triangles, none.coverage(), wanted); });
}

}  // namespace
}  // namespace vicon::viewer
