// Files that VICON's walk over their elements and DCMTK could read in two ways: what one sees as a long value is for
// the other sixty thousand sequences, one within the other, which end a process that reads them.
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "dataset.h"
#include "import_fixture.h"
#include "structure_scan.h"
#include "transcode.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"
#include "wire.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using namespace vicon::test::wire;
using Fate = ingest::Structure::Fate;
using Kind = ingest::ImportLine::Kind;

namespace {

constexpr int kLevels = 60'000;
const std::string kCt = "1.2.840.10008.5.1.4.1.1.2", kImplicitUid = "1.2.840.10008.1.2",
                  kExplicitUid = "1.2.840.10008.1.2.1", kBigEndianUid = "1.2.840.10008.1.2.2";

const std::string kPreamble = std::string(128, '\0').append("DICM");

/// How a value is written: tag, type, length.
enum class Form { implicit, plain, big_endian };

std::string written(std::uint64_t value, int bytes, Form form)
{
    return form == Form::big_endian ? bigEndian(value, bytes) : littleEndian(value, bytes);
}

std::string tagAs(int group, int number, Form form)
{
    return written(std::uint64_t(group), 2, form) + written(std::uint64_t(number), 2, form);
}

std::string shortElement(int group, int number, const std::string& vr, std::string value, Form form = Form::plain)
{
    if (value.size() % 2 != 0)
        value += '\0';
    return tagAs(group, number, form) + vr + written(value.size(), 2, form) + value;
}

std::string longElement(int group, int number, const std::string& vr, const std::string& value, Form form = Form::plain)
{
    return tagAs(group, number, form) + vr + "\0\0"s + written(value.size(), 4, form) + value;
}

/// Sequences one within the other, none of which says its length, and none of which ends.
std::string deep(Form form)
{
    const std::string level = tagAs(0x11, 0x1010, form) + (form == Form::implicit ? ""s : "SQ\0\0"s) +
                              "\xff\xff\xff\xff"s + tagAs(0xfffe, 0xe000, form) + "\xff\xff\xff\xff"s;
    std::string out;
    for (int n = 0; n < kLevels; ++n)
        out += level;
    return out;
}

/// A head around the elements of group 2 that follow the length.
std::string head(const std::string& elements)
{
    return kPreamble + shortElement(2, 0, "UL", littleEndian(elements.size(), 4)) + elements;
}

const std::string kIdentity = shortElement(2, 2, "UI", kCt) + shortElement(2, 3, "UI", "1.2.3");

std::string headIn(const std::string& syntax)
{
    return head(kIdentity + shortElement(2, 0x10, "UI", syntax));
}

/// In little endian a text of 2560 bytes and a value of bytes; in big endian the sequences.
std::string littleOrBig()
{
    constexpr std::size_t kText = 2568, kLongHead = 12;
    std::string out = shortElement(8, 5, "CS", "ISO_IR 100", Form::big_endian);
    const std::string filler(kText - out.size() - 2 * kLongHead, '\0'), nest = deep(Form::big_endian);
    out += longElement(9, 0x1001, "UN", filler, Form::big_endian);
    out += tagAs(9, 0x1002, Form::big_endian) + "UN\0\0"s + bigEndian(kLongHead, 4);
    return out + longElement(9, 0x1001, "OB", nest);
}

/// With types a value of bytes; without them a value whose length are the letters of its type, and the sequences.
std::string typedOrNot()
{
    constexpr std::size_t kLettersOb = 0x424f;
    return longElement(9, 0x1001, "OB", std::string(kLettersOb - 4, '\0') + deep(Form::implicit));
}

/// In implicit big endian one value of bytes; in little endian a shorter one, and the sequences.
std::string shortOrLong()
{
    constexpr std::size_t kBig = 0x0f0000, kLittle = 0x000f00;
    std::string value = std::string(kLittle, '\0') + deep(Form::implicit);
    value.resize(kBig);
    return tag(9, 0x1001) + bigEndian(kBig, 4) + value;
}

std::string item(const std::string& content)
{
    return tag(0xfffe, 0xe000) + littleEndian(content.size(), 4) + content;
}

const std::string kSequenceEnd = tag(0xfffe, 0xe0dd) + "\0\0\0\0"s;
const std::string kUndefined = "\xff\xff\xff\xff"s;

std::string beginning(Form form)
{
    return form == Form::implicit ? element(8, 0x60, "CT") : shortElement(8, 0x60, "CS", "CT");
}

std::string pixelsOf(const std::string& vr, Form form)
{
    return headIn(kExplicitUid) + beginning(Form::plain) + tag(0x7fe0, 0x10) + vr + "\0\0"s + kUndefined +
           item(deep(form)) + kSequenceEnd;
}

struct TwoReadings {
    const char* name;
    std::string (*bytes)();
};

void PrintTo(const TwoReadings& c, std::ostream* out)
{
    *out << c.name;
}

const TwoReadings kCases[] = {
    {"SyntaxTwice",
     [] {
         return head(kIdentity + shortElement(2, 0x10, "UI", kBigEndianUid) +
                     shortElement(2, 0x10, "UI", kExplicitUid)) +
                littleOrBig();
     }},
    {"UnknownSyntax", [] { return headIn("1.2.3.4.5") + littleOrBig(); }},
    {"NoSyntax", [] { return head(kIdentity) + littleOrBig(); }},
    {"NoSyntaxAndNoTypes", [] { return head(kIdentity) + shortOrLong(); }},
    {"EmptySyntax", [] { return headIn("") + shortOrLong(); }},
    {"SyntaxByName", [] { return headIn("Big Endian Explicit") + littleOrBig(); }},
    {"SyntaxWithASpace", [] { return headIn("1.2.840.1 0008.1.2.2") + littleOrBig(); }},
    {"SyntaxBehindASpace", [] { return headIn(" " + kBigEndianUid) + littleOrBig(); }},
    {"SyntaxBeforeAZero", [] { return headIn(kBigEndianUid + "\0x"s) + littleOrBig(); }},
    {"SyntaxAsBytes",
     [] { return head(kIdentity + longElement(2, 0x10, "OB", kExplicitUid + "\0"s)) + littleOrBig(); }},
    {"SyntaxOfGe", [] { return headIn("1.2.840.113619.5.2") + typedOrNot(); }},
    {"SyntaxWithinASequence",
     [] {
         return head(kIdentity + longElement(2, 0x99, "SQ", item(shortElement(2, 0x10, "UI", kBigEndianUid)))) +
                littleOrBig();
     }},
    {"DeepMetaHeader",
     [] {
         const std::string nest = tag(0xfffe, 0xe000) + kUndefined + deep(Form::plain);
         return head(kIdentity + shortElement(2, 0x10, "UI", kExplicitUid) + longElement(2, 0x99, "SQ", nest)) +
                beginning(Form::plain);
     }},
    {"MetaHeaderTooLong",
     [] {
         const std::string meta = kIdentity + shortElement(2, 0x10, "UI", kImplicitUid);
         const std::string opaque = element(9, 0x1001, std::string(0x424f - 8, '\0'));
         return kPreamble + shortElement(2, 0, "UL", littleEndian(meta.size() + opaque.size(), 4)) + meta + opaque;
     }},
    {"MetaHeaderTooShort",
     [] {
         const std::string meta = kIdentity + shortElement(2, 0x10, "UI", kImplicitUid);
         return kPreamble + shortElement(2, 0, "UL", littleEndian(meta.size(), 4)) + meta +
                longElement(2, 0x102, "OB", std::string(0x424f - 4, '\0') + deep(Form::implicit)) +
                beginning(Form::implicit);
     }},
    {"MetaHeaderWithoutLength",
     [] {
         return kPreamble + kIdentity + shortElement(2, 0x10, "UI", kExplicitUid) +
                longElement(0x200, 0x1001, "OB", deep(Form::plain));
     }},
    {"SequenceEndsWithinItsLength",
     [] {
         return headIn(kImplicitUid) + beginning(Form::implicit) +
                element(8, 0x1140, kSequenceEnd + deep(Form::implicit));
     }},
    {"SequenceShorterThanAnItem",
     [] {
         const std::string nest = deep(Form::implicit);
         return headIn(kImplicitUid) + beginning(Form::implicit) + element(8, 0x1140, tag(0xfffe, 0xe000)) + tag(8, 0) +
                littleEndian(nest.size() + 4, 4) + "\0\0\0\0"s + nest;
     }},
    {"PixelsAsASequence", [] { return pixelsOf("SQ", Form::plain); }},
    {"PixelsOfNoType", [] { return pixelsOf("UN", Form::implicit); }},
};

class EachOtherReading : public Import, public testing::WithParamInterface<TwoReadings> {};

TEST_P(EachOtherReading, HasItsLineAndEndsNothing)
{
    setUpDicom();
    const fs::path hostile = folder / "hostile.dcm";
    std::ofstream(hostile, std::ios::binary) << GetParam().bytes();
    EXPECT_NE(int(ingest::scanStructure(hostile).fate), int(Fate::clear));
    writeSeries(folder / "good", {});
    const auto report = import({hostile, folder / "good"});
    EXPECT_EQ(report.refused, 1) << lines(report);
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
}

INSTANTIATE_TEST_SUITE_P(Of, EachOtherReading, testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

class OneReading : public Import {};

/// What is not deflated is followed to its end, and needs no program that tries it.
TEST_F(OneReading, IsThatOfGoodFilesInEveryEncoding)
{
    setUpDicom();
    const fs::path plain = writeSeries(folder / "plain", {}, {0}).at(0), file = folder / "encoded.dcm";
    for (const std::string syntax : kEncodings) {
        transcode(plain, file, syntax);
        const ingest::Structure found = ingest::scanStructure(file);
        const bool deflated = syntax == "1.2.840.10008.1.2.1.99";
        EXPECT_EQ(int(found.fate), int(deflated ? Fate::odd : Fate::clear)) << syntax;
        EXPECT_EQ(found.transfer_syntax, deflated ? "" : syntax);
    }
}

/// Writers that count their meta header wrong are read as before.
TEST_F(OneReading, IsTriedElsewhereFirstWhereTheMetaHeaderIsNotPlain)
{
    setUpDicom();
    const fs::path file = writeSeries(folder / "in", {}, {0}).at(0);
    std::string bytes = readFile(file);
    constexpr std::size_t kLengthAt = 140, kLengthElementAt = 132, kLengthElement = 12;
    ++bytes[kLengthAt];
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_EQ(int(ingest::scanStructure(file).fate), int(Fate::odd));
    bytes.erase(kLengthElementAt, kLengthElement);
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_EQ(int(ingest::scanStructure(file).fate), int(Fate::odd));
    EXPECT_TRUE(says(import({file}), Kind::kept, "1 slice"));
}

}  // namespace
