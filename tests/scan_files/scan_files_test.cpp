#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <numeric>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/description_file.h"
#include "vicon/scan_files/projections_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/stored_volume.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/support/support.h"

namespace vicon::scan_files {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A grid turned by 30 degrees about z, with a flipped third axis: left-handed and oblique.
Grid obliqueGrid()
{
    Grid g{.size = {5, 4, 3}, .origin_mm = {1.5, -2.5, 300}, .spacing_mm = {0.7, 0.8, 0.9}};
    g.axis = {Vector3{std::cos(0.5), std::sin(0.5), 0}, Vector3{-std::sin(0.5), std::cos(0.5), 0}, Vector3{0, 0, -1}};
    return g;
}

template <class T>
void expectSameBack(Packing packing)
{
    const support::TemporaryFolder folder;
    Volume<T> volume(obliqueGrid());
    std::iota(volume.voxels.begin(), volume.voxels.end(), T(3));
    writeVolume(folder / "v.mha", volume, packing);
    const auto back = readVolume<T>(folder / "v.mha");
    EXPECT_EQ(back.voxels, volume.voxels);
    EXPECT_EQ(back.grid.size, volume.grid.size);
    for (const Index3 v : {Index3{0, 0, 0}, Index3{4, 3, 2}})
        EXPECT_NEAR(distance(back.grid.pointAt(v), volume.grid.pointAt(v)), 0, 1e-6);
}

TEST(VolumeFile, GivesBackVoxelsAndPlaceOfEveryType)
{
    for (const Packing packing : {Packing::raw, Packing::zlib}) {
        expectSameBack<std::int16_t>(packing);
        expectSameBack<std::uint8_t>(packing);
        expectSameBack<std::uint16_t>(packing);
        expectSameBack<float>(packing);
    }
}

TEST(VolumeFile, GivesBackWhatIsLargerThanAnyBufferAndEndsAnywhere)
{
    // 4 MB are written at once; one file ends within them, one with them, one after them.
    for (const int columns : {1000, 1024, 1031}) {
        const support::TemporaryFolder folder;
        Volume<std::int16_t> volume(Grid{.size = {columns, 64, 64}});
        std::iota(volume.voxels.begin(), volume.voxels.end(), std::int16_t(-1024));
        writeVolume(folder / "v.mha", volume, Packing::raw);
        EXPECT_TRUE(readVolume<std::int16_t>(folder / "v.mha").voxels == volume.voxels) << columns;
        const auto header = readFile(folder / "v.mha").find("LOCAL\n") + 6;
        EXPECT_EQ(std::filesystem::file_size(folder / "v.mha"), header + volume.voxels.size() * 2) << columns;
    }
}

TEST(VolumeFile, StatesItsAxesAsTheMetaImageFormatDefinesThem)
{
    // The header read as text: TransformMatrix lists the axes one by one.
    const support::TemporaryFolder folder;
    writeVolume(folder / "v.mha", Volume<std::uint8_t>(obliqueGrid()), Packing::raw);
    const std::string header = readFile(folder / "v.mha").substr(0, 600);
    EXPECT_THAT(header, HasSubstr("TransformMatrix = 0.87758256"));
    EXPECT_THAT(header, HasSubstr(" 0.47942553"));
    EXPECT_THAT(header, HasSubstr("ElementDataFile = LOCAL"));
}

template <class T>
void expectSameStored(const std::filesystem::path& file, Packing packing)
{
    Volume<T> volume(obliqueGrid());
    std::iota(volume.voxels.begin(), volume.voxels.end(), T(3));
    writeVolume(file, volume, packing);
    const StoredVolume<T> stored(file);
    writeVolume(file, Volume<T>(obliqueGrid()), packing);  // another file under the same name
    EXPECT_TRUE(std::ranges::equal(stored.view().voxels, volume.voxels));
    EXPECT_EQ(stored.view().at({4, 3, 2}), volume.at({4, 3, 2}));
    EXPECT_EQ(stored.view().valueOr({5, 3, 2}, T(77)), T(77));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(stored.view().voxels.data()) % alignof(T), 0U);
}

TEST(StoredVolume, HoldsWhatTheFileHeldWhenItWasOpened)
{
    const support::TemporaryFolder folder;
    for (const Packing packing : {Packing::raw, Packing::zlib}) {
        expectSameStored<std::int16_t>(folder / "v.mha", packing);
        expectSameStored<std::uint8_t>(folder / "v.mha", packing);
        expectSameStored<std::uint16_t>(folder / "v.mha", packing);
        expectSameStored<float>(folder / "v.mha", packing);
    }
}

TEST(StoredVolume, ReadsFilesOfOthersWhoseVoxelsBeginAnywhere)
{
    const support::TemporaryFolder folder;
    for (const int longer : {0, 1, 2, 3}) {
        std::ofstream(folder / "v.mha", std::ios::binary)
            << "ObjectType = Image\nNDims = 3\nComment = " << std::string(std::size_t(longer), 'c')
            << "\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\nDimSize = 2 1 1\n"
            << "ElementSpacing = 1 1 1\nElementType = MET_SHORT\nElementDataFile = LOCAL\n"
            << std::string("\x01\x00\x02\x01", 4);
        const StoredVolume<std::int16_t> stored(folder / "v.mha");
        EXPECT_THAT(std::vector(stored.view().voxels.begin(), stored.view().voxels.end()), ElementsAre(1, 258));
    }
}

TEST(StoredVolume, RefusesWhatIsCutOff)
{
    const support::TemporaryFolder folder;
    writeVolume(folder / "v.mha", Volume<float>(obliqueGrid()), Packing::raw);
    std::filesystem::resize_file(folder / "v.mha", std::filesystem::file_size(folder / "v.mha") - 1);
    EXPECT_THROW(StoredVolume<float>(folder / "v.mha"), Error);
}

TEST(VolumeFile, RefusesWhatCannotBeRead)
{
    const support::TemporaryFolder folder;
    const auto codeOf = [&] {
        try {
            readVolume<std::uint8_t>(folder / "v.mha");
        } catch (const Error& e) {
            return e.code();
        }
        return ErrorCode::internal;
    };
    EXPECT_EQ(codeOf(), ErrorCode::not_found);
    std::ofstream(folder / "v.mha") << "nonsense";
    EXPECT_EQ(codeOf(), ErrorCode::bad_input);
    writeVolume(folder / "v.mha", Volume<float>(obliqueGrid()), Packing::raw);
    EXPECT_EQ(codeOf(), ErrorCode::bad_input) << "another voxel type";
    for (const Packing packing : {Packing::raw, Packing::zlib}) {
        writeVolume(folder / "v.mha", Volume<std::uint8_t>(obliqueGrid()), packing);
        std::filesystem::resize_file(folder / "v.mha", std::filesystem::file_size(folder / "v.mha") - 10);
        EXPECT_EQ(codeOf(), ErrorCode::bad_input) << "cut off";
    }
}

TEST(SkeletonFile, GivesBackPiecesBridgesStationsAndRadii)
{
    const support::TemporaryFolder folder;
    Skeleton s;
    s.pieces.push_back({false, {{{0, 0, 0.123456789012}, 0, 5}, {{10, 0, 0}, 10, 3}, {{10, 5, 0}, 15, 2}}});
    s.pieces.push_back({true, {{{10, 5, 0}, 15, 0}, {{10, 10, 0}, 20, 0}}});
    writeSkeleton(folder / "s.vtp", s);
    const Skeleton back = readSkeleton(folder / "s.vtp");
    ASSERT_EQ(back.pieces.size(), 2u);
    EXPECT_TRUE(back.pieces[1].bridge);
    EXPECT_EQ(back.pieces[0].points[0].position_mm, s.pieces[0].points[0].position_mm);
    EXPECT_DOUBLE_EQ(back.at(15).radius_mm, 2);
    EXPECT_DOUBLE_EQ(back.length_mm(), 20);
    writeSkeletonVoxels(folder / "v.vtp", {{{1, 2, 3}, {2, 2, 3}}, {{5, 5, 5}, {6, 6, 6}}});
    EXPECT_EQ(readSkeletonVoxels(folder / "v.vtp")[1][1], (Point3{6, 6, 6}));
    EXPECT_THROW(readSkeleton(folder / "v.vtp"), Error) << "no stations in it";
}

TEST(CellsFile, GivesBackTheSurface)
{
    const support::TemporaryFolder folder;
    CellSurface surface;
    surface.points_mm = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    surface.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0};
    surface.triangles = {0, 1, 2, 0, 2, 3};
    surface.segment = {1, 2};
    writeCells(folder / "c.vtp", surface);
    const CellSurface back = readCells(folder / "c.vtp");
    EXPECT_EQ(back.points_mm, surface.points_mm);
    EXPECT_EQ(back.normals, surface.normals);
    EXPECT_EQ(back.triangles, surface.triangles);
    EXPECT_EQ(back.segment, surface.segment);
}

TEST(ProjectionsFile, GivesBackPicturesAndTheirPlaces)
{
    const support::TemporaryFolder folder;
    std::vector<Projection> written{{"coronal", 3, 2, 0.5, {1, 0, 0}, {0, 0, -1}, {-10, 0, 20}, {}},
                                    {"sagittal", 2, 2, 0.6, {0, 1, 0}, {0, 0, -1}, {0, -5, 20}, {}}};
    for (Projection& p : written) {
        p.rgba.resize(std::size_t(p.width) * std::size_t(p.height) * 4);
        std::iota(p.rgba.begin(), p.rgba.end(), std::uint8_t(p.width));
    }
    writeProjections(folder / "projections", written);
    for (const Projection& p : written) {
        const Projection back = readProjection(folder / "projections", p.name);
        EXPECT_EQ(back.rgba, p.rgba);
        const Point3 somewhere{3, 4, 5};
        EXPECT_EQ(back.column(somewhere), p.column(somewhere));
        EXPECT_EQ(back.row(somewhere), p.row(somewhere));
        EXPECT_THAT(readFile(folder / "projections" / (p.name + ".png")), HasSubstr("vicon:mapping"));
    }
    EXPECT_THROW(readProjection(folder / "projections", "transverse"), Error);
    EXPECT_THROW(readProjection(folder / "absent", "coronal"), Error);
    std::filesystem::copy_file(folder / "projections" / "sagittal.png", folder / "projections" / "coronal.png",
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_THROW(readProjection(folder / "projections", "coronal"), Error) << "another picture's size";
}

TEST(SubdivisionFile, GivesBackSegmentsAndPortals)
{
    const support::TemporaryFolder folder;
    Subdivision s;
    s.method = SubdivideMethod::flood;
    s.segments.push_back({.number = 1, .to_station_mm = 30, .triangles = 12});
    s.portals.push_back(
        {.segment_a = 1, .segment_b = 2, .centre_mm = {1, 2, 3}, .area_mm2 = 4, .along_skeleton = false});
    writeSubdivision(folder / "s.json", s);
    EXPECT_EQ(nlohmann::json::parse(readFile(folder / "s.json"))["method"], "flood");
    const Subdivision back = readSubdivision(folder / "s.json");
    EXPECT_EQ(back.method, SubdivideMethod::flood);
    EXPECT_EQ(back.segments[0].triangles, 12u);
    EXPECT_EQ(back.portals[0].centre_mm, s.portals[0].centre_mm);
    EXPECT_FALSE(back.portals[0].along_skeleton);
    std::ofstream(folder / "s.json") << "{}";
    EXPECT_THROW(readSubdivision(folder / "s.json"), Error);
}

TEST(DescriptionFile, IsReadBackAndToldFromOthers)
{
    const support::TemporaryFolder folder;
    EXPECT_TRUE(readDescription(folder.path()).case_id.empty()) << "none was written yet";
    ScanDescription one{
        .case_id = "c1",
        .scan_id = "s1",
        .patient = {.id = "P1", .name = "Doe^Jane"},
        .study = {.uid = "1.2"},
        .series = {.uid = "1.2.3", .number = 4, .patient_position = "HFP", .kvp = 120},
        .role = ScanRole::kept,
        .created = "2026-11-21T08:15:30Z",
        .ingest = {{"geometry", {{"slices", 20}}}, {"repairs", {"one"}}, {"kept_because", "few slices"}}};
    one.steps.push_back({.step = "segment",
                         .version = 3,
                         .digest = "d",
                         .parameters = {{"a.b", 1}},
                         .result = {{"verdict", "colon"}, {"confidence", 0.75}, {"gas_ml", 900.5}},
                         .seconds = 1.0 / 3,
                         .finished = "2026-11-21T08:16:30Z"});
    EXPECT_FALSE(isDescribedBy(folder.path(), one));
    writeDescription(folder.path(), one);
    EXPECT_TRUE(isDescribedBy(folder.path(), one));
    const ScanDescription read = readDescription(folder.path());
    EXPECT_EQ(toJson(read), toJson(one));
    EXPECT_EQ(read.patient.name, "Doe^Jane");
    EXPECT_EQ(read.series.kvp, 120);
    EXPECT_EQ(read.role, ScanRole::kept);
    EXPECT_EQ(read.ingest, one.ingest);
    EXPECT_EQ(read.steps.at(0).seconds, 1.0 / 3);
    const auto json = nlohmann::json::parse(readFile(folder / "scan.json"));
    EXPECT_EQ(json["position"], "prone");
    EXPECT_EQ(json["verdict"], "colon") << "what readers ask for first stands at the top";
    EXPECT_FALSE(json.contains("gas_ml"));
    one.steps[0].result["verdict"] = "unsure";
    EXPECT_FALSE(isDescribedBy(folder.path(), one));
}

}  // namespace
}  // namespace vicon::scan_files
