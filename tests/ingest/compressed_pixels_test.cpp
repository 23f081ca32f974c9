// Where a compressed stream and the header disagree on its samples.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <functional>

#include "import_fixture.h"
#include "transcode.h"
#include "vicon/dicom/dicom_setup.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using namespace std::string_literals;
using Kind = ingest::ImportLine::Kind;

namespace {

constexpr const char* kJpeg2000 = "1.2.840.10008.1.2.4.90";

class CompressedPixels : public Import {
protected:
    void SetUp() override { setUpDicom(); }

    /// A series in this encoding, its files changed by hand.
    fs::path writeEncoded(const SeriesSpec& spec, const std::string& syntax,
                          const std::function<void(std::string&)>& change)
    {
        for (const fs::path& plain : writeSeries(folder / "plain", spec)) {
            const fs::path file = folder / syntax / plain.filename();
            fs::create_directories(file.parent_path());
            transcode(plain, file, syntax);
            std::string bytes = readFile(file);
            change(bytes);
            std::ofstream(file, std::ios::binary) << bytes;
        }
        return folder / syntax;
    }
};

void replaceOnce(std::string& bytes, const std::string& from, const std::string& to)
{
    const std::size_t at = bytes.find(from);
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, from.size(), to);
}

/// The values themselves are in its streams of 12 bits: where they would lie in a longer cell says nothing of them.
TEST_F(CompressedPixels, MeanTheSameWhicheverHighBitTheHeaderNames)
{
    VICON_NEEDS_DATA("dicom");
    const fs::path series = support::sharedData("dicom/j2k-series");
    std::array<HuVolume, 2> read;
    for (const int other : {0, 1}) {
        const fs::path in = folder / std::to_string(other);
        fs::create_directories(in);
        for (const auto& entry : fs::directory_iterator(series)) {
            std::string bytes = readFile(entry.path());
            if (other)
                replaceOnce(bytes, "\x28\0\x02\x01US\x02\0\x0b\0"s, "\x28\0\x02\x01US\x02\0\x0f\0"s);
            std::ofstream(in / entry.path().filename(), std::ios::binary) << bytes;
        }
        CaseStore own(folder / ("store" + std::to_string(other)));
        const auto report = ingest::importPaths(own, {in}, options, quiet);
        ASSERT_TRUE(report.anythingStored()) << lines(report);
        const ScanRecord scan = own.scans(own.cases().at(0).id).at(0);
        read.at(other) = ingest::loadScan(own.scanFolder(scan.case_id, scan.id) / "dicom", options, quiet);
    }
    EXPECT_EQ(read[0].voxels, read[1].voxels);
}

/// Read as unsigned ones they would be denser than any metal.
TEST_F(CompressedPixels, SignedOnesInAnUnsignedImageAreRefused)
{
    const fs::path in = writeEncoded({}, kJpeg2000, [](std::string& bytes) {
        constexpr std::size_t kSampleAt = 40;  // of the first component, from the marker
        const std::size_t size_at = bytes.find("\xff\x4f\xff\x51");
        ASSERT_NE(size_at, std::string::npos);
        bytes.at(size_at + 2 + kSampleAt) = char(bytes.at(size_at + 2 + kSampleAt) | 0x80);
    });
    const auto report = import({in});
    EXPECT_TRUE(says(report, Kind::refused, "holds signed samples, its header says unsigned")) << lines(report);
    EXPECT_EQ(report.scans_stored, 0) << lines(report);
}

}  // namespace
