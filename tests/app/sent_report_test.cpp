// From the signature to the archive: every object of a report arrives, is committed to, and is found there.
#include <gmock/gmock.h>

#include "delivering_listener.h"
#include "study.h"
#include "vicon/ingest/sender.h"

namespace vicon::support {
namespace {

namespace fs = std::filesystem;

using test::freePort;
using test::Orthanc;

class SentReport : public testing::Test {
protected:
    TemporaryFolder folder_;
    const int port_ = freePort();
    Orthanc orthanc_{folder_ / "orthanc", port_};
    const fs::path store_ = folder_ / "store", config_ = folder_ / "c.toml";
    std::string case_id_;

    void SetUp() override
    {
        replaceFile(config_, deliveringConfig(port_, orthanc_.peer().port));
        viconOn(store_, "import " + smallStudy().string());
        case_id_ = listedScans(store_).at(0).case_id;
        viconOn(store_, "assess " + case_id_ + " --c-rads C1 --why test --e-rads E1 --e-why test");
        ASSERT_TRUE(orthanc_.answers());
    }
    void run(const std::string& arguments) { viconOn(store_, arguments + " --config " + config_.string()); }
    std::string sent() { return viconJson(store_, "cases")["cases"][0]["delivery"]; }
    /// What the archive holds of this kind of object: the body of a GET below each instance.
    std::vector<std::string> held(const std::string& what)
    {
        std::vector<std::string> out;
        for (const std::string id : nlohmann::json::parse(orthanc_.get("/instances")))
            out.push_back(orthanc_.get("/instances/" + id + what));
        return out;
    }
};

TEST_F(SentReport, IsStoredCommittedAndFoundInTheArchive)
{
    const DeliveringListener listener(store_, config_);
    EXPECT_THAT(viconOn(store_, "doctor --config " + config_.string()), testing::HasSubstr("ok   peer pacs"));
    run("sign " + case_id_);
    EXPECT_TRUE(waitUntil([&] { return sent() == "2 committed"; })) << sent() << readFile(folder_ / "listener.log");
    EXPECT_THAT(held("/content/0008-0060"),
                testing::UnorderedElementsAre(testing::StartsWith("DOC"), testing::StartsWith("SR")));
    const std::string pdf = readFile(store_ / "cases" / case_id_ / "report" / "version-1.pdf");
    EXPECT_THAT(held("/pdf"), testing::Contains(testing::StartsWith(pdf))) << "an even length may add one byte";
    viconOn(store_, "export " + case_id_ + " --as dicom --out " + (folder_ / "out").string());
    EXPECT_EQ(readFile(folder_ / "out" / "version-1-pdf.dcm"),
              readFile(store_ / "cases" / case_id_ / "report" / "version-1-pdf.dcm"));
    EXPECT_TRUE(fs::exists(folder_ / "out" / "version-1-sr.dcm"));
    EXPECT_EQ(nlohmann::json::parse(orthanc_.get("/studies")).size(), 1u) << "in one study";
    viconJson(store_, "amend " + case_id_ + " --reason 'another word' --config " + config_.string());
    viconJson(store_, "sign " + case_id_ + " --config " + config_.string());
    EXPECT_TRUE(waitUntil([&] { return sent() == "4 committed"; })) << sent() << readFile(folder_ / "listener.log");
    EXPECT_EQ(orthanc_.objects(), 4u);
    viconJson(store_, "send " + case_id_ + " pacs --config " + config_.string());
    EXPECT_EQ(sent(), "4 committed") << "nothing is sent twice";
    const std::string study = viconJson(store_, "cases")["cases"][0]["study_uid"];
    EXPECT_EQ(viconJson(folder_ / "first", "query pacs --modality '' --config " + config_.string())["studies"].size(),
              1u);
    viconJson(folder_ / "first", "retrieve pacs " + study + " --reports --config " + config_.string());
    const std::string fetched =
        viconOn(folder_ / "elsewhere", "retrieve pacs " + study + " --reports --config " + config_.string());
    EXPECT_THAT(fetched, testing::HasSubstr("2 objects retrieved, 0 failed")) << "both versions";
    EXPECT_THAT(fetched, testing::HasSubstr("measurement report by VICON"));
}

TEST_F(SentReport, IsNotSignedWhereAPeerItShallGoToIsNotConfigured)
{
    const auto refused = runVicon("sign " + case_id_ + " --store " + store_.string() + " --config " + config_.string() +
                                  " --set 'report.send_to=[\"nobody\"]'");
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    EXPECT_THAT(refused.output, testing::HasSubstr("no peer of that name"));
    EXPECT_TRUE(viconJson(store_, "audit " + case_id_)["versions"].empty());
    EXPECT_TRUE(viconJson(store_, "outbox")["items"].empty());
}

}  // namespace
}  // namespace vicon::support
