#include "step_runner.h"

#include <gmock/gmock.h>

#include <latch>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon::pipeline {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using Run = std::function<json(Progress&)>;

class FakeContext : public JobContext {
public:
    void reserveMemory(double, double) override {}
    void completeIf(std::function<bool()>) override {}
    const Job& job() const override { return job_; }
    void enterStep(const std::string& step, double, double) override { entered.push_back(step); }
    void commitStep(const StepRecord&, const std::function<void()>&) override {}
    void withdrawSteps(const std::vector<std::string>&, const std::function<void()>&) override {}
    void report(double fraction, std::string_view) override
    {
        EXPECT_GE(fraction, last_);
        last_ = fraction;
    }
    bool cancelled() const override { return stop; }
    double last() const { return last_; }

    std::vector<std::string> entered;
    std::atomic<bool> stop = false;

private:
    Job job_;
    double last_ = 0;
};

/// A table of fake steps, and what was told of them.
struct Bench {
    void add(
        const std::string& name, std::vector<std::string> inputs, Run run = [](Progress&) { return json{}; })
    {
        const double from = double(table.size()) / 10;
        table.push_back({name, 1, from, from + 0.1, std::move(inputs), Densities::none,
                         [](const json&) { return std::vector<std::string>{}; },
                         [](const Config&) { return json::object(); },
                         [run](const StepInputs&, ScanResults&, const StepRecords&, Progress& progress) {
                             progress.report(0.5, "half");
                             return run(progress);
                         }});
    }
    void run(int at_once = 3)
    {
        const support::TemporaryFolder folder;
        ScanResults results(folder.path(), folder / "claim", Quantity::density);
        StepRunner(table,
                   {.is_due = [&](const Step& step) { return !current.contains(step.name); },
                    .made = [&](const Step& step, const json&) { made.push_back(step.name); },
                    .ends = [&](const Step& step) { return step.name == last; },
                    .written = [&](const Step& step, double) { recorded.push_back(step.name); }},
                   inputs, results, records, context, at_once)
            .run();
    }

    std::vector<Step> table;
    std::set<std::string> current;  ///< steps that need not run
    std::string last;               ///< the step after which none starts
    StepInputs inputs;
    StepRecords records;
    FakeContext context;
    std::vector<std::string> made, recorded;
};

TEST(StepRunner, RunsStepsTogetherWhenNeitherReadsTheOther)
{
    Bench bench;
    std::latch both(2);
    const auto meet = [&](Progress&) {
        both.arrive_and_wait();  // for ever, if one ran after the other
        return json{};
    };
    bench.add("first", {});
    bench.add("left", {"first"}, meet);
    bench.add("right", {"first"}, meet);
    bench.add("last", {"left", "right"});
    bench.run();
    EXPECT_THAT(bench.recorded, testing::UnorderedElementsAre("first", "left", "right", "last"));
    EXPECT_EQ(bench.recorded.front(), "first");
    EXPECT_EQ(bench.recorded.back(), "last");
    EXPECT_THAT(bench.context.entered, testing::Contains("left, right"));
}

/// The context holds every report against the last one.
TEST(StepRunner, KeepsTheProgressOfAStepThatDoesAPartOfItsWorkAgain)
{
    Bench bench;
    bench.add("doubts", {}, [](Progress& progress) {
        for (const double fraction : {0.9, 0.8, 0.95})
            progress.report(fraction, "order of the pieces");
        return json{};
    });
    bench.run();
    EXPECT_NEAR(bench.context.last(), 0.095, 1e-12);
}

TEST(StepRunner, RunsOneAtATimeInTheTablesOrderWhenTold)
{
    Bench bench;
    std::atomic<int> at_work = 0, most = 0;
    const auto count = [&](Progress&) {
        most = std::max(most.load(), ++at_work);
        for (int turn = 0; turn < 1000; ++turn)
            std::this_thread::yield();  // another thread, were there one, begins
        --at_work;
        return json{};
    };
    for (const char* name : {"a", "b", "c", "d"})
        bench.add(name, {}, count);
    bench.run(1);
    EXPECT_EQ(most, 1);
    EXPECT_THAT(bench.recorded, testing::ElementsAre("a", "b", "c", "d"));
}

TEST(StepRunner, TellsAStepsResultBeforeWhatReadsItStarts)
{
    Bench bench;
    bool told = false;
    bench.add("a", {});
    bench.add("b", {"a"}, [&](Progress&) {
        told = !bench.made.empty() && bench.made.front() == "a";
        return json{};
    });
    bench.run();
    EXPECT_TRUE(told);
}

TEST(StepRunner, LeavesOutWhatIsCurrentAndWhatFollowsTheLastStep)
{
    Bench bench;
    bench.add("a", {});
    bench.add("b", {"a"});
    bench.add("c", {"b"});
    bench.add("d", {});
    bench.current = {"a"};
    bench.last = "b";
    bench.run(1);
    EXPECT_THAT(bench.recorded, testing::ElementsAre("b"));
}

TEST(StepRunner, StopsTheOthersWhenOneFailsAndThrowsWhatItThrew)
{
    Bench bench;
    std::latch started(2);
    bench.add("fails", {}, [&](Progress&) -> json {
        started.arrive_and_wait();
        throw Error(ErrorCode::bad_input, "broken");
    });
    bench.add("waits", {}, [&](Progress& progress) -> json {
        started.arrive_and_wait();
        for (;;) {
            progress.check();
            std::this_thread::yield();
        }
    });
    bench.add("after", {"waits"});
    try {
        bench.run();
        FAIL() << "nothing was thrown";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::bad_input);
    }
    EXPECT_TRUE(bench.recorded.empty());
}

TEST(StepRunner, RecordsWhatOthersFinishedAlthoughOneFails)
{
    Bench bench;
    std::latch started(2);
    std::atomic<bool> failing = false;
    bench.add("fails", {}, [&](Progress&) -> json {
        started.arrive_and_wait();
        failing = true;
        failing.notify_all();
        throw Error(ErrorCode::store, "disk full");
    });
    bench.add("finishes", {}, [&](Progress&) {
        started.arrive_and_wait();
        failing.wait(false);
        return json{};
    });
    EXPECT_THROW(bench.run(), Error);
    EXPECT_THAT(bench.recorded, testing::ElementsAre("finishes"));
}

TEST(StepRunner, StopsWhenTheJobIsCancelled)
{
    Bench bench;
    bench.add("a", {}, [&](Progress& progress) -> json {
        bench.context.stop = true;
        progress.check();
        return {};
    });
    try {
        bench.run();
        FAIL() << "nothing was thrown";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::cancelled);
    }
}

TEST(ScanResults, HandOnWhatIsStillBeingWrittenAndSayWhenItCannotBe)
{
    const support::TemporaryFolder folder;
    ScanResults results(folder.path(), folder / "claim", Quantity::density);
    HuVolume volume(Grid{.size = {40, 30, 20}}, 7);
    results.put(std::move(volume));
    EXPECT_EQ(results.volume().voxels.front(), 7);
    results.finish({"volume.mha", "never-begun.mha"});
    results.dropVolume();
    EXPECT_EQ(results.volume().voxels.back(), 7) << "read back from its file";

    results.putMask(InsideVolume(Grid{.size = {5, 6, 7}, .origin_mm = {20, 10, 9}}, kGas));
    results.finish({"mask.mha"});
    EXPECT_EQ(results.densitiesAroundLumen().grid.size, (std::array<int, 3>{21, 22, 19}));
    results.dropVolume();
    EXPECT_EQ(results.densitiesAroundLumen().voxels.back(), 7) << "kept without the whole";
    results.dropDensitiesAroundLumen();
    EXPECT_EQ(results.densitiesAroundLumen().voxels.size(), 21U * 22U * 19U) << "read back from the whole's file";

    ScanResults nowhere(folder / "missing", folder / "missing/claim", Quantity::density);
    fs::remove_all(folder / "missing");
    nowhere.put(HuVolume(Grid{.size = {4, 3, 2}}));
    EXPECT_THROW(nowhere.finish({"volume.mha"}), Error);
}

TEST(ScanResults, WhatAClaimMakesReachesTheScanOnlyWhenItIsPublished)
{
    const support::TemporaryFolder folder;
    replaceFile(folder / "skeleton.vtp", "the successor's");
    {
        const ScanResults stale(folder.path(), folder / ".vicon-tmp-claim-1", Quantity::density);
        EXPECT_EQ(stale.source("skeleton.vtp"), folder / "skeleton.vtp");
        replaceFile(stale.target("skeleton.vtp"), "the stale one's");
        EXPECT_EQ(readFile(stale.source("skeleton.vtp")), "the stale one's");
        EXPECT_EQ(readFile(folder / "skeleton.vtp"), "the successor's");
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "nothing of it stays";
    const ScanResults mine(folder.path(), folder / ".vicon-tmp-claim-2", Quantity::density);
    replaceFile(mine.target("skeleton.vtp"), "mine");
    mine.publish({"skeleton.vtp", "not made.vtp"});
    EXPECT_EQ(readFile(folder / "skeleton.vtp"), "mine");
    EXPECT_EQ(readFile(mine.source("skeleton.vtp")), "mine") << "who reads it there goes on";
}

}  // namespace
}  // namespace vicon::pipeline
