#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "dicom_writer.h"
#include "store_fixture.h"
#include "vicon/core/error.h"

using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

class Geometry : public StoreFixture {
protected:
    /// Every measured voxel must hold the density of the point where the grid says it lies.
    void expectDensities(const HuVolume& volume, const Densities& densities, double tolerance_hu, double least_measured)
    {
        std::size_t measured = 0, wrong = 0;
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            if (volume.voxels[n] == kPaddingHu)
                continue;
            ++measured;
            const double expected = densities(volume.grid.pointAt(volume.grid.indexOf(n)));
            wrong += std::abs(volume.voxels[n] - expected) > tolerance_hu ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0u);
        EXPECT_GE(double(measured), least_measured * double(volume.voxels.size()));
    }
};

const std::array<Vector3, 3> kAxes{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};

/// The same box of the patient, stored with its rows along one axis and its columns along another.
SeriesSpec boxAlong(std::size_t row_axis, bool row_back, std::size_t column_axis, bool column_back)
{
    const std::array<int, 3> size{11, 13, 14};
    const std::array<double, 3> spacing_mm{1.5, 2, 2.5}, first{-20, 5, 30};
    SeriesSpec spec;
    const std::size_t slice_axis = 3 - row_axis - column_axis;
    spec.row = kAxes[row_axis] * (row_back ? -1 : 1);
    spec.column = kAxes[column_axis] * (column_back ? -1 : 1);
    spec.columns = size[row_axis];
    spec.rows = size[column_axis];
    spec.slices = size[slice_axis];
    spec.pixel_mm = spacing_mm[row_axis];
    spec.row_mm = spacing_mm[column_axis];
    spec.step_mm = kAxes[slice_axis] * spacing_mm[slice_axis];
    std::array<double, 3> corner = first;
    if (row_back)
        corner[row_axis] += spacing_mm[row_axis] * (size[row_axis] - 1);
    if (column_back)
        corner[column_axis] += spacing_mm[column_axis] * (size[column_axis] - 1);
    spec.first_mm = {corner[0], corner[1], corner[2]};
    return spec;
}

TEST_F(Geometry, TheSameBoxGivesTheSameVolumeInEveryOrientation)
{
    std::optional<HuVolume> first;
    for (std::size_t row_axis = 0; row_axis < 3; ++row_axis)
        for (std::size_t column_axis = 0; column_axis < 3; ++column_axis)
            for (int signs = 0; signs < 4 && row_axis != column_axis; ++signs) {
                SCOPED_TRACE(testing::Message() << row_axis << column_axis << signs);
                SeriesSpec spec = boxAlong(row_axis, signs & 1, column_axis, signs & 2);
                const std::string name = std::to_string(row_axis) + std::to_string(column_axis) + std::to_string(signs);
                spec.study_uid += "." + name;
                spec.series_uid = spec.study_uid + ".1";
                writeSeries(folder / name, spec);
                const auto report = import({folder / name});
                ASSERT_EQ(report.scans_stored, 1) << lines(report);
                const HuVolume volume = load(store.requireScan(CaseStore::caseIdFor(spec.study_uid), ""));
                EXPECT_EQ(volume.grid.axis, kAxes);
                expectDensities(volume, spec.densities, 0.51, 1);
                if (!first)
                    first = volume;
                EXPECT_EQ(volume.grid, first->grid);
                EXPECT_EQ(volume.voxels, first->voxels);
            }
}

TEST_F(Geometry, SlicesAreOrderedByPositionWhateverTheirNamesAndDirection)
{
    SeriesSpec spec;
    spec.step_mm = {0, 0, -2};
    spec.first_mm.z = 50;
    for (const int slice : {3, 1, 2, 0, 11, 10, 9, 8, 7, 6, 5, 4}) {
        const auto file = writeSeries(folder / "in", spec, {slice}).front();
        std::filesystem::rename(file, file.parent_path() / std::to_string(1000 - slice * slice));
    }
    import({folder / "in"});
    const HuVolume volume = load(onlyScan());
    EXPECT_EQ(volume.grid.size, (std::array{16, 16, 12}));
    EXPECT_DOUBLE_EQ(volume.grid.origin_mm.z, 28);
    expectDensities(volume, spec.densities, 0.51, 1);
}

TEST_F(Geometry, AnObliqueScanKeepsItsAxesAndItsPlaces)
{
    const double a = 20 * std::numbers::pi / 180;
    SeriesSpec spec;
    spec.row = {std::cos(a), 0, std::sin(a)};
    spec.column = {0, 1, 0};
    spec.step_mm = cross(spec.row, spec.column) * 2;
    spec.patient_position = "FFP";
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    const HuVolume volume = load(onlyScan());
    EXPECT_NEAR(distance(Point3{} + volume.grid.axis[2], Point3{} + cross(spec.row, spec.column)), 0, 1e-6);
    expectDensities(volume, spec.densities, 0.51, 1);
    EXPECT_EQ(onlyScan().ingest["geometry"]["tilt_deg"], 0);
}

TEST_F(Geometry, AGantryTiltIsRemovedSoThatABallIsRoundAgain)
{
    const double a = 18 * std::numbers::pi / 180, radius_mm = 14;
    const Point3 centre{2, 3, 4};
    SeriesSpec spec;
    spec.row = {1, 0, 0};
    spec.column = {0, std::cos(a), -std::sin(a)};
    spec.step_mm = {0, 0, 1};  // the table moves along the patient, the slices are tilted against it
    spec.columns = spec.rows = 64;
    spec.slices = 60;
    spec.first_mm = centre + Vector3{-31.5, 0, 0} + spec.column * -31.5 + Vector3{0, 0, -29.5};
    spec.densities = [&](Point3 p) { return std::clamp(500 * (radius_mm - distance(p, centre)), -1000.0, 0.0) + 0; };
    writeSeries(folder / "in", spec);
    const auto report = import({folder / "in"});
    EXPECT_TRUE(says(report, Kind::repaired, "gantry tilted by 18.0 degrees")) << lines(report);
    const HuVolume volume = load(onlyScan());
    EXPECT_NEAR(dot(volume.grid.axis[1], volume.grid.axis[2]), 0, 1e-9);
    double count = 0;
    Vector3 sum;
    std::array<double, 3> spread{};
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        if (volume.voxels[n] > -500) {
            const Vector3 d = volume.grid.pointAt(volume.grid.indexOf(n)) - centre;
            ++count;
            sum += d;
            spread[0] += d.x * d.x, spread[1] += d.y * d.y, spread[2] += d.z * d.z;
        }
    const double expected_mm3 = 4.0 / 3 * std::numbers::pi * std::pow(radius_mm + 1, 3);  // half-way density: 1 mm out
    EXPECT_NEAR(count * volume.grid.voxelVolume_mm3() / expected_mm3, 1, 0.01);
    EXPECT_LT(length(sum / count), 0.05);
    for (const double s : spread)
        EXPECT_NEAR(s / count, (radius_mm + 1) * (radius_mm + 1) / 5, 0.4);
}

TEST_F(Geometry, ATiltedLinearFieldIsResampledExactly)
{
    const double a = -25 * std::numbers::pi / 180;
    SeriesSpec spec;
    spec.column = {0, std::cos(a), -std::sin(a)};
    spec.step_mm = {0, 0, 1.3};
    spec.slices = 20;
    spec.columns = spec.rows = 32;
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    HuVolume volume = load(onlyScan());
    EXPECT_GT(volume.grid.size[1], 32);
    const HuVolume whole = volume;
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {  // at the rim there is one neighbour only
        const Index3 v = volume.grid.indexOf(n);
        if (whole.valueOr({v.i, v.j - 1, v.k}, kPaddingHu) == kPaddingHu ||
            whole.valueOr({v.i, v.j + 1, v.k}, kPaddingHu) == kPaddingHu)
            volume.voxels[n] = kPaddingHu;
    }
    expectDensities(volume, spec.densities, 1.01, 0.6);
}

struct GapCase {
    std::vector<int> missing;
    double step_mm;
    bool refused;
    const char* words;
};

class Gaps : public Geometry, public testing::WithParamInterface<GapCase> {};

TEST_P(Gaps, AreInterpolatedUpToTheLimitAndAlwaysNamed)
{
    SeriesSpec spec;
    spec.slices = 40;
    spec.step_mm = {0, 0, GetParam().step_mm};
    std::vector<int> there;
    for (int n = 0; n < spec.slices; ++n)
        if (std::find(GetParam().missing.begin(), GetParam().missing.end(), n) == GetParam().missing.end())
            there.push_back(n);
    writeSeries(folder / "in", spec, there);
    const auto report = import({folder / "in"});
    EXPECT_TRUE(says(report, GetParam().refused ? Kind::refused : Kind::repaired, GetParam().words)) << lines(report);
    EXPECT_EQ(report.anythingStored(), !GetParam().refused);
    const ScanRecord scan = onlyScan();
    EXPECT_EQ(jobs(), GetParam().refused ? 0 : 1);
    const std::string file = readFile(store.scanFolder(scan.case_id, scan.id) / "scan.json");
    EXPECT_THAT(file, testing::HasSubstr(GetParam().words));
    if (GetParam().refused) {
        EXPECT_EQ(scan.role, ScanRole::refused);
        EXPECT_THROW(load(scan), Error);
        return;
    }
    const HuVolume volume = load(scan);
    EXPECT_EQ(volume.grid.size[2], 40);
    expectDensities(volume, spec.densities, 0.51, 1);
}

INSTANTIATE_TEST_SUITE_P(
    OfSlices, Gaps,
    testing::Values(GapCase{{7}, 2, false, "1 slice missing at z = -6.0 mm (2.0 mm not measured); interpolated"},
                    GapCase{{7, 8}, 1.5, false, "2 slices missing at z = -8.8 mm (3.0 mm not measured)"},
                    GapCase{
                        {7, 8}, 2, true, "2 slices missing at z = -5.0 mm (4.0 mm not measured), more than the 3.0"},
                    GapCase{{7, 20, 21, 30, 31}, 2, true, "and 1 more such gap"},
                    GapCase{{3, 6, 9, 12, 15}, 1, true, "too many slices are missing: 5 of 40"},
                    GapCase{{20}, 5, true, "1 slice missing at z = 80.0 mm (5.0 mm not measured)"}));

TEST_F(Geometry, UnevenSlicesAreRefused)
{
    SeriesSpec spec;
    for (int n = 0; n < 12; ++n) {
        spec.first_mm.z = 0.3 * n * (n % 3);
        writeSeries(folder / "in", spec, {n});
    }
    const auto report = import({folder / "in"});
    EXPECT_TRUE(says(report, Kind::refused, "no even stack")) << lines(report);
    EXPECT_FALSE(report.anythingStored());
}

TEST_F(Geometry, SlicesThatWanderSidewaysAreRefused)
{
    SeriesSpec spec;
    for (int n = 0; n < 12; ++n) {
        spec.first_mm.x = n == 5 ? 4 : -15;
        writeSeries(folder / "in", spec, {n});
    }
    EXPECT_TRUE(says(import({folder / "in"}), Kind::refused, "no straight stack"));
}

TEST_F(Geometry, DifferentImagesAtOnePlaceAreRefused)
{
    SeriesSpec spec;
    writeSeries(folder / "in", spec);
    spec.densities = [](Point3 p) { return p.x; };
    const auto file = writeSeries(folder / "other", spec, {4}).front();
    SeriesSpec twin = spec;
    twin.first_mm = spec.position(4) + spec.step_mm * -40;
    ASSERT_EQ(twin.position(40), spec.position(4));
    writeSeries(folder / "in", twin, {40});
    const auto report = import({folder / "in"});
    EXPECT_TRUE(says(report, Kind::refused, "2 different images at one place (at z = -12.0 mm)")) << lines(report);
}

TEST_F(Geometry, ACopyOfAnImageAtItsPlaceIsNotUsedTwice)
{
    SeriesSpec spec;
    writeSeries(folder / "in", spec);
    SeriesSpec twin = spec;
    twin.first_mm = spec.position(4) + spec.step_mm * -40;
    writeSeries(folder / "in", twin, {40});
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_TRUE(says(report, Kind::repaired, "repeat"));
    expectDensities(load(onlyScan()), spec.densities, 0.51, 1);
}

struct BitCase {
    int allocated, stored, high;
    bool is_signed;
    double slope, intercept;
    std::optional<int> padding;
};

class Bits : public Geometry, public testing::WithParamInterface<BitCase> {};

TEST_P(Bits, OfAnyLayoutGiveTheSameDensities)
{
    const BitCase& c = GetParam();
    SeriesSpec spec;
    spec.bits_allocated = c.allocated;
    spec.bits_stored = c.stored;
    spec.high_bit = c.high;
    spec.is_signed = c.is_signed;
    spec.slope = c.slope;
    spec.intercept = c.intercept;
    spec.padding = c.padding;
    const Densities inner = spec.densities;
    if (c.padding)
        spec.densities = [&](Point3 p) { return p.x < -10 ? std::nan("") : inner(p); };
    writeSeries(folder / "in", spec);
    const auto report = import({folder / "in"});
    ASSERT_EQ(report.scans_stored, 1) << lines(report);
    const HuVolume volume = load(onlyScan());
    expectDensities(volume, inner, c.slope / 2 + 0.51, c.padding ? 0.5 : 1);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        const bool outside = c.padding && volume.grid.pointAt(volume.grid.indexOf(n)).x < -10;
        EXPECT_EQ(volume.voxels[n] == kPaddingHu, outside);
    }
}

INSTANTIATE_TEST_SUITE_P(Layouts, Bits,
                         testing::Values(BitCase{16, 12, 11, false, 1, -1024, {}}, BitCase{16, 16, 15, true, 1, 0, {}},
                                         BitCase{16, 16, 15, true, 1, -1024, -2000},
                                         BitCase{16, 12, 15, false, 1, -1024, {}}, BitCase{16, 13, 13, true, 1, 0, {}},
                                         BitCase{16, 12, 11, true, 2, -100, {}}, BitCase{16, 12, 11, true, 1, 0, -2000},
                                         BitCase{16, 16, 15, false, 0.5, -1024, 63536},
                                         BitCase{8, 8, 7, false, 4, -300, {}},
                                         BitCase{16, 10, 12, false, 1, -300, 1023}));

TEST_F(Geometry, ClippedAndLightGasIsMeasuredAndNotPadding)
{
    SeriesSpec spec;
    spec.intercept = -1100;
    spec.densities = [](Point3 p) { return p.x < -5 ? -1024 : p.x < 5 ? -1025 : -1060; };
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    const HuVolume volume = load(onlyScan());
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        EXPECT_EQ(volume.voxels[n], volume.grid.pointAt(volume.grid.indexOf(n)).x < 5 ? -1024 : -1060);
}

TEST_F(Geometry, SlopeAndInterceptAreThoseOfEachSlice)
{
    SeriesSpec spec;
    for (int n = 0; n < spec.slices; ++n) {
        spec.intercept = -1000 - 3 * n;
        spec.slope = n % 2 ? 1 : 0.5;
        writeSeries(folder / "in", spec, {n});
    }
    import({folder / "in"});
    expectDensities(load(onlyScan()), spec.densities, 1.01, 1);
}

TEST_F(Geometry, AnEnhancedObjectGivesTheVolumeOfItsFramesInAnyOrder)
{
    SeriesSpec spec;
    writeEnhanced(folder / "in/enhanced", spec, {5, 0, 11, 3, 7, 1, 9, 2, 10, 4, 8, 6});
    const auto report = import({folder / "in"});
    ASSERT_EQ(report.scans_stored, 1) << lines(report);
    const HuVolume volume = load(onlyScan());
    EXPECT_EQ(volume.grid.size, (std::array{16, 16, 12}));
    expectDensities(volume, spec.densities, 0.51, 1);
    EXPECT_EQ(onlyScan().series.kernel, "B30f");
    EXPECT_DOUBLE_EQ(onlyScan().series.kvp, 110);
    EXPECT_DOUBLE_EQ(onlyScan().series.slice_thickness_mm, 2);
}

TEST_F(Geometry, MeasuredSlicesBetweenTheStepsAreSaidNotToBeUsed)
{
    SeriesSpec spec, between;
    spec.slices = 40;
    spec.step_mm.z = 1;
    between.sop_suffix = ".7";
    between.step_mm.z = 10;
    between.first_mm.z = spec.first_mm.z + 10.5;
    writeSeries(folder / "in/a", spec);
    writeSeries(folder / "in/b", between, {0, 1, 2});
    const auto report = import({folder / "in"});
    EXPECT_TRUE(says(report, Kind::repaired, "3 measured slices between the steps are not used")) << lines(report);
    const HuVolume volume = load(onlyScan());
    EXPECT_EQ(volume.grid.size[2], 40);
    expectDensities(volume, spec.densities, 0.51, 1);
}

TEST_F(Geometry, AnOddMatrixIsRead)
{
    SeriesSpec spec;
    spec.columns = 37;
    spec.rows = 5;
    spec.pixel_mm = 0.7;
    spec.row_mm = 3.1;
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    const HuVolume volume = load(onlyScan());
    EXPECT_EQ(volume.grid.size, (std::array{37, 5, 12}));
    expectDensities(volume, spec.densities, 0.51, 1);
}

}  // namespace
