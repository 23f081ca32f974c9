#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scans.h"

namespace vicon::phantom {
namespace {

struct Expected {
    const char* position;
    Vector3 row, column, gravity;
    double slice_z;
};

void PrintTo(const Expected& expected, std::ostream* out)
{
    *out << expected.position;
}

const Expected kPositions[] = {
    {"HFS", {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, 1},   {"HFP", {-1, 0, 0}, {0, -1, 0}, {0, -1, 0}, 1},
    {"FFS", {-1, 0, 0}, {0, 1, 0}, {0, 1, 0}, -1}, {"FFP", {1, 0, 0}, {0, -1, 0}, {0, -1, 0}, -1},
    {"HFDL", {0, -1, 0}, {1, 0, 0}, {1, 0, 0}, 1}, {"HFDR", {0, 1, 0}, {-1, 0, 0}, {-1, 0, 0}, 1},
    {"FFDL", {0, 1, 0}, {1, 0, 0}, {1, 0, 0}, -1}, {"FFDR", {0, -1, 0}, {-1, 0, 0}, {-1, 0, 0}, -1},
};

const PhantomScan& cleanScanIn(const std::string& position)
{
    static std::map<std::string, PhantomScan> scans;
    if (const auto found = scans.find(position); found != scans.end())
        return found->second;
    PhantomOptions options = smallOptions();
    options.noise_hu = 0;
    return scans.emplace(position, scanOf(options, position)).first->second;
}

void expectSame(Vector3 a, Vector3 b)
{
    EXPECT_NEAR(length(a - b), 0, 1e-9);
}

class InPosition : public ::testing::TestWithParam<Expected> {};

TEST_P(InPosition, VoxelsLieAsAScannerWritesThem)
{
    const PhantomScan& scan = cleanScanIn(GetParam().position);
    expectSame(scan.hu.grid.axis[0], GetParam().row);
    expectSame(scan.hu.grid.axis[1], GetParam().column);
    expectSame(scan.hu.grid.axis[2], {0, 0, GetParam().slice_z});
    expectSame(cross(scan.hu.grid.axis[0], scan.hu.grid.axis[1]), scan.hu.grid.axis[2]);
    expectSame(scan.truth.gravity, GetParam().gravity);
    EXPECT_EQ(scan.patient_position, GetParam().position);
    EXPECT_EQ(scan.hu.grid, scan.truth.inside.grid);
}

TEST_P(InPosition, LeftIsLeft)
{
    const PhantomScan& scan = cleanScanIn(GetParam().position);
    // The colon at the flanks, seen in the voxels: descending far left, ascending far right, caecum and not sigmoid
    // low.
    double left_top = -1e9, right_top = -1e9;
    for (std::size_t v = 0; v < scan.truth.inside.voxels.size(); ++v) {
        if (scan.truth.inside.voxels[v] == kOutside)
            continue;
        const Point3 p = scan.truth.inside.grid.pointAt(scan.truth.inside.grid.indexOf(v));
        if (p.x > 60)
            left_top = std::max(left_top, p.z);
        if (p.x < -60)
            right_top = std::max(right_top, p.z);
    }
    EXPECT_GT(left_top, right_top + 15) << "the splenic flexure is the higher one";
    for (const SkeletonPoint& point : scan.truth.curve) {
        const double fraction = point.station_mm / scan.truth.length_mm;
        if (fraction > 0.9) {
            EXPECT_LT(point.position_mm.x, -30);
        }
    }
    // The liver is on the right: densities above 50 HU under the diaphragm.
    double side = 0;
    int count = 0;
    for (std::size_t v = 0; v < scan.hu.voxels.size(); v += 3) {
        const Point3 p = scan.hu.grid.pointAt(scan.hu.grid.indexOf(v));
        if (p.z > 335 && p.z < 350 && std::abs(p.x) < 130 && std::abs(p.y) < 60 && scan.hu.voxels[v] > 56 &&
            scan.hu.voxels[v] < 64) {
            side += p.x;
            ++count;
        }
    }
    ASSERT_GT(count, 500);
    EXPECT_LT(side / count, -40);
}

TEST_P(InPosition, FluidLiesBelowGasUnderALevelSurface)
{
    const PhantomScan& scan = cleanScanIn(GetParam().position);
    const InsideVolume& inside = scan.truth.inside;
    const auto [nx, ny, nz] = inside.grid.size;
    int surfaces = 0;
    std::map<int, int> levels;  // heights of surface voxels, by row
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j + 1 < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const auto here = inside.at({i, j, k}), below = inside.at({i, j + 1, k});
                EXPECT_FALSE(here == kFluid && below == kGas) << "gas under fluid";
                if (here == kGas && below == kFluid) {
                    ++surfaces;
                    ++levels[j];
                }
            }
    EXPECT_GT(surfaces, 50);
    EXPECT_LE(levels.size(), scan.truth.pools.size()) << "one height per pool";
    EXPECT_GE(levels.size(), 2U) << "levels differ between pools";
}

TEST_P(InPosition, TheTableIsBelowThePatient)
{
    const PhantomScan& scan = cleanScanIn(GetParam().position);
    const auto [nx, ny, nz] = scan.hu.grid.size;
    // Between table and patient lies air; lying on the side, the trunk leaves little of the circle above the table.
    const auto firstDense = [&, nx = nx, nz = nz](int from, int step) {
        for (int j = from;; j += step)
            for (int i = nx / 2 - 3; i < nx / 2 + 3; ++i)
                if (const int hu = scan.hu.at({i, j, nz / 2}); hu > -960 && hu != kPaddingHu)
                    return j;
    };
    const int above = firstDense(0, 1), below = ny - 1 - firstDense(ny - 1, -1);
    const bool on_side = std::abs(GetParam().gravity.x) > 0.5;
    EXPECT_LT(below, on_side ? above + 1 : above - 4);
}

INSTANTIATE_TEST_SUITE_P(All, InPosition, ::testing::ValuesIn(kPositions),
                         [](const auto& test) { return std::string(test.param.position); });

TEST(Positions, OfOnePatientShareThePolyps)
{
    const PhantomTruth &supine = cleanScanIn("HFS").truth, &prone = cleanScanIn("HFP").truth;
    ASSERT_EQ(supine.polyps.size(), prone.polyps.size());
    for (std::size_t n = 0; n < supine.polyps.size(); ++n) {
        EXPECT_EQ(supine.polyps[n].diameter_mm, prone.polyps[n].diameter_mm);
        EXPECT_NEAR(supine.polyps[n].station_mm / supine.length_mm, prone.polyps[n].station_mm / prone.length_mm, 1e-3);
    }
    EXPECT_NE(supine.gaps[0].from_mm, prone.gaps[0].from_mm);
}

TEST(Positions, FeetFirstShowsTheSamePatientFromTheOtherEnd)
{
    const PhantomScan &head = cleanScanIn("HFS"), &feet = cleanScanIn("FFS");
    EXPECT_EQ(head.truth.length_mm, feet.truth.length_mm);
    const auto [nx, ny, nz] = head.hu.grid.size;
    for (int k = 0; k < nz; k += 7)
        for (int j = 0; j < ny; j += 3)
            for (int i = 0; i < nx; i += 3)
                EXPECT_NEAR(head.hu.at({i, j, k}), feet.hu.at({nx - 1 - i, j, nz - 1 - k}), 1);
}

TEST(Positions, AnObliqueScanShowsTheSameColon)
{
    PhantomOptions options = smallOptions();
    options.noise_hu = 0;
    options.oblique_deg = 20;
    const PhantomScan oblique = scanOf(options);
    const PhantomTruth& straight = cleanScanIn("HFS").truth;
    EXPECT_NEAR(dot(oblique.hu.grid.axis[2], Vector3{0, 0, 1}), std::cos(20 * 3.14159265358979 / 180), 1e-9);
    EXPECT_NEAR(oblique.truth.volume_ml, straight.volume_ml, 0.02 * straight.volume_ml);
    std::size_t same = 0, all = 0;
    for (std::size_t v = 0; v < straight.inside.voxels.size(); ++v) {
        if (straight.inside.voxels[v] == kOutside)
            continue;
        ++all;
        const Point3 p = straight.inside.grid.pointAt(straight.inside.grid.indexOf(v));
        same += oblique.truth.inside.valueOr(oblique.truth.inside.grid.indexAt(p), kOutside) != kOutside;
    }
    EXPECT_GT(double(same) / double(all), 0.9);
}

TEST(Positions, AreThoseAskedFor)
{
    PhantomOptions options;
    EXPECT_EQ(positionsOf(options), (std::vector<std::string>{"HFS", "HFP"}));
    options.feet_first = true;
    options.supine = false;
    options.decubitus = Decubitus::left;
    EXPECT_EQ(positionsOf(options), (std::vector<std::string>{"FFP", "FFDL"}));
    EXPECT_EQ(nameOfPosition("FFDL"), "decubitus-left");
}

}  // namespace
}  // namespace vicon::phantom
