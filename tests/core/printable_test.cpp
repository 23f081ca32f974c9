#include "vicon/core/printable.h"

#include <gtest/gtest.h>

using vicon::printable;

namespace {

TEST(Printable, LeavesReadableTextAsItIs)
{
    for (const char* text : {"", "Müller^Jürgen", "山田^太郎", "\U0001F9E0 a\\b"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatActs)
{
    EXPECT_EQ(printable("a\x1b[2Jb"), "a\\x1b[2Jb");
    EXPECT_EQ(printable("one\ntwo\r\tthree\x7f"), "one\\ntwo\\r\\tthree\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\u009b31m \u202e \u2028"), "\\u009b31m \\u202e \\u2028");
}

TEST(Printable, ReplacesWhatIsNoUtf8)
{
    EXPECT_EQ(printable("caf\xe9"), "caf\uFFFD");
    EXPECT_EQ(printable("\xc0\xaf\xed\xa0\x80\xf5"), "\uFFFD\uFFFD\uFFFD\uFFFD\uFFFD\uFFFD");
    EXPECT_EQ(printable("\xe5\xb1"), "\uFFFD\uFFFD");
}

TEST(Shortened, CutsBetweenCharacters)
{
    EXPECT_EQ(vicon::shortened("Zoë", 3), "Zoë");
    EXPECT_EQ(vicon::shortened("Zoë", 2), "Zo...");
    EXPECT_EQ(vicon::shortened("山田太郎", 2), "山田...");
}

}  // namespace
