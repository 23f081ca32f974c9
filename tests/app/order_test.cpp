// Orders of a modality worklist, from outside.
#include <gmock/gmock.h>

#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"
#include "vicon/cases/case_store.h"
#include "worklist_server.h"

namespace vicon::support {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class OrderedCase : public testing::Test {
protected:
    TemporaryFolder folder_;
    test::WorklistServer ris_{folder_ / "ris"};
    const std::filesystem::path store_ = folder_ / "store", config_ = folder_ / "c.toml";
    test::SeriesSpec spec_;

    void SetUp() override
    {
        spec_.study_date = nowUtc().substr(0, 10);
        std::erase(spec_.study_date, '-');
        replaceFile(config_, "[peers]\nris = { host = \"127.0.0.1\", port = " + std::to_string(ris_.peer().port) +
                                 ", ae_title = \"RIS\" }\n[orders]\npeer = \"ris\"\npoll_s = 1\n[receive]\n"
                                 "quiet_s = 0\n");
        test::writeScheduled(ris_.scheduled() / "1.wl", {.date = spec_.study_date});
        ASSERT_TRUE(ris_.answers());
    }
    CommandResult vicon(const std::string& arguments) const
    {
        return runVicon(arguments + " --store " + store_.string() + " --config " + config_.string());
    }
    nlohmann::json shown() const { return viconJson(store_, "show " + CaseStore::caseIdFor(spec_.study_uid)); }
};

TEST_F(OrderedCase, TakesItsOrderByHand)
{
    const auto scheduled = vicon("query ris --worklist --patient P1");
    EXPECT_EQ(scheduled.exit_code, 0);
    EXPECT_THAT(scheduled.output, AllOf(HasSubstr("A77"), HasSubstr("CT colonography"), HasSubstr("Weiss^Anna")));
    const auto as_json =
        nlohmann::json::parse(vicon("query ris --worklist --date " + spec_.study_date + " --json").output);
    expectSchema("query_worklist", as_json);
    EXPECT_EQ(as_json["steps"][0]["reason"].get<std::string>().substr(0, 10), "Incomplete");
    test::writeSeries(folder_ / "in", spec_);
    ASSERT_EQ(vicon("import " + (folder_ / "in").string()).exit_code, 0);
    EXPECT_EQ(shown()["study"]["accession_number"], "");
    const auto taken = nlohmann::json::parse(vicon("order --json").output);
    expectSchema("order", taken);
    EXPECT_THAT(taken["cases"][0]["taken"], ElementsAre("accession number", "referring physician"));
    EXPECT_EQ(shown()["study"]["accession_number"], "A77");
    EXPECT_EQ(shown()["order"]["procedure"], "CT colonography");
    EXPECT_THAT(vicon("show " + CaseStore::caseIdFor(spec_.study_uid)).output,
                AllOf(HasSubstr("accession number A77"), HasSubstr("referred by Weiss^Anna"),
                      HasSubstr("ordered as CT colonography")));
    EXPECT_THAT(vicon("order").output, HasSubstr("no case waits for its order"));
    EXPECT_EQ(viconJson(store_, "cases --search a77")["cases"].size(), 1U);
    const auto none = runVicon("order --store " + store_.string());
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.output, HasSubstr("no modality worklist is configured"));
}

TEST_F(OrderedCase, GetsItsOrderWhileTheListenerRuns)
{
    std::filesystem::remove(ris_.scheduled() / "1.wl");
    RunningListener listener(store_, "--config " + config_.string());
    ASSERT_TRUE(listener.answers()) << listener.log();
    NoProgress quiet;
    ASSERT_TRUE(ingest::storeFiles(listener.peer(), test::writeSeries(folder_ / "in", spec_), "CT1", quiet).complete());
    EXPECT_TRUE(support::waitUntil([&] { return viconJson(store_, "cases")["cases"].size() == 1; })) << listener.log();
    test::writeScheduled(ris_.scheduled() / "1.wl", {.date = spec_.study_date});  // it was ordered late
    EXPECT_TRUE(support::waitUntil([&] { return shown()["study"]["accession_number"] == "A77"; })) << listener.log();
    EXPECT_THAT(listener.log(), HasSubstr("order found at ris, 2 taken, 0 flagged"));
}

}  // namespace
}  // namespace vicon::support
