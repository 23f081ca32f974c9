// The whole chain in memory: what must not depend on how the scan was stored, on threads, or on the slices' angle.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <cstring>

#include "skeleton_phantom.h"
#include "vicon/core/file.h"
#include "vicon/phantom/phantom.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/colon_parts.h"
#include "vicon/steps/exit_distance.h"
#include "vicon/steps/quality.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

/// Everything that the steps make of a scan, as digests of the bytes, and what the comparisons need.
struct Prepared {
    std::map<std::string, std::string> digests;
    InsideVolume inside;
    Skeleton curve;
};

template <class T>
std::string digestOf(const std::vector<T>& values)
{
    return sha256({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

std::string digestOf(const Grid& grid)
{
    std::vector<double> all{grid.origin_mm.x, grid.origin_mm.y, grid.origin_mm.z};
    for (std::size_t a = 0; a < 3; ++a)
        all.insert(all.end(),
                   {double(grid.size[a]), grid.spacing_mm[a], grid.axis[a].x, grid.axis[a].y, grid.axis[a].z});
    for (double& value : all)
        value += 0.0;  // a zero has no sign
    return digestOf(all);
}

std::string digestOf(const Skeleton& curve)
{
    std::vector<double> all;
    for (const SkeletonPiece& piece : curve.pieces)
        for (const SkeletonPoint& p : piece.points)
            all.insert(all.end(), {p.position_mm.x, p.position_mm.y, p.position_mm.z, p.station_mm, p.radius_mm,
                                   double(piece.bridge)});
    return digestOf(all);
}

Prepared prepare(HuVolume acquired, Vector3 gravity)
{
    NoProgress quiet;
    Prepared made;
    auto& digests = made.digests;
    const HuVolume volume = resample(std::move(acquired), {}, quiet);
    digests["volume"] = digestOf(volume.grid) + digestOf(volume.voxels);
    Segmentation segmentation = segmentColon(volume, gravity, {}, quiet);
    made.inside = std::move(segmentation.inside);
    digests["inside"] = digestOf(made.inside.grid) + digestOf(made.inside.voxels) + toJson(segmentation.plan).dump();
    const SkeletonResult skeleton = findSkeleton(made.inside, segmentation.plan, {}, quiet);
    made.curve = skeleton.curve;
    digests["skeleton"] = digestOf(made.curve);
    const ColonPartRanges parts = findColonParts(made.curve).ranges;
    digests["parts"] = toJson(parts).dump();
    digests["quality"] = toJson(measureQuality(volume, made.inside, made.curve, parts, {}, quiet), {}).dump();
    const Subdivided divided = subdivide(made.inside, made.curve, skeleton.voxels, {}, quiet);
    digests["segments"] = digestOf(divided.segments.voxels);
    const auto surface = extractCells(volume, made.inside, divided.segments, {}, quiet);
    digests["cells"] = digestOf(surface.points_mm) + digestOf(surface.triangles) + digestOf(surface.segment) +
                       digestOf(surface.normals);
    digests["exit_distance"] = digestOf(exitDistance(made.inside, made.curve, quiet).voxels);
    digests["wall_distance"] = digestOf(wallDistance(made.inside, quiet).voxels);
    return made;
}

phantom::PhantomScan smallScan(std::uint64_t seed, double oblique_deg = 0)
{
    NoProgress quiet;
    phantom::PhantomOptions options;
    options.seed = seed;
    options.size = {128, 128, 108};
    options.folds = false;
    options.oblique_deg = oblique_deg;
    return phantom::makeScan(options, "HFS", quiet);
}

struct ChainCase {
    phantom::PhantomScan scan;
    Prepared prepared;
};

/// A scan and what becomes of it, made once for all tests.
const ChainCase& usual()
{
    static const ChainCase made = [] {
        ChainCase out{smallScan(4), {}};
        out.prepared = prepare(out.scan.hu, out.scan.truth.gravity);
        return out;
    }();
    return made;
}

/// The same densities at the same places, stored along other axes, each forwards or backwards.
HuVolume storedAs(const HuVolume& volume, std::array<std::size_t, 3> order, std::array<bool, 3> reversed)
{
    HuVolume stored;
    Grid& grid = stored.grid;
    const Grid& from = volume.grid;
    Index3 first;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t source = order[a];
        grid.size[a] = from.size[source];
        grid.spacing_mm[a] = from.spacing_mm[source];
        grid.axis[a] = reversed[a] ? -from.axis[source] : from.axis[source];
        if (reversed[a])
            (source == 0 ? first.i : source == 1 ? first.j : first.k) = from.size[source] - 1;
    }
    grid.origin_mm = from.pointAt(first);
    stored.voxels.resize(volume.voxels.size());
    for (std::size_t n = 0; n < stored.voxels.size(); ++n) {
        const Index3 to = grid.indexOf(n);
        const std::array<int, 3> along{to.i, to.j, to.k};
        std::array<int, 3> at{};
        for (std::size_t a = 0; a < 3; ++a)
            at[order[a]] = reversed[a] ? grid.size[a] - 1 - along[a] : along[a];
        stored.voxels[n] = volume.at({at[0], at[1], at[2]});
    }
    return stored;
}

TEST(Chain, OfTheUsualScanFindsAColon)
{
    EXPECT_FALSE(usual().prepared.curve.empty());
    EXPECT_NEAR(usual().prepared.curve.length_mm() / usual().scan.truth.length_mm, 1, 0.05);
}

struct Storage {
    const char* name;
    std::array<std::size_t, 3> order;
    std::array<bool, 3> reversed;
};

class ChainStorage : public testing::TestWithParam<Storage> {};

TEST_P(ChainStorage, ChangesNoBitOfAnyResult)
{
    const auto& [scan, prepared] = usual();
    const Prepared again = prepare(storedAs(scan.hu, GetParam().order, GetParam().reversed), scan.truth.gravity);
    for (const auto& [what, digest] : prepared.digests)
        EXPECT_EQ(again.digests.at(what), digest) << what;
}

INSTANTIATE_TEST_SUITE_P(Stored, ChainStorage,
                         testing::Values(Storage{"SlicesReversed", {0, 1, 2}, {false, false, true}},
                                         Storage{"Mirrored", {0, 1, 2}, {true, false, false}},
                                         Storage{"SagittalBackwards", {2, 1, 0}, {true, true, false}}),
                         [](const auto& it) { return std::string(it.param.name); });

class ChainThreads : public testing::TestWithParam<std::size_t> {};

TEST_P(ChainThreads, ChangeNoBitOfAnyResult)
{
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, GetParam());
    const auto& [scan, prepared] = usual();
    const Prepared again = prepare(scan.hu, scan.truth.gravity);
    for (const auto& [what, digest] : prepared.digests)
        EXPECT_EQ(again.digests.at(what), digest) << what;
}

INSTANTIATE_TEST_SUITE_P(Number, ChainThreads, testing::Values(1, 5));

double diceOf(const InsideVolume& a, const InsideVolume& b)
{
    double both = 0, of_a = 0, of_b = 0;
    for (const std::uint8_t v : b.voxels)
        of_b += v ? b.grid.voxelVolume_mm3() : 0;
    for (std::size_t n = 0; n < a.voxels.size(); ++n)
        if (a.voxels[n]) {
            of_a += a.grid.voxelVolume_mm3();
            if (b.valueOr(b.grid.indexAt(a.grid.pointAt(a.grid.indexOf(n))), 0))
                both += a.grid.voxelVolume_mm3();
        }
    return 2 * both / (of_a + of_b);
}

#ifdef VICON_FULL_SIZE
/// At full size, the lines that must hold; at 3 mm voxels below, the same with what such voxels allow.
TEST(ChainOblique, AcquisitionUpTo20DegreesGivesTheSameLumenAndCurve)
{
    NoProgress quiet;
    for (const std::uint64_t seed : {111, 112}) {
        Prepared straight;
        for (const double angle_deg : {0.0, 10.0, 20.0}) {
            phantom::PhantomOptions options;
            options.seed = seed;
            options.gaps = 0;
            options.oblique_deg = angle_deg;
            phantom::PhantomScan scan = phantom::makeScan(options, "HFS", quiet);
            Prepared made = prepare(std::move(scan.hu), scan.truth.gravity);
            if (angle_deg == 0) {
                straight = std::move(made);
                continue;
            }
            double mean_mm = 0, count = 0;
            for (const SkeletonPiece& piece : made.curve.pieces)
                for (const SkeletonPoint& p : piece.points) {
                    mean_mm += straight.curve.nearest(p.position_mm).distance_mm;
                    ++count;
                }
            mean_mm /= count;
            const double dice = diceOf(made.inside, straight.inside);
            std::printf("seed %d, %2.0f degrees: Dice %.4f, curve %.2f mm, length %+.1f mm\n", int(seed), angle_deg,
                        dice, mean_mm, made.curve.length_mm() - straight.curve.length_mm());
            EXPECT_GE(dice, 0.99);
            EXPECT_LE(mean_mm, 0.5);
        }
    }
}
#else
TEST(ChainOblique, AcquisitionOf15DegreesGivesTheSameLumenAndCurveWithinAVoxel)
{
    const auto& [scan, prepared] = usual();
    phantom::PhantomScan turned = smallScan(4, 15);
    const Prepared made = prepare(std::move(turned.hu), turned.truth.gravity);
    EXPECT_GE(diceOf(made.inside, prepared.inside), 0.9) << "voxels of 3 and 4 mm";
    EXPECT_LT(std::abs(made.curve.length_mm() / prepared.curve.length_mm() - 1), 0.03);
    double mean_mm = 0, count = 0;
    for (const SkeletonPiece& piece : made.curve.pieces)
        for (const SkeletonPoint& p : piece.points) {
            mean_mm += prepared.curve.nearest(p.position_mm).distance_mm;
            ++count;
        }
    EXPECT_LE(mean_mm / count, 1.5);
}
#endif

}  // namespace
}  // namespace vicon::steps
