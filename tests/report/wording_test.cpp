#include "vicon/report/wording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vicon::report {
namespace {

struct Words {
    const char* given;
    const char* printed;
};

TEST(Wording, PersonNamesAreForPeople)
{
    for (const Words& c : std::initializer_list<Words>{
             {"", ""},
             {"^^^^", ""},
             {"Adams", "Adams"},
             {"Adams^John", "Adams, John"},
             {"Adams^John Robert Quincy^^Rev.^B.A. M.Div.", "Adams, Rev. John Robert Quincy, B.A. M.Div."},
             {"^John", "John"},
             {" Adams ^ John ", "Adams, John"},
             {"Äneas^Rüdiger", "Äneas, Rüdiger"},
             {"Yamada^Tarou=山田^太郎=やまだ^たろう", "Yamada, Tarou (山田 太郎, やまだ たろう)"},
             {"ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎=やまだ^たろう", "ﾔﾏﾀﾞ ﾀﾛｳ (山田 太郎, やまだ たろう)"},
             {"Hong^Gildong=洪^吉洞=홍^길동", "Hong, Gildong (洪 吉洞, 홍 길동)"},
             {"Wang^XiaoDong=王^小东", "Wang, XiaoDong (王 小东)"},
             {"=王^小东", "王 小东"},
             {"Люкceмбypг", "Люкceмбypг"},
             {"קאם^דנה", "קאם, דנה"},
             {"قباني^لنزار", "قباني، لنزار"}})
        EXPECT_EQ(personName(c.given), c.printed) << c.given;
}

TEST(Wording, DatesAreUnambiguousAndWhatIsNoDateIsKept)
{
    for (const Words& c : std::initializer_list<Words>{{"19610412", "12 Apr 1961"},
                                                       {"20261101", "1 Nov 2026"},
                                                       {"", ""},
                                                       {"1961", "1961"},
                                                       {"19611312", "19611312"},
                                                       {"19610400", "19610400"},
                                                       {"1961041x", "1961041x"}})
        EXPECT_EQ(dateWords(c.given), c.printed) << c.given;
    EXPECT_EQ(dateTimeWords("20261120", "081530.25"), "20 Nov 2026, 08:15");
    EXPECT_EQ(dateTimeWords("20261120", ""), "20 Nov 2026");
    EXPECT_EQ(dateTimeWords("", "0815"), "08:15");
    EXPECT_EQ(utcWords("2026-11-21T08:15:30Z"), "21 Nov 2026 08:15 UTC");
    EXPECT_EQ(utcWords("yesterday"), "yesterday");
}

TEST(Wording, PositionsNameTheSidesOfThePatient)
{
    struct Case {
        Point3 position_mm;
        const char* letters;
        const char* words;
    };
    for (const Case& c : std::initializer_list<Case>{
             {{85.2, 12, 340.5}, "L 85.2, P 12.0, H 340.5 mm", "left, posterior, headward of the scan's origin"},
             {{-85.2, -12, -340.5}, "R 85.2, A 12.0, F 340.5 mm", "right, anterior, footward of the scan's origin"},
             {{0, -0.0, -0.04}, "L 0.0, P 0.0, H 0.0 mm", "left, posterior, headward of the scan's origin"},
             {{-0.06, 0.05, 1234.56},
              "R 0.1, P 0.1, H 1234.6 mm",
              "right, posterior, headward of the scan's origin"}}) {
        EXPECT_EQ(positionLetters(c.position_mm), c.letters);
        EXPECT_EQ(positionWords(c.position_mm), c.words);
    }
}

TEST(Wording, PatientPositions)
{
    for (const Words& c : std::initializer_list<Words>{{"HFS", "supine, head first"},
                                                       {"FFP", "prone, feet first"},
                                                       {"HFDL", "left decubitus, head first"},
                                                       {"", "position not given"},
                                                       {"SITTING", "SITTING"}})
        EXPECT_EQ(patientPositionWords(c.given), c.printed);
    EXPECT_EQ(sexWords("F"), "female");
    EXPECT_EQ(sexWords("X"), "X");
}

TEST(Wording, LengthsAndFractions)
{
    EXPECT_EQ(millimetres(412.4), "412 mm");
    EXPECT_EQ(millimetres(0), "0 mm");
    EXPECT_EQ(percent(0.2584), "25.8 %");
    EXPECT_EQ(percent(0.86, 0), "86 %");
    EXPECT_EQ(percent(1), "100.0 %");
}

TEST(Wording, TheEndoscopesDistanceTakesTheFactorOfThePart)
{
    struct Case {
        double station_mm;
        const char* part;
        const char* printed;
    };
    // 412 * 0.78 = 321.4; 1510 * 0.59 = 890.9; 1890 * 0.57 = 1077.3: the published 189 cm by CT, 108 cm by endoscope.
    for (const Case& c :
         std::initializer_list<Case>{{412, "sigmoid", "about 32 cm (0.78 × CT distance, left colon)"},
                                     {412, "rectum", "about 32 cm (0.78 × CT distance, left colon)"},
                                     {1510, "ascending", "about 89 cm (0.59 × CT distance, right colon)"},
                                     {1890, "caecum", "about 108 cm (0.57 × CT distance, caecum)"},
                                     {1000, "transverse", "about 59 to 78 cm (0.59 to 0.78 × CT distance)"},
                                     {1000, "", "about 59 to 78 cm (0.59 to 0.78 × CT distance)"},
                                     {0, "", "about 0 cm (0.59 to 0.78 × CT distance)"}})
        EXPECT_EQ(endoscopeEstimate(c.station_mm, c.part), c.printed);
    EXPECT_THAT(distancesExplained(), testing::AllOf(testing::HasSubstr("estimated"), testing::HasSubstr("0.57"),
                                                     testing::HasSubstr("0.59"), testing::HasSubstr("0.78")));
}

}  // namespace
}  // namespace vicon::report
