#include "text.h"

#include <gtest/gtest.h>

#include <limits>

#include "dataset.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/ingest/patient_match.h"
#include "vicon/support/support.h"

using namespace vicon;
using namespace vicon::ingest;

namespace {

struct NameCase {
    const char* file;
    const char* utf8;
};

/// The names as the authors of the files and the standard's examples (PS3.5 annexes H, I, J) give them.
const NameCase kNames[] = {
    {"chrArab.dcm", "قباني^لنزار"},
    {"chrFren.dcm", "Buc^Jérôme"},
    {"chrFrenMulti.dcm", "Buc^Jérôme"},
    {"chrGerm.dcm", "Äneas^Rüdiger"},
    {"chrGreek.dcm", "Διονυσιος"},
    {"chrH31.dcm", "Yamada^Tarou=山田^太郎=やまだ^たろう"},
    {"chrH32.dcm", "ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎=やまだ^たろう"},
    {"chrHbrw.dcm", "שרון^דבורה"},
    {"chrI2.dcm", "Hong^Gildong=洪^吉洞=홍^길동"},
    {"chrJapMulti.dcm", "やまだ^たろう"},
    {"chrJapMultiExplicitIR6.dcm", "やまだ^たろう"},
    {"chrKoreanMulti.dcm", "김희중"},
    {"chrRuss.dcm", "Люкceмбypг"},
    {"chrSQEncoding.dcm", "ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎=やまだ^たろう"},
    {"chrSQEncoding1.dcm", "ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎=やまだ^たろう"},
    {"chrX1.dcm", "Wang^XiaoDong=王^小東"},
    {"chrX2.dcm", "Wang^XiaoDong=王^小东"},
};

/// The patient's name in an object: in the data set, or in the first item that has one.
std::string nameIn(const Dataset& dataset)
{
    if (dataset.has(DCM_PatientName))
        return dataset.personName(DCM_PatientName);
    for (unsigned long n = 0; n < dataset.dcmItem().card(); ++n) {
        const DcmElement* element = dataset.dcmItem().getElement(n);
        if (element->ident() != EVR_SQ)
            continue;
        if (const auto item = dataset.item(element->getTag()))
            if (const std::string name = nameIn(*item); !name.empty())
                return name;
    }
    return {};
}

TEST(Text, EveryNameInEveryCharacterSetIsRightInUtf8)
{
    VICON_NEEDS_DATA("dicom/charsets");
    setUpDicom();
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(support::sharedData("dicom/charsets")))
        files += entry.is_regular_file() ? 1 : 0;
    EXPECT_EQ(files, std::size(kNames));
    for (const NameCase& c : kNames) {
        DcmFileFormat format;
        ASSERT_TRUE(format.loadFile((support::sharedData("dicom/charsets") / c.file).c_str()).good()) << c.file;
        EXPECT_EQ(nameIn(Dataset(*format.getDataset())), c.utf8) << c.file;
    }
}

struct TextCase {
    const char* what;
    std::string bytes;
    std::vector<std::string> sets;
    const char* utf8;
};

TEST(Text, OddAndBrokenTextsAreReadAsFarAsTheyGo)
{
    const TextCase cases[] = {
        {"nothing", "", {}, ""},
        {"padding is removed", "A^B ", {}, "A^B"},
        {"undeclared UTF-8", "J\xc3\xbcrgen", {}, "Jürgen"},
        {"undeclared Latin-1", "J\xfcrgen", {}, "Jürgen"},
        {"declared UTF-8", "J\xc3\xbcrgen", {"ISO_IR 192"}, "Jürgen"},
        {"broken UTF-8", "J\xfcrgen", {"ISO_IR 192"}, "J\ufffdrgen"},
        {"a byte above 127 that no set explains", "a\xfc", {"ISO_IR 6"}, "a\ufffd"},
        {"Latin-5", "\xfe", {"ISO_IR 148"}, "ş"},
        {"Thai", "\xa1", {"ISO_IR 166"}, "ก"},
        {"GBK", "\xcd\xf5", {"GBK"}, "王"},
        {"escape to Latin-2 and back at the delimiter",
         "\x1b-B\xb1^\xe9",
         {"ISO 2022 IR 100", "ISO 2022 IR 101"},
         "ą^é"},
        {"JIS X 0212", "\x1b$(D\x30\x21\x1b(B", {"", "ISO 2022 IR 159"}, "丂"},
        {"simplified Chinese with escapes", "\x1b$)A\xcd\xf5", {"", "ISO 2022 IR 58"}, "王"},
        {"yen sign of JIS X 0201", "\x1b(J~", {"ISO 2022 IR 13"}, "‾"},
        {"an unknown escape", "a\x1b%b", {"", "ISO 2022 IR 87"}, "a\x1b%b"},
        {"half a character at the end", "\x1b$B\x3b\x33\x45", {"", "ISO 2022 IR 87"}, "山"},
    };
    for (const TextCase& c : cases)
        EXPECT_EQ(toUtf8(c.bytes, c.sets, TextKind::person_name), c.utf8) << c.what;
}

TEST(Text, WhatIsLongerThanATextMayBeIsCutBetweenItsCharacters)
{
    DcmItem item;
    const std::string latin(kLongestText_bytes, 'x');
    item.putAndInsertString(DCM_PatientID, latin.c_str());
    EXPECT_EQ(Dataset(item).text(DCM_PatientID), latin);
    EXPECT_FALSE(Dataset(item).isCut(DCM_PatientID));
    for (const std::string more : {"y", "é", "山"}) {
        std::string text = latin;
        text.resize(kLongestText_bytes - 1);
        item.putAndInsertString(DCM_PatientID, (text + more + more).c_str());
        const std::string read = Dataset(item).text(DCM_PatientID);
        EXPECT_EQ(read, text + (more == "y" ? "y…" : "…"));
        EXPECT_TRUE(Dataset(item).isCut(DCM_PatientID));
    }
}

/// A value of the kind that the dictionary names, written as bytes of an unknown kind.
std::optional<double> unknownNumber(const DcmTagKey& tag, double value, bool single)
{
    const float small = float(value);
    auto* const element = new DcmOtherByteOtherWord(DcmTag(tag, EVR_UN));
    element->putUint8Array(single ? reinterpret_cast<const Uint8*>(&small) : reinterpret_cast<const Uint8*>(&value),
                           single ? sizeof small : sizeof value);
    DcmItem item;
    item.insert(element, true);
    return Dataset(item).number(tag);
}

TEST(Text, OnlyFiniteNumbersAreNumbers)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
    for (const bool single : {false, true}) {
        const DcmTagKey tag = single ? DCM_ExaminedBodyThickness : DCM_CTDIvol;
        EXPECT_EQ(unknownNumber(tag, 1.5, single), 1.5);
        EXPECT_EQ(unknownNumber(tag, kNan, single), std::nullopt);
        EXPECT_EQ(unknownNumber(tag, -kInf, single), std::nullopt);
    }
}

TEST(Text, PersonNamesLoseOnlyWhatIsEmptyAtTheEnd)
{
    EXPECT_EQ(tidyPersonName("A^B^^^"), "A^B");
    EXPECT_EQ(tidyPersonName("A^B==C^^="), "A^B==C");
    EXPECT_EQ(tidyPersonName("=山田"), "=山田");
    EXPECT_EQ(tidyPersonName("^B"), "^B");
    EXPECT_EQ(tidyPersonName(""), "");
}

TEST(Text, TypingDoesNotMakeAnotherPatient)
{
    const Patient jane{"1", "Doe^Jane", "19600101", "F"};
    const auto with = [&](const char* name, const char* birth) { return Patient{"1", name, birth, ""}; };
    EXPECT_TRUE(samePatient(jane, with("DOE^JANE^^", "19600101")));
    EXPECT_TRUE(samePatient(jane, with("doe jane", "")));
    EXPECT_TRUE(samePatient(jane, with("", "19600101")));
    EXPECT_TRUE(samePatient(jane, with("Doe^Jane=王", "19600101")));
    EXPECT_FALSE(samePatient(jane, with("Doe^John", "19600101")));
    EXPECT_FALSE(samePatient(jane, with("Doe^Jane", "19600102")));
    EXPECT_FALSE(samePatient(jane, {"2", "Doe^Jane", "19600101", "F"}));
    EXPECT_FALSE(samePatient(with("=王", ""), with("=李", "")));
}

}  // namespace
