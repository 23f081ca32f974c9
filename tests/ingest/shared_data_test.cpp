#include <gdcmImageReader.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <set>

#include "store_fixture.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

/// What the import rules (docs/admin/import-rules.md) make of a file or folder, imported alone into an empty store.
struct DataCase {
    const char* path;
    Kind kind;
    const char* words;
};

void PrintTo(const DataCase& c, std::ostream* out)
{
    *out << c.path;
}

const DataCase kCases[] = {
    {"ct64", Kind::stored, "79 slices, 3.99 mm apart, supine; queued"},
    {"j2k-series", Kind::stored, "20 slices, 2.00 mm apart, supine; queued"},
    {"geometry/gantrytilting", Kind::kept, "4 slices, 4.85 mm apart, supine"},
    {"geometry/notavolume", Kind::refused, "up to 4 different images at one place (at z = 61.5 mm)"},
    {"geometry/sliceincrement/001", Kind::refused, "1 slice missing at z = 33.1 mm (5.0 mm not measured), more than"},
    {"geometry/sliceincrement/002", Kind::kept, "4 slices, 0.75 mm apart"},
    {"geometry/slicecount", Kind::kept, "2 slices, fewer than the 10 of a scan"},        // MR
    {"geometry/sliceorientation", Kind::kept, "2 slices, fewer than the 10 of a scan"},  // MR
    {"syntaxes/LICENSE", Kind::refused, "no DICOM file"},
    {"syntaxes/CTImage.dcm", Kind::kept, "1 slice, supine; not queued"},
    {"syntaxes/CTImage.dcm_BigEndianExplicitTransferSyntax_1.2.840.10008.1.2.2.dcm", Kind::kept,
     "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_DeflatedExplicitVRLittleEndianTransferSyntax_1.2.840.10008.1.2.1.99.dcm", Kind::kept,
     "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_JPEG2000LosslessOnlyTransferSyntax_1.2.840.10008.1.2.4.90.dcm", Kind::kept,
     "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_JPEG2000TransferSyntax_1.2.840.10008.1.2.4.91.dcm", Kind::kept, "lossy compression"},
    {"syntaxes/CTImage.dcm_JPEGLSLosslessTransferSyntax_1.2.840.10008.1.2.4.80.dcm", Kind::kept,
     "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_JPEGLSLossyTransferSyntax_1.2.840.10008.1.2.4.81.dcm", Kind::kept, "lossy compression"},
    {"syntaxes/CTImage.dcm_JPEGProcess10_12TransferSyntax_1.2.840.10008.1.2.4.55.dcm", Kind::kept, "lossy compression"},
    {"syntaxes/CTImage.dcm_JPEGProcess14SV1TransferSyntax_1.2.840.10008.1.2.4.70.dcm", Kind::kept,
     "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_JPEGProcess14TransferSyntax_1.2.840.10008.1.2.4.57.dcm", Kind::kept, "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_JPEGProcess1TransferSyntax_1.2.840.10008.1.2.4.50.dcm", Kind::kept, "lossy compression"},
    {"syntaxes/CTImage.dcm_JPEGProcess2_4TransferSyntax_1.2.840.10008.1.2.4.51.dcm", Kind::kept, "lossy compression"},
    {"syntaxes/CTImage.dcm_JPEGProcess6_8TransferSyntax_1.2.840.10008.1.2.4.53.dcm", Kind::kept, "lossy compression"},
    {"syntaxes/CTImage.dcm_LittleEndianExplicitTransferSyntax_1.2.840.10008.1.2.1.dcm", Kind::kept,
     "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_LittleEndianImplicitTransferSyntax_1.2.840.10008.1.2.dcm", Kind::kept,
     "1 slice, supine; not"},
    {"syntaxes/CTImage.dcm_RLELosslessTransferSyntax_1.2.840.10008.1.2.5.dcm", Kind::kept, "1 slice, supine; not"},
    {"broken/CT_small.dcm", Kind::kept, "1 slice, supine; not queued"},
    {"broken/J2K_pixelrep_mismatch.dcm", Kind::kept, "1 slice, supine; not queued"},
    {"broken/ExplVR_BigEndNoMeta.dcm", Kind::set_aside, "RTIonPlanStorage (RTPLAN)"},
    {"broken/ExplVR_LitEndNoMeta.dcm", Kind::set_aside, "RTIonPlanStorage (RTPLAN)"},
    {"broken/MR_small.dcm", Kind::kept, "1 slice, fewer than the 10 of a scan"},
    {"broken/MR_truncated.dcm", Kind::refused, "truncated or damaged"},
    {"broken/SC_rgb_jpeg_dcmtk.dcm", Kind::set_aside, "SecondaryCaptureImageStorage (OT)"},
    {"broken/UN_sequence.dcm", Kind::refused, "it has no pixels"},
    {"broken/badVR.dcm", Kind::set_aside, "RTDoseStorage (RTDOSE)"},
    {"broken/empty_charset_LEI.dcm", Kind::refused, "does not say what it is"},
    {"broken/image_dfl.dcm", Kind::set_aside, "SecondaryCaptureImageStorage (OT)"},
    {"broken/liver_1frame.dcm", Kind::set_aside, "SegmentationStorage (SEG)"},
    {"broken/meta_missing_tsyntax.dcm", Kind::refused, "does not say what it is"},
    {"broken/nested_priv_SQ.dcm", Kind::refused, "does not say what it is"},
    {"broken/no_meta.dcm", Kind::refused, "damaged beyond reading"},
    {"broken/no_meta_group_length.dcm", Kind::set_aside, "RTImageStorage"},
    {"broken/priv_SQ.dcm", Kind::refused, "it has no pixels"},
    {"broken/reportsi.dcm", Kind::set_aside, "BasicTextSRStorage (SR)"},
    {"broken/rtdose.dcm", Kind::set_aside, "RTDoseStorage (RTDOSE)"},
    {"broken/rtplan_truncated.dcm", Kind::refused, "truncated or damaged"},
    {"broken/zipMR.gz", Kind::refused, "a gzip file"},
    {"charsets", Kind::set_aside, "SecondaryCaptureImageStorage (OT)"},
};

class SharedData : public StoreFixture {};
class EachFile : public StoreFixture, public testing::WithParamInterface<DataCase> {};

TEST_P(EachFile, IsImportedSetAsideOrRefusedAsTheRulesSay)
{
    VICON_NEEDS_DATA("dicom");
    const DataCase& c = GetParam();
    const auto report = import({support::sharedData("dicom") / c.path});
    EXPECT_TRUE(says(report, c.kind, c.words)) << lines(report);
    EXPECT_EQ(report.anythingStored(), c.kind == Kind::stored || c.kind == Kind::kept) << lines(report);
    for (const CaseRecord& a_case : store.cases())
        for (const ScanRecord& scan : store.scans(a_case.id)) {
            if (scan.role == ScanRole::refused)
                EXPECT_THROW(load(scan), Error);
            else
                EXPECT_EQ(load(scan).grid.size, (scan.ingest["geometry"]["size"].get<std::array<int, 3>>()));
        }
}

INSTANTIATE_TEST_SUITE_P(OfTheData, EachFile, testing::ValuesIn(kCases));

TEST_F(SharedData, TheTableCoversEveryFile)
{
    VICON_NEEDS_DATA("dicom");
    const fs::path root = support::sharedData("dicom");
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        if (!entry.is_regular_file())
            continue;
        const std::string path = fs::relative(entry.path(), root).string();
        EXPECT_TRUE(std::any_of(std::begin(kCases), std::end(kCases), [&](const DataCase& c) {
            return path == c.path || path.starts_with(c.path + std::string("/"));
        })) << path;
    }
}

/// The last bytes of a file as little-endian pixels: of an uncompressed object that ends with its pixels, they are it.
std::vector<std::int16_t> lastPixels(const fs::path& file, std::size_t count)
{
    const std::string bytes = readFile(file);
    std::vector<std::int16_t> pixels(count);
    std::memcpy(pixels.data(), bytes.data() + bytes.size() - count * 2, count * 2);
    return pixels;
}

TEST_F(SharedData, LosslessEncodingsGiveIdenticalVoxelsAndLossyOnesAreNear)
{
    VICON_NEEDS_DATA("dicom/syntaxes");
    const fs::path root = support::sharedData("dicom/syntaxes");
    std::vector<std::int16_t> expected = lastPixels(root / "CTImage.dcm", 512 * 512);
    for (std::int16_t& value : expected)  // outside the field of view lies -2000, which the header does not declare
        value = value == -2000 ? kPaddingHu : std::int16_t(value - 1024);
    int lossless = 0, lossy = 0;
    for (const auto& entry : fs::directory_iterator(root)) {
        if (entry.path().extension() != ".dcm")
            continue;
        const support::TemporaryFolder own;
        CaseStore single(own / "store");
        ingest::importPaths(single, {entry.path()}, options, quiet);
        const ScanRecord scan = single.scans(single.cases().at(0).id).at(0);
        const HuVolume volume = ingest::loadScan(single.scanFolder(scan.case_id, scan.id) / "dicom", options, quiet);
        if (!scan.series.lossy) {
            ++lossless;
            EXPECT_EQ(volume.voxels, expected) << entry.path();
            continue;
        }
        ++lossy;
        double sum = 0;
        for (std::size_t n = 0; n < expected.size(); ++n)
            sum += std::abs(volume.voxels[n] - expected[n]);
        EXPECT_LT(sum / double(expected.size()), 20) << entry.path();
        EXPECT_NE(volume.voxels, expected) << entry.path();
    }
    EXPECT_EQ(lossless, 10);
    EXPECT_EQ(lossy, 6);
}

TEST_F(SharedData, AnUncompressedSeriesHasTheDensitiesOfItsFiles)
{
    VICON_NEEDS_DATA("dicom/ct64");
    const fs::path root = support::sharedData("dicom/ct64");
    import({root});
    const HuVolume volume = load(onlyScan());
    for (const int slice : {0, 1, 40, 78}) {
        char name[32];
        std::snprintf(name, sizeof name, "IMG%04d.dcm", slice + 1);
        const auto expected = lastPixels(root / name, 64 * 64);
        const auto begin = volume.voxels.begin() + slice * 64 * 64;
        EXPECT_EQ(std::vector(begin, begin + 64 * 64), expected) << name;
    }
    EXPECT_NEAR(volume.grid.origin_mm.z, -360.256, 1e-6);
}

TEST_F(SharedData, Jpeg2000SlicesHaveTheDensitiesThatGdcmReads)
{
    VICON_NEEDS_DATA("dicom/j2k-series");
    const fs::path root = support::sharedData("dicom/j2k-series");
    import({root});
    const HuVolume volume = load(onlyScan());
    int compared = 0;
    for (const auto& entry : fs::directory_iterator(root)) {
        gdcm::ImageReader reader;
        reader.SetFileName(entry.path().c_str());
        ASSERT_TRUE(reader.Read());
        const gdcm::Image& image = reader.GetImage();
        std::vector<std::uint16_t> stored(512 * 512);
        ASSERT_EQ(image.GetBufferLength(), stored.size() * 2);
        ASSERT_TRUE(image.GetBuffer(reinterpret_cast<char*>(stored.data())));
        const int k = int(std::lround((image.GetOrigin(2) - volume.grid.origin_mm.z) / volume.grid.spacing_mm[2]));
        std::size_t wrong = 0;
        for (std::size_t n = 0; n < stored.size(); ++n)
            wrong += volume.voxels[std::size_t(k) * stored.size() + n] != int(stored[n]) - 1024 ? 1 : 0;
        EXPECT_EQ(wrong, 0u) << k;
        ++compared;
    }
    EXPECT_EQ(compared, 20);
}

TEST_F(SharedData, SignsOfJpeg2000AreThoseOfTheHeader)
{
    VICON_NEEDS_DATA("dicom/broken");
    import({support::sharedData("dicom/broken/J2K_pixelrep_mismatch.dcm")});
    const HuVolume volume = load(onlyScan());
    // The stream says unsigned, the header signed with 13 bits: read as the stream says, gas and fat would be bone.
    const auto [least, most] = std::minmax_element(volume.voxels.begin(), volume.voxels.end());
    EXPECT_LT(*least, -1000);
    EXPECT_LT(*most, 2500);
    EXPECT_EQ(volume.voxels.front(), kPaddingHu);  // -2000 in the corner
}

TEST_F(SharedData, ARealScanIsDecodedAsDcmtksToolDecodesIt)
{
    VICON_NEEDS_DATA("ctc-prone");
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(support::sharedData("ctc-prone")))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    const fs::path plain = folder / "plain.dcm";
    ASSERT_EQ(support::runCommand("dcmdjpls " + files[17].string() + " " + plain.string()).exit_code, 0);
    options.min_slices = 2;
    import({files[17]});
    const HuVolume volume = load(onlyScan());
    std::vector<std::int16_t> expected = lastPixels(plain, 512 * 512);
    std::size_t padded = 0;
    for (std::int16_t& value : expected) {
        padded += value == -2000 ? 1 : 0;
        value = value == -2000 ? kPaddingHu : std::int16_t(value - 1024);
    }
    EXPECT_EQ(volume.voxels, expected);
    EXPECT_GT(padded, 10000u);
}

}  // namespace
