#include "run_program.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

namespace vicon {
namespace {

TEST(RunProgram, TellsWhatTheProgramSaidAndHowItEnded)
{
    const ProgramEnd end = runProgram({"sh", "-c", "echo out; echo wrong >&2; exit 3"});
    EXPECT_EQ(end.exit_code, 3);
    EXPECT_EQ(end.said, "wrong\n");
    EXPECT_EQ(runProgram({"true"}).exit_code, 0);
    EXPECT_NE(runProgram({"sh", "-c", "kill -9 $$"}).exit_code, 0) << "killed";
    EXPECT_NE(runProgram({"/no/such/program"}).exit_code, 0);
}

TEST(RunProgram, HasNothingToReadFromWhoeverStartedIt)
{
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    ASSERT_EQ(::write(ends[1], "ours\n", 5), 5);
    const int before = ::dup(STDIN_FILENO);
    ::dup2(ends[0], STDIN_FILENO);
    const ProgramEnd end = runProgram({"sh", "-c", "read -r line && echo \"$line\" >&2"});
    ::dup2(before, STDIN_FILENO);
    for (const int descriptor : {before, ends[0], ends[1]})
        ::close(descriptor);
    EXPECT_EQ(end.said, "");
    EXPECT_NE(end.exit_code, 0) << "there is no line";
}

}  // namespace
}  // namespace vicon
