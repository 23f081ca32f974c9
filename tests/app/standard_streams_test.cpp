// What becomes of what is printed where nobody can have it: a shell closes a stream, a disk is full, a reader leaves.
#include <gmock/gmock.h>

#include "dicom_writer.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon::support {
namespace {

namespace fs = std::filesystem;

/// Redirects the output of the command alone, not of its shell.
CommandResult withOutputTo(const std::string& redirection, const std::string& arguments)
{
    return runCommand("( " + viconBinary() + " " + arguments + " " + redirection + " )");
}

TEST(StandardStreams, WhatIsPrintedAndLostIsOneLineAndFails)
{
    for (const char* redirection : {">/dev/full", ">&-"})
        for (const char* arguments : {"--version", "config --json"}) {
            const CommandResult result = withOutputTo(redirection, arguments);
            EXPECT_EQ(result.exit_code, 1) << arguments << redirection;
            EXPECT_THAT(result.output, testing::StartsWith("vicon: standard output: cannot be written")) << arguments;
            EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
        }
    EXPECT_EQ(withOutputTo(">/dev/full", "frobnicate").exit_code, 2) << "an error keeps its code";
}

TEST(StandardStreams, AReaderThatHasSeenEnoughIsNoFault)
{
    // The shell writes until nobody reads any more.
    const CommandResult result = runCommand("{ ( trap '' PIPE; while printf x 2>/dev/null; do :; done; " +
                                            viconBinary() + " config; echo \"code $?\" >&2 ) | true; }");
    EXPECT_EQ(result.output, "code 0\n");
}

/// The first files that a program opens get the numbers of closed streams.
TEST(StandardStreams, ThatAreClosedLeaveTheStoreWhole)
{
    const TemporaryFolder folder;
    const auto files = test::writeSeries(folder / "in", {});
    const fs::path store = folder / "store";
    const CommandResult result =
        withOutputTo("<&- >&- 2>&-", "import " + (folder / "in").string() + " --store " + store.string());
    EXPECT_EQ(result.exit_code, 1);
    std::size_t whole = 0;
    for (const auto& entry : fs::recursive_directory_iterator(store / "cases"))
        if (entry.path().parent_path().filename() == "dicom")
            for (const fs::path& file : files)
                whole += readFile(file) == readFile(entry.path()) ? 1 : 0;
    EXPECT_EQ(whole, files.size());
    const CommandResult again = runVicon("import " + (folder / "in").string() + " --store " + store.string());
    EXPECT_THAT(again.output, testing::HasSubstr("unchanged"));
}

}  // namespace
}  // namespace vicon::support
