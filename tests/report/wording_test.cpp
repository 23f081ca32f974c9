#include "vicon/report/wording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vicon::report {
namespace {

struct Words {
    const char* given;
    const char* printed;
};

TEST(Wording, TimesFollowTheirDates)
{
    EXPECT_EQ(dateTimeWords("20261120", "081530.25"), "2026-11-20, 08:15");
    EXPECT_EQ(dateTimeWords("20261120", ""), "2026-11-20");
    EXPECT_EQ(dateTimeWords("", "0815"), "08:15");
    EXPECT_EQ(utcWords("2026-11-21T08:15:30Z"), "2026-11-21 08:15 UTC");
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
