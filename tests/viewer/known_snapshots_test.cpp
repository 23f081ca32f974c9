#include "vicon/viewer/scene/known_snapshots.h"

#include <gtest/gtest.h>

#include "snapshot_fixture.h"

namespace vicon::viewer {
namespace {

using namespace test;

struct KnownPlaces : Shooting<ColonFixture> {
    /// Along the whole colon, and of the polyp.
    std::vector<SnapshotRequest> requests(const PreparedScan& of) const
    {
        SnapshotRequest request;
        request.width = request.height = 240;
        std::vector<SnapshotRequest> all;
        for (const double part : {0.05, 0.5, 0.9}) {
            request.station_mm = part * of.skeleton().length_mm();
            all.push_back(request);
        }
        request.look_at_mm = colon.polyp_mm;
        all.push_back(request);
        return all;
    }
    PeelRequest below() const
    {
        PeelRequest peel;
        peel.preset = "biopsy";
        peel.middle_only = true;
        return peel;
    }
    void expectTheSame(const PreparedScan& of, KnownSnapshots& known) const
    {
        const auto all = requests(of);
        for (std::size_t n = 0; n < all.size(); ++n)
            for (const PeelRequest& peel : {PeelRequest(), below()}) {
                SnapshotRequest request = all[n];
                request.markers = {markerAt(colon.polyp_mm, MarkerColor::red, "m1")};
                request.peel = peel;
                const DrawnSnapshot drawn = known.draw(n, request.markers, peel);
                SnapshotResult same;
                const Picture expected = shoot(of, request, &same);
                EXPECT_EQ(differing(drawn.picture, expected, 0), 0) << n << peel.preset;
                EXPECT_EQ(drawn.place.pose, same.pose);
            }
    }
};

TEST_F(KnownPlaces, AreDrawnTheSameFromTheCellsThatAreSeenThere)
{
    const PreparedScan of = scan();
    KnownSnapshots known(of, requests(of));
    expectTheSame(of, known);
    KnownSnapshots one(of, {requests(of).front()});
    EXPECT_GT(one.triangles(), 0u);
    EXPECT_LT(one.triangles(), of.cells().triangleCount() / 2);
}

TEST_F(KnownPlaces, AreDrawnTheSameWhereNothingSaysWhichCellsAreSeen)
{
    const PreparedScan of = scan();
    std::filesystem::remove(of.folder() / "subdivision.json");
    const PreparedScan bare = PreparedScan::open(of.folder());
    KnownSnapshots known(bare, requests(bare));
    EXPECT_EQ(known.triangles(), bare.cells().triangleCount());
    expectTheSame(bare, known);
}

}  // namespace
}  // namespace vicon::viewer
