// An archive that is watched, from outside.
#include <gmock/gmock.h>

#include "dicom_writer.h"
#include "orthanc.h"
#include "study.h"
#include "vicon/core/file.h"

namespace vicon::support {
namespace {

using testing::HasSubstr;
using testing::Not;

class WatchOrthanc : public testing::Test {
protected:
    TemporaryFolder folder_;
    test::Orthanc orthanc_{folder_ / "orthanc"};
    const std::filesystem::path store_ = folder_ / "store", config_ = folder_ / "c.toml";
    NoProgress quiet_;

    void SetUp() override
    {
        replaceFile(config_, "[peers]\npacs = { host = \"127.0.0.1\", port = " + std::to_string(orthanc_.peer().port) +
                                 ", ae_title = \"ORTHANC\" }\n[watch]\nleast_slices = 10\ndays = 36500\n");
        ASSERT_TRUE(orthanc_.answers());
    }
    void archive(const std::string& number, const std::string& patient, const std::vector<int>& slices = {})
    {
        test::SeriesSpec spec;
        spec.study_uid += "." + number;
        spec.series_uid += "." + number;
        spec.patient_id = patient;
        ASSERT_TRUE(ingest::storeFiles(orthanc_.peer(), test::writeSeries(folder_ / ("in" + number), spec, slices),
                                       "SCANNER", quiet_)
                        .complete());
    }
    std::string watch(const std::string& more = "")
    {
        const auto done =
            runVicon("watch pacs --once --store " + store_.string() + " --config " + config_.string() + more + " 2>&1");
        EXPECT_EQ(done.exit_code, 0) << done.output;
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

}  // namespace
}  // namespace vicon::support
