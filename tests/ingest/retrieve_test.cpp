// Query and retrieve against a PACS that is not ours.
#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

#include "dicom_writer.h"
#include "orthanc.h"
#include "running_receiver.h"
#include "store_fixture.h"
#include "vicon/ingest/query.h"
#include "vicon/ingest/receiver.h"

namespace vicon::test {
namespace {

/// Two patients' studies in an Orthanc.
class Retrieve : public StoreFixture {
protected:
    const int port = freePort();
    Orthanc orthanc{folder / "orthanc", port};
    SeriesSpec wanted, other;
    std::multiset<std::string> sent;

    void SetUp() override
    {
        other.study_uid += ".7";
        other.series_uid += ".7";
        other.patient_id = "P2";
        other.patient_name = "Roe^Richard";
        ASSERT_TRUE(orthanc.answers()) << readFile(folder / "orthanc/log");
        auto files = writeSeries(folder / "wanted", wanted);
        for (const fs::path& file : files)
            sent.insert(fingerprint(readFile(file)));
        for (const fs::path& file : writeSeries(folder / "other", other))
            files.push_back(file);
        describe(folder / "other");
        ASSERT_TRUE(ingest::storeFiles(orthanc.peer(), files, "VICON", quiet).complete());
    }
    std::vector<std::string> uidsOf(const ingest::StudyQuery& query)
    {
        std::vector<std::string> uids;
        for (const auto& study : ingest::findStudies(orthanc.peer(), query, "VICON", quiet))
            uids.push_back(study.study_uid);
        return uids;
    }
};

TEST_F(Retrieve, FindsStudiesByWhatTheyAreAskedFor)
{
    using Uids = std::vector<std::string>;
    EXPECT_EQ(uidsOf({}).size(), 2U);
    EXPECT_EQ(uidsOf({.patient_id = "P2"}), Uids{other.study_uid});
    EXPECT_EQ(uidsOf({.patient_name = "DOE*"}), Uids{wanted.study_uid});
    EXPECT_EQ(uidsOf({.dates = "20260101-20260103"}).size(), 2U);
    EXPECT_EQ(uidsOf({.dates = "-20251231"}), Uids{});
    EXPECT_EQ(uidsOf({.dates = "2026-01-02"}).size(), 2U);
    EXPECT_EQ(uidsOf({.dates = "2026-01-01-2026-01-03"}).size(), 2U);
    EXPECT_EQ(uidsOf({.dates = "2026-01-03-"}), Uids{});
    for (const char* none : {"tomorrow", "2026-13-01", "20260102-20260103-20260104", "-"})
        EXPECT_THROW(uidsOf({.dates = none}), Error) << none;
    EXPECT_EQ(uidsOf({.study_uid = wanted.study_uid}), Uids{wanted.study_uid});
    EXPECT_EQ(uidsOf({.modality = "MR"}), Uids{});
    EXPECT_EQ(uidsOf({.description = "*COLONOGRAPHY"}), Uids{other.study_uid});
    EXPECT_EQ(uidsOf({.description = "*prone*"}), Uids{}) << "that is the series'";
    EXPECT_EQ(uidsOf({.series_description = "PRONE*"}), Uids{other.study_uid});
    EXPECT_EQ(uidsOf({.description = "CT*", .series_description = "supine*"}), Uids{});
    const auto study = ingest::findStudies(orthanc.peer(), {.patient_id = "P1"}, "VICON", quiet).at(0);
    EXPECT_EQ(study.patient_name, "Doe^Jane");
    EXPECT_EQ(study.date, "20260102");
    EXPECT_EQ(study.images, wanted.slices);
    EXPECT_EQ(ingest::findSeries(orthanc.peer(), wanted.study_uid, "CT", "VICON", quiet), Uids{wanted.series_uid});
}

TEST_F(Retrieve, GetsASeriesElementByElement)
{
    const auto result =
        ingest::getSeries(orthanc.peer(), wanted.study_uid, {wanted.series_uid}, folder / "got", "VICON", quiet);
    EXPECT_EQ(result.completed, wanted.slices);
    EXPECT_EQ(result.failed, 0);
    std::multiset<std::string> got;
    for (const auto& entry : fs::directory_iterator(folder / "got"))
        got.insert(fingerprint(readFile(entry.path())));
    EXPECT_EQ(got, sent);
    EXPECT_EQ(import({folder / "got"}).scans_stored, 1);
}

TEST_F(Retrieve, GoesOnWhereItStopped)
{
    fs::create_directories(folder / "got");
    const auto get = [&](const std::set<std::string>& have = {}) {
        return ingest::getSeries(orthanc.peer(), wanted.study_uid, {wanted.series_uid}, folder / "got", "VICON", quiet,
                                 have);
    };
    ASSERT_EQ(get().completed, wanted.slices);
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder / "got"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (std::size_t n = 0; n < 5; ++n)
        fs::remove(files[n]);
    fs::resize_file(files[5], 700);  // where it broke off
    // Damaged since, so that a library would read gigabytes: the VR of (0002,0002).
    std::string damaged = readFile(files[6]);
    const std::size_t at = damaged.find(std::string("\x02\x00\x02\x00UI", 6));
    ASSERT_NE(at, std::string::npos);
    damaged[at + 4] ^= 1;
    std::ofstream(files[6], std::ios::binary) << damaged;
    fs::last_write_time(files[6], fs::last_write_time(files[5]) - std::chrono::hours(1));
    EXPECT_EQ(get().completed, 7);
    std::set<std::string> all;
    for (int n = 0; n < wanted.slices; ++n)
        all.insert(wanted.sopUid(n));
    std::multiset<std::string> got;
    for (const auto& entry : fs::directory_iterator(folder / "got"))
        got.insert(fingerprint(readFile(entry.path())));
    EXPECT_EQ(got, sent);
    EXPECT_EQ(get(all).completed, 0) << "what the store has is not fetched again";
}

TEST_F(Retrieve, HasASeriesMovedToTheReceiver)
{
    std::multiset<std::string> got;
    ingest::ReceiverOptions options;
    options.port = port;
    std::atomic<bool> stop = false;
    ingest::Receiver receiver(options, store.folder() / "incoming", {[&](const ingest::Receiver::Files& files) {
                                  for (const fs::path& file : files)
                                      got.insert(fingerprint(readFile(file)));
                                  return ingest::Receiver::Files{};
                              }});
    std::thread thread([&] { receiver.run(stop); });
    const auto result =
        ingest::moveSeries(orthanc.peer(), wanted.study_uid, {wanted.series_uid}, "VICON", "VICON", quiet);
    stop = true;
    thread.join();
    EXPECT_EQ(result.completed, wanted.slices);
    EXPECT_EQ(got, sent);
}

TEST_F(Retrieve, MovesOnlyWhatIsMissing)
{
    const RunningReceiver receiver(store.folder() / "incoming", {.port = port});
    const auto move = [&](const std::set<std::string>& have) {
        return ingest::moveSeries(orthanc.peer(), wanted.study_uid, {wanted.series_uid}, "VICON", "VICON", quiet, have)
            .completed;
    };
    std::set<std::string> have{wanted.sopUid(0), wanted.sopUid(7)};
    EXPECT_EQ(move(have), wanted.slices - 2);
    for (int n = 0; n < wanted.slices; ++n)
        have.insert(wanted.sopUid(n));
    EXPECT_EQ(move(have), 0);
}

TEST_F(Retrieve, SaysWhatThePeerRefuses)
{
    const auto unknown =
        ingest::moveSeries(orthanc.peer(), wanted.study_uid, {wanted.series_uid}, "NOBODY", "VICON", quiet);
    EXPECT_EQ(unknown.completed, 0);
    EXPECT_EQ(unknown.failed, 1);
    EXPECT_EQ(unknown.reasons.size(), 1U);
    ingest::Peer nobody = orthanc.peer();
    nobody.port = freePort();
    EXPECT_THROW(ingest::findStudies(nobody, {}, "VICON", quiet), Error);
}

}  // namespace
}  // namespace vicon::test
