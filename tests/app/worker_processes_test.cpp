// 'vicon work --jobs': as many processes as asked for, of which each does its share.
#include <gmock/gmock.h>

#include <csignal>

#include "fake_jobs.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/file.h"

namespace vicon {
namespace {

using testing::HasSubstr;

TEST(WorkerProcesses, DoEveryJobOnceAndEndWithTheWorstExitCode)
{
    pipeline::FakeStore fake;
    EXPECT_EQ(support::runVicon("work --jobs 3 --until-idle --store " + fake.folder.path().string()).exit_code, 0);
    fake.addJobs(6);  // scans without images: each fails, for good
    const auto result = support::runVicon("work --jobs 3 --until-idle --store " + fake.folder.path().string());
    EXPECT_EQ(result.exit_code, 1) << result.output;
    for (int n = 0; n < 6; ++n) {
        const std::string line = "c/s" + std::to_string(n) + ": failed";
        const auto first = result.output.find(line);
        EXPECT_NE(first, std::string::npos) << line << result.output;
        EXPECT_EQ(result.output.find(line, first + 1), std::string::npos) << "twice: " << line;
    }
    EXPECT_EQ(JobQueue(fake.store.database(), {}).count(JobState::failed), 6);
}

/// 'vicon work --jobs 2' for a shell, with its workers that have come as far as to open the store.
std::string twoWorkersOn(const std::filesystem::path& store)
{
    return support::viconBinary() + " work --jobs 2 --store " + store.string() + " 2>" + store.string() +
           ".log & parent=$!; ready() { for c in $(pgrep -P $parent); do"
           " ls -l /proc/$c/fd 2>/dev/null | grep -q vicon.db && echo $c; done; };"
           " two() { until [ $(ready | wc -w) = 2 ]; do kill -0 $parent || break; done; }; two;";
}
constexpr const char* kEnd = " two; kill -TERM $parent; wait $parent; echo ended $? $(pgrep -P $parent | wc -l)";

TEST(WorkerProcesses, AreReplacedWhenTheyEndByThemselves)
{
    const support::TemporaryFolder folder;
    CaseStore store(folder / "store");
    const auto result =
        support::runCommand(twoWorkersOn(folder / "store") +
                            " before=$(ready); kill -TERM $before;"  // each ends as by itself, with an exit code
                            " for b in $before; do while kill -0 $b 2>/dev/null; do :; done; done;" +
                            kEnd);
    EXPECT_THAT(result.output, HasSubstr("ended 0 0"));
    EXPECT_THAT(readFile(folder / "store.log"),
                HasSubstr("a worker ended with exit code 0; another one starts in 1 s"));
}

TEST(WorkerProcesses, ThatEndAtOnceAreStartedLaterEachTime)
{
    const support::TemporaryFolder folder;
    CaseStore store(folder / "store");
    const std::string there = (folder / "store").string(), away = (folder / "away").string();
    const auto result =
        support::runCommand(twoWorkersOn(there) + " before=$(ready); mv " + there + " " + away +
                            "; kill -TERM $before" + "; until grep -q 'starts in 4 s' " + there +
                            ".log; do kill -0 $parent || break; done; mv " + away + " " + there + ";" + kEnd);
    EXPECT_THAT(result.output, HasSubstr("ended 0 0"));
    const std::string log = readFile(folder / "store.log");
    for (const char* pause : {"starts in 1 s", "exit code 1; another one starts in 2 s", "starts in 4 s"})
        EXPECT_THAT(log, HasSubstr(pause));
}

TEST(WorkerProcesses, AreReplacedWhenTheyDieAndEndWhenTheirParentIsTold)
{
    const support::TemporaryFolder folder;
    CaseStore store(folder / "store");
    const auto result = support::runCommand(
        support::viconBinary() + " work --jobs 2 --store " + (folder / "store").string() +
        " & parent=$!; children() { pgrep -P $parent | sort | tr '\\n' ' '; };"
        " until [ $(children | wc -w) = 2 ]; do sleep 0.05; done; before=$(children);"
        " kill -9 ${before%% *};"
        " until [ $(children | wc -w) = 2 ] && [ \"$(children)\" != \"$before\" ]; do sleep 0.05; done;"
        " kill -TERM $parent; wait $parent; echo ended $(children | wc -w)");
    EXPECT_THAT(result.output, HasSubstr("ended 0"));
}

}  // namespace
}  // namespace vicon
