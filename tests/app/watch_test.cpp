// An archive that is watched, from outside.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>

#include "dicom_writer.h"
#include "orthanc.h"
#include "running_listener.h"
#include "study.h"
#include "vicon/cases/case_store.h"
#include "vicon/core/file.h"
#include "vicon/ingest/watched_studies.h"

namespace vicon::support {
namespace {

using testing::HasSubstr;
using testing::Not;

class WatchOrthanc : public testing::Test {
protected:
    TemporaryFolder folder_;
    const int port_ = test::freePort();  // where VICON listens
    test::Orthanc orthanc_{folder_ / "orthanc", port_};
    const std::filesystem::path store_ = folder_ / "store", config_ = folder_ / "c.toml";
    NoProgress quiet_;

    void SetUp() override
    {
        configure();
        ASSERT_TRUE(orthanc_.answers());
    }
    /// @param peer more of the peer's entry
    void configure(const std::string& peer = "", const std::string& watch = "")
    {
        replaceFile(config_, "[peers]\npacs = { host = \"127.0.0.1\", port = " + std::to_string(orthanc_.peer().port) +
                                 ", ae_title = \"ORTHANC\"" + peer + " }\n[watch]\nleast_slices = 10\ndays = 36500\n" +
                                 watch + "[receive]\nquiet_s = 0\nport = " + std::to_string(port_) + "\n");
    }
    static test::SeriesSpec study(const std::string& number, const std::string& patient,
                                  const std::string& date = test::SeriesSpec{}.study_date)
    {
        test::SeriesSpec spec;
        spec.study_uid += "." + number;
        spec.series_uid += "." + number;
        spec.patient_id = patient;
        spec.study_date = date;
        return spec;
    }
    void archive(const test::SeriesSpec& spec, const std::vector<int>& slices = {})
    {
        archive(test::writeSeries(folder_ / ("in" + spec.study_uid), spec, slices));
    }
    void archive(const std::vector<std::filesystem::path>& files)
    {
        ASSERT_TRUE(ingest::storeFiles(orthanc_.peer(), files, "SCANNER", quiet_).complete());
    }
    void archive(const std::string& number, const std::string& patient, const std::vector<int>& slices = {})
    {
        archive(study(number, patient), slices);
    }
    /// Somebody else's measurement report of a study.
    void archiveReport(const test::SeriesSpec& spec)
    {
        const auto made = runCommand(VICON_MAKE_FOREIGN " " + (folder_ / "sr").string());
        ASSERT_EQ(made.exit_code, 0) << made.output;
        const std::filesystem::path sr = folder_ / "sr/other-maker.dcm";
        const auto changed =
            runCommand("dcmodify -nb -m StudyInstanceUID=" + spec.study_uid + " -m StudyDate=" + spec.study_date +
                       " -m PatientID=" + spec.patient_id + " -m PatientName=" + spec.patient_name + " " + sr.string());
        ASSERT_EQ(changed.exit_code, 0) << changed.output;
        archive(std::vector{sr});
    }
    CommandResult vicon(const std::string& arguments)
    {
        return runVicon(arguments + " --store " + store_.string() + " --config " + config_.string() + " 2>&1");
    }
    std::string watch(int exit_code = 0)
    {
        const auto done = vicon("watch pacs --once");
        EXPECT_EQ(done.exit_code, exit_code) << done.output;
        return done.output;
    }
    std::size_t cases() { return viconJson(store_, "cases")["cases"].size(); }
};

TEST_F(WatchOrthanc, EachNewStudyThatFitsIsFetchedOnce)
{
    archive("1", "P1");
    archive("2", "P2", {0, 1, 2});
    EXPECT_THAT(watch(), Not(HasSubstr("fetched"))) << "it may still grow";
    EXPECT_THAT(watch(), HasSubstr("12 objects fetched, 0 failed"));
    EXPECT_EQ(cases(), 1u) << "three slices are too few";
    EXPECT_THAT(watch(), Not(HasSubstr("fetched"))) << "once, over restarts";
    archive("3", "P3", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    watch();
    archive("3", "P3", {11});
    EXPECT_THAT(watch(), Not(HasSubstr("fetched"))) << "it grew";
    EXPECT_THAT(watch(), HasSubstr("12 objects fetched"));
    EXPECT_EQ(cases(), 2u);
}

TEST_F(WatchOrthanc, APeerThatIsOffIsAskedAgain)
{
    archive("1", "P1");
    watch();
    orthanc_.end(SIGKILL);
    const auto off = runVicon("watch pacs --once --store " + store_.string() + " --config " + config_.string());
    EXPECT_EQ(off.exit_code, 1);
    EXPECT_THAT(off.output, HasSubstr("no association with the peer"));
    orthanc_.start();
    ASSERT_TRUE(orthanc_.answers());
    EXPECT_THAT(watch(), HasSubstr("12 objects fetched"));
}

TEST_F(WatchOrthanc, EarlierStudiesComeWithTheirReportsAlsoAfterAFailure)
{
    configure("", "priors = 1\n");
    const auto now = study("1", "P1"), before = study("2", "P1", "20230504"), long_ago = study("3", "P1", "20190101");
    for (const auto& spec : {now, before, long_ago})
        archive(spec);
    archive("4", "P2");
    archiveReport(before);
    // Only the new study shall be seen as new: two days before the newest.
    const auto look = [&](int exit_code) {
        const auto done = vicon("watch pacs --once --set watch.days=2");
        EXPECT_EQ(done.exit_code, exit_code) << done.output;
        return done.output;
    };
    {
        ingest::WatchedStudies(store_, "pacs").note(now.study_uid, now.study_date, 12);  // as at an earlier poll
    }
    const std::filesystem::path folder = store_ / "retrieve" / CaseStore::caseIdFor(before.study_uid);
    std::filesystem::create_directories(folder);
    const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
    EXPECT_THAT(look(1), HasSubstr("is being retrieved by another program"));
    EXPECT_EQ(cases(), 1u) << "the new study came";
    ::close(lock);
    EXPECT_THAT(look(0), HasSubstr("13 objects fetched, 0 failed")) << "the earlier one and its report";
    EXPECT_EQ(cases(), 3u) << "and the other patient's";
    const auto priors = viconJson(store_, "priors " + CaseStore::caseIdFor(now.study_uid))["priors"];
    ASSERT_EQ(priors.size(), 1u);
    EXPECT_EQ(priors[0]["study"]["date"], "20230504");
    EXPECT_THAT(look(0), Not(HasSubstr("fetched"))) << "once";
}

TEST_F(WatchOrthanc, WhatIsNeitherCtNorMrIsNoModality)
{
    archive("1", "P1");
    const auto none = vicon("watch pacs --once --set watch.modality=");
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.output, HasSubstr("must be one of CT, MR, any"));
    vicon("watch pacs --once --set watch.modality=any");
    EXPECT_THAT(vicon("watch pacs --once --set watch.modality=any").output, HasSubstr("12 objects fetched"));
}

TEST_F(WatchOrthanc, APeerThatOnlyMovesIsWatchedAlone)
{
    configure(", retrieve = \"move\"");
    archive("1", "P1");
    watch();
    EXPECT_THAT(watch(), HasSubstr("12 objects fetched, 0 failed"));
    EXPECT_EQ(cases(), 1u);
}

TEST_F(WatchOrthanc, APeerThatOnlyMovesIsWatchedBesideTheListener)
{
    configure(", retrieve = \"move\"");
    archive("1", "P1");
    const RunningListener listener(store_, "--config " + config_.string(), port_);
    ASSERT_TRUE(listener.answers());
    watch();
    EXPECT_THAT(watch(), HasSubstr("12 objects fetched, 0 failed"));
    EXPECT_TRUE(waitUntil([&] { return cases() == 1; }));
}

TEST_F(WatchOrthanc, IsAskedForStudiesByDescription)
{
    const auto one = study("1", "P1"), other = study("2", "P2");
    const auto files = test::writeSeries(folder_ / "one", one);
    test::describe(folder_ / "one");
    archive(files);
    archive(other);
    for (const char* by : {"--description 'CT COLON*'", "--series-description 'Prone*'"}) {
        const auto found = vicon(std::string("query pacs ") + by);
        EXPECT_THAT(found.output, HasSubstr(one.study_uid)) << by;
        EXPECT_THAT(found.output, Not(HasSubstr(other.study_uid))) << by;
    }
    EXPECT_EQ(vicon("query pacs --worklist --description x").exit_code, 2) << "a worklist is not asked by it";
}

/// An association of ORTHANC's brings no more than three objects into a store whose listener takes three.
TEST_F(WatchOrthanc, AMoveThatFailedHalfWayGoesOnWithWhatIsMissing)
{
    archive("1", "P1");
    const std::string retrieve = "retrieve pacs " + study("1", "P1").study_uid;
    const auto half = vicon(retrieve + " --method move --set receive.max_waiting=3 --set receive.quiet_s=60");
    EXPECT_EQ(half.exit_code, 1) << half.output;
    const auto rest = vicon(retrieve + " --method move");
    EXPECT_EQ(rest.exit_code, 0) << rest.output;
    EXPECT_THAT(rest.output, HasSubstr("9 objects retrieved, 0 failed"));
    const auto again = vicon(retrieve + " --method move");
    EXPECT_EQ(again.exit_code, 0) << again.output;
    EXPECT_THAT(again.output, HasSubstr("everything was there already"));
}

TEST_F(WatchOrthanc, AMoveBesideTheListenerEndsWhenTheCaseIsThere)
{
    archive("1", "P1");
    const RunningListener listener(store_, "--config " + config_.string(), port_);
    ASSERT_TRUE(listener.answers());
    configure(", retrieve = \"move\"");  // of the peer; the listener needs not know
    const auto moved = vicon("retrieve pacs " + study("1", "P1").study_uid);
    EXPECT_EQ(moved.exit_code, 0) << moved.output;
    EXPECT_THAT(moved.output, HasSubstr("the running listener imported them"));
    EXPECT_EQ(cases(), 1u);
}

}  // namespace
}  // namespace vicon::support
