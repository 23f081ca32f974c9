// What comes in cannot hurt.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include <fstream>

#include "helper.h"
#include "import_fixture.h"
#include "input_files.h"
#include "stored_files.h"
#include "stream_guard.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

/// The most address space that this program ever asked for.
long peakOfAddressesKb()
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmPeak:"))
            return std::stol(line.substr(7));
    return 0;
}

class Hostile : public Import {};

TEST_F(Hostile, ABadStudyBetweenGoodOnesCostsNothingElse)
{
    VICON_NEEDS_DATA("hostile");
    const auto report = import({support::sharedData("hostile/04-non-utf8-aborts-import/mixbad")});
    EXPECT_EQ(report.scans_stored, 3) << lines(report);
}

TEST_F(Hostile, AFolderWithoutFilesIsSaid)
{
    fs::create_directories(folder / "empty");
    const auto report = import({folder / "empty"});
    EXPECT_TRUE(says(report, Kind::refused, "nothing to import")) << lines(report);
    EXPECT_FALSE(report.anythingStored());
}

/// As what this user may not enter, but so for every user: a link to itself, a name that no file can have.
TEST_F(Hostile, WhatCannotBeLookedAtIsSaid)
{
    const fs::path in = folder / "in";
    writeSeries(in, {});
    fs::create_symlink("loop", in / "loop");
    const auto report = import({in, folder / std::string(300, 'x')});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.refused, 2) << lines(report);
    EXPECT_TRUE(says(report, Kind::refused, "cannot be looked at (Too many levels of symbolic links)"))
        << lines(report);
    EXPECT_TRUE(says(report, Kind::refused, "cannot be looked at (File name too long)")) << lines(report);
}

TEST_F(Hostile, ADicomdirAloneIsSaid)
{
    VICON_NEEDS_DATA("hostile");
    const auto report = import({support::sharedData("hostile/13-silence")});
    EXPECT_TRUE(says(report, Kind::refused, "nothing to import")) << lines(report);
}

TEST_F(Hostile, AFileThatADicomdirNamesOftenIsListedOnce)
{
    writeSeries(folder / "disc", {}, {0, 1});
    DcmFileFormat format;
    format.getDataset()->putAndInsertString(DCM_SOPClassUID, UID_MediaStorageDirectoryStorage);
    format.getDataset()->putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4");
    for (const char* name : {"0.dcm", "1.dcm", "0.DCM", "0.dcm"}) {
        DcmItem* record = nullptr;
        format.getDataset()->findOrCreateSequenceItem(DCM_DirectoryRecordSequence, record, -2);
        record->putAndInsertString(DCM_ReferencedFileID, name);
    }
    ASSERT_TRUE(format.saveFile((folder / "disc/DICOMDIR").c_str(), EXS_LittleEndianExplicit).good());
    std::vector<ingest::ImportLine> lines;
    EXPECT_EQ(ingest::listFiles({folder / "disc/DICOMDIR"}, lines).size(), 2u);
    EXPECT_TRUE(lines.empty());
}

/// Without its head a file is read by a library or not at all: the walk over its elements does not know its encoding.
TEST_F(Hostile, AFileThatKillsItsReaderIsRefusedAndKillsNothingElse)
{
    VICON_NEEDS_DATA("hostile");
    constexpr std::size_t kMeta = 132, kGroupLength = 12;
    for (const char* name : {"nest_d6000.dcm", "nest_u10000.dcm"}) {
        const std::string whole = readFile(support::sharedData("hostile/03-nested-sequences-segv") / name);
        const auto meta_bytes = std::uint8_t(whole[kMeta + 8]) + 256u * std::uint8_t(whole[kMeta + 9]);
        std::ofstream(folder / name, std::ios::binary) << whole.substr(kMeta + kGroupLength + meta_bytes);
        const auto report = import({folder / name});
        ASSERT_EQ(report.lines.size(), 1u);
        EXPECT_EQ(report.lines.front().kind, Kind::refused);
        EXPECT_NE(report.lines.front().text.find("cannot be read safely"), std::string::npos) << lines(report);
    }
}

/// What /proc says under this word of the one program that this process started.
std::string ofOnlyChild(const std::string& word)
{
    const auto valueIn = [](const fs::path& status, const std::string& name) {
        std::ifstream in(status);
        for (std::string line; std::getline(in, line);)
            if (line.starts_with(name + ":\t"))
                return line.substr(name.size() + 2);
        return std::string();
    };
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator("/proc"))
        if (valueIn(entry.path() / "status", "PPid") == std::to_string(::getpid()))
            found.push_back(valueIn(entry.path() / "status", word));
    return found.size() == 1 ? found.front() : std::to_string(found.size()) + " children";
}

TEST_F(Hostile, TheDecoderProgramIsConfined)
{
    ingest::endIdleHelpers();
    EXPECT_EQ(ingest::whyHarmful(writeSeries(folder / "in", {}, {0}).at(0)), "");
    EXPECT_EQ(ofOnlyChild("NoNewPrivs"), "1");
    EXPECT_EQ(ofOnlyChild("Seccomp"), "2") << "a filter of system calls";
    ingest::endIdleHelpers();
}

/// A value that breaks off with the file stays in the library's data set with the length that it claims.
TEST_F(Hostile, NoMemoryIsAskedForAValueThatTheFileCannotHold)
{
    const fs::path claims = folder / "claims.dcm";
    std::string headless{'\0', '\x08', '\0', '\x05'};
    headless.append(400, '\xf6');
    std::ofstream(claims, std::ios::binary) << headless;
    const long before_kb = peakOfAddressesKb();
    const auto report = import({claims});
    EXPECT_TRUE(says(report, Kind::refused, "damaged beyond reading")) << lines(report);
    EXPECT_LT(peakOfAddressesKb() - before_kb, 1'000'000);
}

/// The same in the meta header, where a damaged kind made a library spell out 775 million bytes that are not there.
TEST_F(Hostile, NoTextIsMadeOfAMetaHeadersValueThatTheFileCannotHold)
{
    const fs::path claims = folder / "claims.dcm";
    const auto bytes = [](std::string_view text) { return std::string(text); };
    using namespace std::string_view_literals;
    std::ofstream(claims, std::ios::binary)
        << std::string(128, '\0') << "DICM" << bytes("\2\0\0\0UL\4\0\x8e\0\0\0"sv)
        << bytes("\xff\xff\xff\xffOB\0\0\2\0\0\0\0\1"sv) << bytes("\2\0\2\0QI\x1a\0"sv)
        << bytes("1.2.840.10008.5.1.4.1.1.2\0"sv) << bytes("\2\0\3\0UI\4\0001.2\0"sv)
        << bytes("\2\0\x10\0UI\x14\0001.2.840.10008.1.2.1\0"sv);
    const long before_kb = peakOfAddressesKb();
    const auto report = import({claims});
    EXPECT_TRUE(says(report, Kind::refused, "truncated or damaged")) << lines(report);
    EXPECT_LT(peakOfAddressesKb() - before_kb, 1'000'000);
}

TEST_F(Hostile, ZerosAreNoDicom)
{
    const fs::path zeros = folder / "zeros.bin";
    std::ofstream(zeros) << "";
    fs::resize_file(zeros, 1 << 30);
    const auto report = import({zeros});
    EXPECT_TRUE(says(report, Kind::refused, "no DICOM file")) << lines(report);
}

TEST_F(Hostile, NoControlCharacterOfAnyTextIsLeft)
{
    VICON_NEEDS_DATA("hostile");
    const auto report = import({support::sharedData("hostile/09-terminal")});
    std::string all = lines(report);
    std::erase(all, '\n');  // between the lines
    for (const CaseRecord& c : store.cases()) {
        all += c.patient.name + c.patient.id + c.study.uid + c.study.description;
        for (const ScanRecord& s : store.scans(c.id))
            all += s.series.uid + s.series.kernel + s.series.description + s.ingest.dump();
    }
    EXPECT_TRUE(std::none_of(all.begin(), all.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; })) << all;
}

TEST_F(Hostile, ANameInLatin1IsTakenAndShownInUtf8)
{
    const std::string name = "caf\xe9";
    writeSeries(folder / name, {});
    const auto broken = folder / name / "na\xefve.dcm";
    std::ofstream(broken) << "no DICOM at all";
    const auto report = import({folder / name});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_TRUE(says(report, Kind::refused, "no DICOM file")) << lines(report);
    for (const auto& line : report.lines)
        EXPECT_NO_THROW((void)nlohmann::json(line.subject).dump());
}

TEST_F(Hostile, TwoAcquisitionsInOneSeriesAreTwoScans)
{
    VICON_NEEDS_DATA("hostile");
    const fs::path root = support::sharedData("hostile/11-mixed-series");
    for (const char* name : {"g_supine_then_prone_in_one_series", "g_interleaved_acq", "g_interleaved_kernel"}) {
        CaseStore own(folder / name);
        const auto report = ingest::importPaths(own, {root / name}, options, quiet);
        EXPECT_EQ(own.scans(own.cases().at(0).id).size(), 2u) << name << "\n" << lines(report);
    }
}

/// Found by the fuzzer of streams: without its end the decoder read on for four seconds.
TEST_F(Hostile, AJpegLsStreamWithoutItsEndIsNotDecoded)
{
    const std::string frame("\xff\xd8\xff\xf7\0\x0b\x10\0\x10\0\x10\x01\x01\x11\0", 15);
    const std::string scan("\xff\xda\0\x08\x01\x01\0\0\0\0\x30\x0c\x03\x80\x30\x0c\x03\x10", 18);
    ingest::PixelFormat format;
    format.columns = format.rows = 16;
    format.bits_allocated = format.bits_stored = 16;
    format.high_bit = 15;
    constexpr const char* kJpegLs = "1.2.840.10008.1.2.4.80";
    EXPECT_EQ(ingest::whyNotDecodable(frame + scan, format, kJpegLs), "its compressed pixels are cut off");
    EXPECT_EQ(ingest::whyNotDecodable(frame + scan + "\xff\xd9", format, kJpegLs), "");
    EXPECT_EQ(ingest::whyNotDecodable(frame + scan + std::string("\xff\xd9\0", 3), format, kJpegLs), "") << "padded";
}

TEST_F(Hostile, ARefusedVolumeTellsOfNoInterpolation)
{
    SeriesSpec spec;
    spec.slices = 20;
    std::vector<int> with_gaps{0, 1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19};
    writeSeries(folder / "in", spec, with_gaps);
    import({folder / "in"});
    const ScanRecord scan = onlyScan();
    ASSERT_EQ(scan.role, ScanRole::refused);
    EXPECT_EQ(scan.ingest["repairs"].dump().find("interpolated"), std::string::npos) << scan.ingest.dump();
    EXPECT_FALSE(scan.ingest["geometry"].contains("interpolated_slices"));
}

TEST_F(Hostile, AFullDiskIsTheStoresTroubleAndNotTheFiles)
{
    const Error full = ingest::notCopied("/cd/IM1", "/store/cases/c1/.part", ENOSPC);
    EXPECT_EQ(full.subject(), "/store/cases/c1");
    EXPECT_NE(full.remedy().find("free some space"), std::string::npos);
    EXPECT_EQ(ingest::notCopied("/cd/IM1", "/store/cases/c1/.part", EIO).subject(), "/cd/IM1");
}

TEST_F(Hostile, OneFlagForACaseHoweverManyShareTheId)
{
    constexpr int kStudies = 12;
    for (int n = 0; n < kStudies; ++n) {
        SeriesSpec spec;
        spec.study_uid += "." + std::to_string(n);
        spec.series_uid = spec.study_uid + ".1";
        spec.patient_name = "Name^" + std::string(1, char('A' + n));
        writeSeries(folder / "in" / std::to_string(n), spec);
    }
    import({folder / "in"});
    ASSERT_EQ(store.cases().size(), std::size_t(kStudies));
    for (const CaseRecord& c : store.cases())
        EXPECT_EQ(c.flags.size(), 1u) << c.id;
}

}  // namespace
