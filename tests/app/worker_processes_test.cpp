// 'vicon work --jobs': as many processes as asked for, of which each does its share.
#include <gmock/gmock.h>

#include <csignal>

#include "fake_jobs.h"
#include "vicon/cases/job_queue.h"

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
