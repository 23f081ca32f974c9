// A scan's files as nobody should have written them: refused, whatever stands in them, before memory is asked for.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/description_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/stored_volume.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/support/support.h"

namespace vicon::scan_files {
namespace {

class DamagedFile : public testing::Test {
protected:
    void replace(const std::string& what, const std::string& with)
    {
        std::string bytes = readFile(file);
        const auto at = bytes.find(what);
        ASSERT_NE(at, std::string::npos) << what;
        replaceFile(file, bytes.replace(at, what.size(), with));
    }
    static bool isRefused(const std::function<void()>& read)
    {
        try {
            read();
        } catch (const Error& e) {
            return e.code() == ErrorCode::bad_input;
        }
        return false;
    }
    bool volumeIsRefused() const
    {
        return isRefused([&] { readVolume<std::uint8_t>(file); }) &&
               isRefused([&] { (void)StoredVolume<std::uint8_t>(file); });
    }
    void writeSmallVolume(Packing packing)
    {
        Grid grid;
        grid.size = {4, 3, 5};
        writeVolume(file, Volume<std::uint8_t>(grid, 1), packing);
        ASSERT_NO_THROW(readVolume<std::uint8_t>(file));
    }

    support::TemporaryFolder folder;
    std::filesystem::path file = folder / "file";
};

struct HeaderChange {
    Packing packing;
    const char* what;
    const char* with;
};

class DamagedHeader : public DamagedFile, public testing::WithParamInterface<HeaderChange> {};

TEST_P(DamagedHeader, IsRefused)
{
    const HeaderChange& change = GetParam();
    file = folder / "volume.mha";
    writeSmallVolume(change.packing);
    replace(change.what, change.with);
    EXPECT_TRUE(volumeIsRefused()) << change.with;
}

class DamagedVoxels : public DamagedFile {
protected:
    DamagedVoxels()
    {
        file = folder / "volume.mha";
        writeSmallVolume(Packing::zlib);
        sound_ = readFile(file);
        const std::string end = "ElementDataFile = LOCAL\n";
        begin_ = sound_.find(end) + end.size();
    }
    std::string voxels() const { return sound_.substr(begin_); }
    /// With the header's count of them, and as many bytes behind, that the file is none that was cut off.
    void replaceVoxels(const std::string& packed)
    {
        const std::string count = "CompressedDataSize = ";
        std::string header = sound_.substr(0, begin_);
        const auto at = header.find(count) + count.size();
        header.replace(at, header.find('\n', at) - at, std::to_string(packed.size()));
        replaceFile(file, header + packed + voxels());
    }

private:
    std::string sound_;
    std::size_t begin_ = 0;
};

TEST_F(DamagedVoxels, AreReadWhereTheyAreSound)
{
    replaceVoxels(voxels());
    EXPECT_EQ(readVolume<std::uint8_t>(file).voxels, std::vector<std::uint8_t>(60, 1));
}

/// MetaIO never came back from such a stream.
TEST_F(DamagedVoxels, ThatWantADictionaryAreRefused)
{
    replaceVoxels(std::string("\x78\x20\0\0\0\1", 6) + voxels().substr(2));
    EXPECT_TRUE(volumeIsRefused());
}

/// MetaIO took these for sound, and left voxels at nothing.
TEST_F(DamagedVoxels, AreRefusedWhateverIsWrong)
{
    const std::string packed = voxels(), nothing("\x78\x01\3\0\0\0\0\1", 8);
    std::string wrong_sum = packed;
    wrong_sum.back() ^= 1;
    for (const std::string& bytes : {wrong_sum, packed.substr(0, packed.size() - 5), nothing, std::string()}) {
        replaceVoxels(bytes);
        EXPECT_TRUE(volumeIsRefused()) << bytes.size();
    }
}

const std::string kComment = "Comment = " + std::string(300, 'x') + "\nDimSize";
const char* const kLongComment = kComment.c_str();

INSTANTIATE_TEST_SUITE_P(
    OfAVolume, DamagedHeader,
    testing::Values(HeaderChange{Packing::raw, "NDims = 3", "NDims = 2147483647"},
                    HeaderChange{Packing::raw, "NDims = 3", "NDims =2147483647 3"},
                    HeaderChange{Packing::zlib, "NDims = 3", "NDims = 3\nNDims = 2147483647"},
                    HeaderChange{Packing::zlib, "CompressedDataSize = ", "CompressedDataSize = x"},
                    HeaderChange{Packing::zlib, "CompressedDataSize = ", "CompressedDataSize = 18446744073709551615"},
                    HeaderChange{Packing::zlib, "DimSize = 4 3 5", "DimSize = 40000 40000 40000"},
                    HeaderChange{Packing::raw, "DimSize = 4 3 5", "DimSize = 0 3 5"},
                    HeaderChange{Packing::raw, "DimSize = 4 3 5", "DimSize = -4 3 -5"},
                    HeaderChange{Packing::raw, "DimSize = 4 3 5", "DimSize = 65536 65536 4294967296"},
                    HeaderChange{Packing::raw, "ElementSpacing = 1 1 1", "ElementSpacing = 1 nan 1"},
                    HeaderChange{Packing::raw, "ElementDataFile = LOCAL", "ElementDataFile = /etc/passwd"},
                    HeaderChange{Packing::raw, "BinaryDataByteOrderMSB = False", "BinaryDataByteOrderMSB = True"},
                    HeaderChange{Packing::raw, "BinaryDataByteOrderMSB = False", "ElementByteOrderMSB = True"},
                    HeaderChange{Packing::raw, "BinaryData = True", "BinaryData = False"},
                    HeaderChange{Packing::raw, "DimSize", "HeaderSize = 64\nDimSize"},
                    HeaderChange{Packing::zlib, "CompressedData = True", "CompressedData = Perhaps"},
                    HeaderChange{Packing::zlib, "CompressedDataSize = ", "Comment = CompressedDataSize "},
                    HeaderChange{Packing::raw, "Comment = ", "ID = 1\nID = 2\nComment = "},
                    HeaderChange{Packing::zlib, "DimSize", kLongComment},
                    HeaderChange{Packing::raw, "ElementDataFile = LOCAL", "ElementDataFile = LOCAL%d 1 2 1"},
                    HeaderChange{Packing::zlib, "DimSize", "ElementDataFile = voxels%d.raw\nDimSize"}));

CellSurface twoTriangles()
{
    CellSurface surface;
    surface.points_mm = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    surface.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    surface.triangles = {0, 1, 2, 1, 3, 2};
    surface.segment = {1, 2};
    return surface;
}

TEST_F(DamagedFile, SurfacesWhoseCornersAreNotThereAreRefused)
{
    CellSurface surface = twoTriangles();
    writeCells(file, surface);
    ASSERT_NO_THROW(readCells(file));
    surface.triangles[4] = 4;
    writeCells(file, surface);
    EXPECT_TRUE(isRefused([&] { readCells(file); }));
    writeCells(file, twoTriangles());
    replace("NumberOfPoints=\"4\"", "NumberOfPoints=\"3\"");
    EXPECT_TRUE(isRefused([&] { readCells(file); }));
}

TEST_F(DamagedFile, SurfacesWithTwoArraysOfOneNameAreRefused)
{
    writeCells(file, twoTriangles());
    const std::string bytes = readFile(file);
    const auto cells = bytes.find("<CellData"), begin = bytes.find("<DataArray", cells),
               end = bytes.find("/>", begin) + 2;
    ASSERT_LT(end, bytes.find("</CellData"));
    const std::string array = bytes.substr(begin, end - begin);
    replace(array, array + array);
    EXPECT_TRUE(isRefused([&] { readCells(file); }));
}

TEST_F(DamagedFile, SurfacesWhoseHeadersSayWhatTheirBytesDoNotAreRefused)
{
    writeCells(file, twoTriangles());
    const std::string sound = readFile(file);
    ASSERT_NO_THROW(readCells(file));
    for (const auto& [said, lie] : std::vector<std::pair<std::string, std::string>>{
             {"NumberOfComponents=\"3\"", "NumberOfComponents=\"0\""},
             {"NumberOfComponents=\"3\"", "NumberOfComponents=\"4\""},
             {"NumberOfComponents=\"3\"", "NumberOfComponents=\"3\" NumberOfTuples=\"9\""},
             {"type=\"UInt16\"", "type=\"Bit\""},
             {"type=\"UInt16\"", "type=\"UInt64\""},
             {"type=\"Int32\" Name=\"connectivity\"", "type=\"Int32\" Name=\"connectivity\" NumberOfComponents=\"0\""},
             {"type=\"Int32\" Name=\"offsets\"", "type=\"Int8\" Name=\"offsets\""},
             {"NumberOfPolys=\"2\"", "NumberOfPolys=\"3\""},
             {"NumberOfLines=\"0\"", "NumberOfLines=\"-1\""},
             {"header_type=\"UInt32\"", "header_type=\"UInt64\""},
             {"byte_order=\"LittleEndian\"", "byte_order=\"BigEndian\""},
             {"format=\"appended\"", "format=\"ascii\""},
             {"offset=\"0\"", "offset=\"4000000000\""},
             {"<Verts>", "<!-- --><Verts>"},
             {"<CellData>", "<CellData><DataArray type=\"UInt16\"/>"},
             {"encoding=\"raw\"", "encoding=\"base64\""}}) {
        replaceFile(file, sound);
        replace(said, lie);
        ASSERT_NE(readFile(file), sound) << said;
        EXPECT_TRUE(isRefused([&] { readCells(file); })) << lie;
    }
}

/// VTK asks for as many corners as the last cell's end says.
TEST_F(DamagedFile, SurfacesThatEndBehindTheirCornersAreRefused)
{
    writeCells(file, twoTriangles());
    std::string bytes = readFile(file);
    const std::string ends("\x08\0\0\0\x03\0\0\0\x06\0\0\0", 12);  // of the block: its bytes, 3, 6
    const auto at = bytes.rfind(ends);
    ASSERT_NE(at, std::string::npos);
    bytes[at + 11] = '\x7f';
    replaceFile(file, bytes);
    EXPECT_TRUE(isRefused([&] { readCells(file); }));
}

TEST_F(DamagedFile, TreesWithoutARootAreRefused)
{
    SkeletonTree tree;
    tree.branches.push_back({-2, 0, {{{0, 0, 0}, 0, 5}, {{0, 0, 3}, 3, 5}}});
    writeSkeletonTree(file, tree);
    EXPECT_TRUE(isRefused([&] { readSkeleton(file); }));
    EXPECT_TRUE(isRefused([&] { readSkeletonTree(file); }));
}

TEST_F(DamagedFile, SubdivisionsWithoutSenseAreRefused)
{
    Subdivision subdivision;
    subdivision.portals.emplace_back();
    writeSubdivision(file, subdivision);
    ASSERT_NO_THROW(readSubdivision(file));
    replace("\"parameters\": {}", "\"parameters\": " + std::string(1000000, '['));
    EXPECT_TRUE(isRefused([&] { readSubdivision(file); })) << "too deep to copy";
    replaceFile(file, R"({"method":"planes","parameters":{},"statistics":{},"segments":[],"portals":[]})");
    EXPECT_TRUE(isRefused([&] { readSubdivision(file); })) << "nothing is divided so";
    replaceFile(file,
                R"({"method":"none","parameters":{},"statistics":{},"segments":[],"portals":[{"between":[1e300,2]}]})");
    EXPECT_TRUE(isRefused([&] { readSubdivision(file); })) << "no whole number";
}

TEST_F(DamagedFile, DescriptionsThatAreNoneAreRefused)
{
    for (const std::string& text : {std::string("{"), std::string("[]"), "{\"organ\":" + std::string(1000000, '['),
                                    std::string(R"({"patient": 1})"), std::string(R"({"role": "scout"})"),
                                    std::string(R"({"steps": {"segment": {"version": 1}}})"),
                                    std::string(R"({"steps": ["segment"]})"), std::string(R"({"steps": 3})")}) {
        replaceFile(folder / "scan.json", text);
        EXPECT_TRUE(isRefused([&] { readDescription(folder.path()); })) << text.substr(0, 40);
        EXPECT_FALSE(isDescribedBy(folder.path(), {}));
    }
}

}  // namespace
}  // namespace vicon::scan_files
