// However many elements, items, fragments or frames a file has, and in whichever order: it costs next to nothing.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "import_fixture.h"
#include "measured_cost.h"
#include "transcode.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using namespace std::string_literals;
using namespace std::string_view_literals;
using Kind = ingest::ImportLine::Kind;

namespace {

std::string number(std::uint32_t value, int bytes)
{
    std::string out;
    for (int n = 0; n < bytes; ++n)
        out += char(value >> 8 * n & 0xff);
    return out;
}

/// An empty text of this tag, in explicit little endian.
std::string emptyText(std::uint32_t tag)
{
    return number(tag >> 16, 2) + number(tag & 0xffff, 2) + std::string("LO\0\0", 4);
}

constexpr std::uint32_t kFirstTag = 0x00291010;

std::string sorted(int count)
{
    std::string out;
    for (int n = 0; n < count; ++n)
        out += emptyText(kFirstTag + std::uint32_t(n));
    return out;
}

std::string descending(int count)
{
    std::string out;
    for (int n = count; n-- > 0;)
        out += emptyText(kFirstTag + std::uint32_t(n));
    return out;
}

/// The same tags again and again.
std::string cycling(int count, int tags)
{
    std::string out;
    for (int n = 0; n < count; ++n)
        out += emptyText(kFirstTag + std::uint32_t(n % tags));
    return out;
}

/// A sequence of so many items that hold this each.
std::string sequence(int items, const std::string& each)
{
    std::string all;
    for (int n = 0; n < items; ++n)
        all += "\xfe\xff\0\xe0"s + number(std::uint32_t(each.size()), 4) + each;
    return number(kFirstTag >> 16, 2) + number(kFirstTag & 0xffff, 2) + std::string("SQ\0\0", 4) +
           number(std::uint32_t(all.size()), 4) + all;
}

struct ElementsCase {
    const char* name;
    std::string (*elements)();  ///< put before the pixels
    bool head;                  ///< preamble and meta header; without them the reading is tried in the decoder program
    Kind kind;
    const char* words;
};

void PrintTo(const ElementsCase& c, std::ostream* out)
{
    *out << c.name;
}

constexpr const char* kTooMany = "has more than 10000 elements";
constexpr const char* kUnordered = "not in the order of their tags";

const ElementsCase kCases[] = {
    {"Descending", [] { return descending(100'000); }, true, Kind::refused, kUnordered},
    {"Sorted", [] { return sorted(100'000); }, true, Kind::refused, kTooMany},
    {"Many", [] { return sorted(900'000); }, true, Kind::refused, kTooMany},
    {"Cycling", [] { return cycling(900'000, 1'000); }, true, Kind::refused, kUnordered},
    {"Same", [] { return cycling(100'000, 1); }, true, Kind::refused, kUnordered},
    {"DescendingInItems", [] { return sequence(40, descending(1400)); }, true, Kind::refused, kUnordered},
    {"TooManyItems", [] { return sequence(900'000, ""); }, true, Kind::refused, "more than 500000 elements"},
    {"Items", [] { return sequence(490'000, ""); }, true, Kind::kept, "1 slice"},
    {"ElementsInItems", [] { return sequence(49, sorted(9'900)); }, true, Kind::kept, "1 slice"},
    {"RichHeader", [] { return sorted(9'000); }, true, Kind::kept, "1 slice"},
    {"HeadlessSorted", [] { return sorted(100'000); }, false, Kind::refused, "too many elements"},
    {"HeadlessDescending", [] { return descending(100'000); }, false, Kind::refused, "cannot be read safely"},
    // Counted as too many, or where the machine is busy ended by the reader's limit of processor time first.
    {"HeadlessInItems", [] { return sequence(5, descending(9'900)); }, false, Kind::refused, "elements"},
};

class EachHeader : public Import, public testing::WithParamInterface<ElementsCase> {};

TEST_P(EachHeader, CostsNextToNothingAndHasItsLine)
{
    const ElementsCase& c = GetParam();
    const fs::path file = writeSeries(folder / "in", {}, {0}).at(0);
    std::string bytes = readFile(file);
    bytes.insert(bytes.find("\xe0\x7f\x10\0OW"sv), c.elements());
    if (!c.head) {
        constexpr std::size_t kGroupLengthAt = 140, kMetaAt = 144;
        std::uint32_t meta_bytes = 0;
        for (std::size_t n = 4; n-- > 0;)
            meta_bytes = meta_bytes << 8 | std::uint8_t(bytes[kGroupLengthAt + n]);
        bytes.erase(0, kMetaAt + meta_bytes);
    }
    std::ofstream(file, std::ios::binary) << bytes;
    ingest::ImportReport report;
    expectBearable([&] { report = import({file}); }, c.name);
    EXPECT_TRUE(says(report, c.kind, c.words)) << lines(report);
    EXPECT_EQ(report.lines.size(), 1u) << lines(report);
}

INSTANTIATE_TEST_SUITE_P(Of, EachHeader, testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

class HostileElements : public Import {};

TEST_F(HostileElements, PixelsInManyFragmentsCostNextToNothing)
{
    const fs::path plain = writeSeries(folder / "plain", {}, {0}).at(0), file = folder / "fragments.dcm";
    transcode(plain, file, UID_JPEG2000LosslessOnlyTransferSyntax);
    std::string bytes = readFile(file);
    constexpr std::size_t kPixelHeaderBytes = 12;
    bytes.resize(bytes.find("\xe0\x7f\x10\0OB"sv) + kPixelHeaderBytes);
    const std::string empty = "\xfe\xff\0\xe0\0\0\0\0"s, fragment = "\xfe\xff\0\xe0\2\0\0\0ab"s;
    bytes += empty;
    for (int n = 0; n < 200'000; ++n)
        bytes += fragment;
    bytes += "\xfe\xff\xdd\xe0\0\0\0\0"s;
    std::ofstream(file, std::ios::binary) << bytes;
    ingest::ImportReport report;
    expectBearable([&] { report = import({file}); }, "fragments");
    EXPECT_TRUE(says(report, Kind::refused, "compressed")) << lines(report);
}

/// An object of so many frames, each described as the first is. What is to be said of all of them is changed before.
void writeManyFrames(const fs::path& file, int count, const std::function<void(DcmDataset&)>& change)
{
    SeriesSpec spec;
    spec.columns = spec.rows = 2;
    writeEnhanced(file, spec, {0, 1});
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(file.c_str()).good());
    DcmDataset& dataset = *format.getDataset();
    DcmSequenceOfItems* frames = nullptr;
    ASSERT_TRUE(dataset.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, frames).good());
    change(dataset);
    const DcmItem first(*frames->getItem(0));
    for (int n = 2; n < count; ++n)
        frames->append(new DcmItem(first));
    dataset.putAndInsertString(DCM_NumberOfFrames, std::to_string(count).c_str());
    const std::vector<Uint16> pixels(std::size_t(count) * 4, 1000);
    dataset.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    ASSERT_TRUE(format.saveFile(file.c_str(), EXS_LittleEndianExplicit).good());
}

constexpr int kFrames = 20'000;

TEST_F(HostileElements, ManyFramesCostNextToNothing)
{
    const fs::path file = folder / "frames.dcm";
    writeManyFrames(file, kFrames, [](DcmDataset&) {});
    ingest::ImportReport report;
    expectBearable([&] { report = import({file}); }, "frames");
    EXPECT_EQ(report.lines.size(), 1u) << lines(report);
}

/// Where frames do not say their type and their kernel, those of the whole object count: they are read once, however
/// long they are, and however many elements stand before them.
TEST_F(HostileElements, ManyFramesOfLongTextsCostNextToNothing)
{
    const fs::path file = folder / "frames.dcm";
    writeManyFrames(file, kFrames, [](DcmDataset& dataset) {
        const std::string text(60'000, 'A');
        dataset.putAndInsertString(DCM_ImageType, ("ORIGINAL\\PRIMARY\\AXIAL\\" + text).c_str());
        DcmItem* shared = nullptr;
        ASSERT_TRUE(dataset.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared).good());
        shared->findAndDeleteElement(DCM_CTReconstructionSequence);
        dataset.putAndInsertString(DCM_ConvolutionKernel, text.c_str());
        for (int n = 0; n < 9'000; ++n)
            dataset.insert(new DcmLongString(DcmTag(0x0009, Uint16(0x1000 + n), EVR_LO)));
    });
    ingest::ImportReport report;
    expectBearable([&] { report = import({file}); }, "long texts");
    EXPECT_EQ(report.lines.size(), 1u) << lines(report);
}

/// Parts that frames share are looked at once, too.
TEST_F(HostileElements, ManyFramesBehindManySharedElementsCostNextToNothing)
{
    const fs::path file = folder / "frames.dcm";
    writeManyFrames(file, kFrames, [](DcmDataset& dataset) {
        DcmItem *shared = nullptr, *measures = nullptr;
        ASSERT_TRUE(dataset.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared).good());
        ASSERT_TRUE(shared->findAndGetSequenceItem(DCM_PixelMeasuresSequence, measures).good());
        for (DcmItem* item : {shared, measures})
            for (int n = 0; n < 9'000; ++n)
                item->insert(new DcmLongString(DcmTag(0x0009, Uint16(0x1000 + n), EVR_LO)));
    });
    ingest::ImportReport report;
    expectBearable([&] { report = import({file}); }, "shared elements");
    EXPECT_EQ(report.lines.size(), 1u) << lines(report);
}

/// A million words, in a type whose length has four bytes: who is meant stays to be seen, and costs nothing for good.
TEST_F(HostileElements, ANameOfTenMegabytesIsCutAndSaid)
{
    const fs::path file = writeSeries(folder / "in", {}, {0}).at(0);
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(file.c_str()).good());
    std::string name = "Doe^Jane";
    for (int n = 0; name.size() < 10'000'000; ++n)
        name += " " + std::to_string(n);
    format.getDataset()->putAndInsertString(DCM_PatientName, name.c_str());
    format.getDataset()->putAndInsertString(DCM_SpecificCharacterSet, "\\ISO 2022 IR 87");
    ASSERT_TRUE(format.saveFile(file.c_str(), EXS_LittleEndianImplicit).good());
    ingest::ImportReport report;
    expectBearable([&] { report = import({file}); }, "a name");
    EXPECT_TRUE(says(report, Kind::repaired, "longer than 1024 bytes: cut")) << lines(report);
    const std::string kept = store.cases().at(0).patient.name;
    EXPECT_TRUE(kept.starts_with("Doe^Jane 0 1 2 ")) << kept.substr(0, 100);
    EXPECT_LE(kept.size(), 1100u);
    EXPECT_TRUE(kept.ends_with("…")) << kept.substr(kept.size() - 20);
}

struct NoNumber {
    DcmTagKey tag;
    std::string bytes;
    const char* words;
};

/// As a plain decimal string these are refused; written as bytes of an unknown kind they were numbers, and each voxel
/// 0.
TEST_F(HostileElements, WhatIsNoNumberIsNoneHoweverItIsWritten)
{
    const std::string infinite_mm = "-15\\-15\\inf";
    for (const NoNumber& c : {NoNumber{DCM_RescaleSlope, "nan ", "no Rescale Slope"},
                              NoNumber{DCM_RescaleSlope, "-inf", "no Rescale Slope"},
                              NoNumber{DCM_RescaleIntercept, "NAN(1)", "no Rescale Slope"},
                              NoNumber{DCM_ImagePositionPatient, infinite_mm + " ", "where in the patient it lies"},
                              NoNumber{DCM_PixelSpacing, "1\\nan ", "size of its pixels"}}) {
        const fs::path file = writeSeries(folder / "in", {}, {0}).at(0);
        DcmFileFormat format;
        ASSERT_TRUE(format.loadFile(file.c_str()).good());
        auto* const unknown = new DcmOtherByteOtherWord(DcmTag(c.tag, EVR_UN));
        unknown->putUint8Array(reinterpret_cast<const Uint8*>(c.bytes.data()), c.bytes.size());
        ASSERT_TRUE(format.getDataset()->insert(unknown, true).good());
        ASSERT_TRUE(format.saveFile(file.c_str(), EXS_LittleEndianExplicit).good());
        const auto report = import({file});
        EXPECT_TRUE(says(report, Kind::refused, c.words)) << c.bytes << "\n" << lines(report);
    }
}

}  // namespace
