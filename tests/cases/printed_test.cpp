#include "vicon/cases/printed.h"

#include <gtest/gtest.h>

namespace vicon {
namespace {

struct Words {
    const char* given;
    const char* printed;
};

TEST(Printed, PersonNamesAreForPeople)
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
        EXPECT_EQ(printedName(c.given), c.printed) << c.given;
}

TEST(Printed, DatesAreUnambiguousAndWhatIsNoDateIsKept)
{
    for (const Words& c : std::initializer_list<Words>{{"19610412", "1961-04-12"},
                                                       {"20261101", "2026-11-01"},
                                                       {"20261231", "2026-12-31"},
                                                       {"20260101", "2026-01-01"},
                                                       {"", ""},
                                                       {"1961", "1961"},
                                                       {"19611312", "19611312"},
                                                       {"19610400", "19610400"},
                                                       {"1961041x", "1961041x"}})
        EXPECT_EQ(printedDate(c.given), c.printed) << c.given;
}

TEST(Printed, APatientWithoutANameIsSaidToHaveNone)
{
    EXPECT_EQ(printedPatientName("^^^^"), "name not given");
    EXPECT_EQ(printedPatientName("Doe^Jane^Q^Dr^PhD"), "Doe, Dr Jane Q, PhD");
}

}  // namespace
}  // namespace vicon
