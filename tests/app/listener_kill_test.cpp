// A listener is killed at any moment while peers store: whatever it answered with success is there, whole and once.
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <set>
#include <thread>

#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"
#include "vicon/cases/case_store.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

constexpr int kSlices = 12;
const int kKills = inFull() ? 1000 : 5;

class ListenerKill : public testing::Test {
protected:
    TemporaryFolder folder_;
    const fs::path store_ = folder_ / "store";
    NoProgress quiet_;
    std::map<std::string, std::string> acknowledged_;  ///< data sets by UID
    int sent_again_ = 0;

    /// A study of its own for each round.
    static test::SeriesSpec specOf(int round)
    {
        test::SeriesSpec spec;
        spec.study_uid += "." + std::to_string(round);
        spec.series_uid += "." + std::to_string(round);
        spec.patient_id = "P" + std::to_string(round);
        spec.slices = kSlices;
        return spec;
    }
    /// Sends what was not yet answered with success. Returns whether all of it is.
    bool store(const RunningListener& listener, const test::SeriesSpec& spec, const std::vector<fs::path>& files)
    {
        std::vector<fs::path> left;
        std::map<fs::path, std::string> uids;
        for (int n = 0; n < kSlices; ++n)
            if (!acknowledged_.contains(spec.sopUid(n))) {
                left.push_back(files[std::size_t(n)]);
                uids[files[std::size_t(n)]] = spec.sopUid(n);
            }
        try {
            ingest::storeFiles(listener.peer(), left, "SCANNER", quiet_, [&](const ingest::StoreOutcome& outcome) {
                if (outcome.taken)
                    acknowledged_[uids[outcome.file]] = sha256(test::datasetBytes(readFile(outcome.file)));
            });
        } catch (const Error&) {
            ++sent_again_;
        }
        return std::all_of(uids.begin(), uids.end(),
                           [&](const auto& entry) { return acknowledged_.contains(entry.second); });
    }
    /// Every acknowledged object, by its data set, and how often it is in a case.
    void expectAllThereOnce()
    {
        CaseStore store(store_);
        std::map<std::string, int> times;
        for (const CaseRecord& c : store.cases())
            for (const ScanRecord& scan : store.scans(c.id))
                for (const InstanceRecord& instance : store.instances(c.id, scan.id)) {
                    ++times[instance.sop_uid];
                    const fs::path file = store.scanFolder(c.id, scan.id) / "dicom" / instance.file;
                    EXPECT_EQ(sha256OfFile(file), instance.sha256) << "whole";
                    EXPECT_EQ(sha256(test::datasetBytes(readFile(file))), acknowledged_[instance.sop_uid])
                        << instance.sop_uid;
                }
        for (const auto& [uid, data_set] : acknowledged_)
            EXPECT_EQ(times[uid], 1) << uid;
        EXPECT_EQ(times.size(), acknowledged_.size());
    }
    bool nothingWaits() const
    {
        std::error_code gone;
        for (const auto& entry : fs::recursive_directory_iterator(store_ / "incoming", gone))
            if (entry.path().extension() == ".dcm")
                return false;
        return true;
    }
};

TEST_F(ListenerKill, WhatWasAnsweredWithSuccessIsThereOnce)
{
    const std::string quick = "--set receive.quiet_s=0 --set receive.idle_s=0.1";
    std::mt19937 random(7);
    std::uniform_int_distribution<int> moment(0, 700);
    int at_work = 0;
    for (int round = 0; round < kKills; ++round) {
        const test::SeriesSpec spec = specOf(round);
        const auto files = test::writeSeries(folder_ / "in", spec);
        RunningListener listener(store_, quick);
        ASSERT_TRUE(listener.answers()) << listener.log();
        std::thread killer([&] {
            // The moment of the kill is what is tried.
            std::this_thread::sleep_for(std::chrono::milliseconds(moment(random)));
            listener.end(SIGKILL);
        });
        at_work += store(listener, spec, files) ? 0 : 1;
        killer.join();
        RunningListener again(store_, quick);
        ASSERT_TRUE(again.answers()) << again.log();
        EXPECT_TRUE(support::waitUntil([&] { return store(again, spec, files); })) << "the peer tries again";
        fs::remove_all(folder_ / "in");
    }
    {
        const RunningListener last(store_, quick);
        EXPECT_TRUE(support::waitUntil([&] { return nothingWaits(); })) << last.log();
    }
    expectAllThereOnce();
    std::printf("%d kills, %d while a peer stored, %zu objects, all there once\n", kKills, at_work,
                acknowledged_.size());
    EXPECT_EQ(acknowledged_.size(), std::size_t(kKills * kSlices));
}

/// A file that was not flushed may have its name after a power cut, and none of its bytes.
TEST_F(ListenerKill, WhatAPowerCutTakesOfTheFilesIsThereToo)
{
    const test::SeriesSpec spec = specOf(0);
    const auto files = test::writeSeries(folder_ / "in", spec);
    {
        RunningListener listener(store_, "--set receive.quiet_s=3600");
        ASSERT_TRUE(listener.answers()) << listener.log();
        ASSERT_TRUE(store(listener, spec, files));
        listener.end(SIGKILL);
    }
    int cut = 0;
    for (const auto& entry : fs::recursive_directory_iterator(store_ / "incoming"))
        if (entry.path().extension() == ".dcm") {
            fs::resize_file(entry.path(), 0);
            ++cut;
        }
    EXPECT_EQ(cut, kSlices);
    {
        const RunningListener again(store_, "--set receive.quiet_s=0");
        EXPECT_TRUE(support::waitUntil([&] { return nothingWaits(); })) << again.log();
    }
    expectAllThereOnce();
    EXPECT_EQ(acknowledged_.size(), std::size_t(kSlices));
}

}  // namespace
}  // namespace vicon::support
