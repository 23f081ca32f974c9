// What a signature makes of a prepared scan, as programs of other making read and take it.
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "delivering_listener.h"
#include "study.h"
#include "vicon/core/file.h"
#include "vicon/ingest/sender.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using nlohmann::json;

class SignedObjects : public testing::Test {
protected:
    TemporaryFolder folder_;
    const fs::path store_ = folder_ / "store", config_ = folder_ / "c.toml";
    const int peer_port_ = test::freePort();
    ListedScan scan_;

    void SetUp() override
    {
        replaceFile(config_, deliveringConfig(test::freePort(), peer_port_));
        scan_ = readSmallStudy(store_);
        viconOn(store_, "sign " + scan_.case_id + " --set 'report.send_to=[]' --config " + config_.string());
        viconOn(store_, "export " + scan_.case_id + " --as dicom --out " + exported().string());
    }
    fs::path exported() const { return folder_ / "signed"; }
    json read(const fs::path& objects) const
    {
        const auto result =
            runCommand("/usr/bin/python3 " VICON_CHECK_SIGNED " " + objects.string() + " " + scan_.folder.string());
        EXPECT_EQ(result.exit_code, 0) << result.output;
        return json::parse(result.output);
    }
};

TEST_F(SignedObjects, HoldLumenCentrelineAndPicturesOfTheScan)
{
    const json found = read(exported());
    EXPECT_EQ(found["modalities"], json({"DOC", "KO", "OT", "SEG", "SR"}));
    EXPECT_GT(found["segmentation"]["dice"], 0.995) << found;
    EXPECT_LT(found["segmentation"]["beyond_mm"], 0.1) << found;
    EXPECT_GT(found["segmentation"]["voxels"], 10'000) << found;
    EXPECT_EQ(found["centreline"]["lines"], 1);
    EXPECT_NEAR(found["centreline"]["points_mm"].get<double>(), found["centreline"]["said_mm"].get<double>(), 0.1);
    const double station_mm = viconJson(store_, "markers " + scan_.case_id)["markers"][0]["station_mm"];
    EXPECT_GT(found["centreline"]["said_mm"].get<double>(), station_mm);
    EXPECT_GE(found["pictures"][0]["width"].get<int>(), 2 * found["pictures"][0]["height"].get<int>())
        << "from inside, and slices";
    EXPECT_GT(found["pictures"][0]["colours"].get<int>(), 1000);
    for (const auto& file : fs::directory_iterator(exported())) {
        const fs::path plain = folder_ / file.path().filename();
        runCommand("dcmconv +te " + file.path().string() + " " + plain.string());
        EXPECT_THAT(runCommand("dciodvfy " + plain.string()).output, testing::Not(testing::HasSubstr("Error")))
            << plain.filename();
    }
}

TEST_F(SignedObjects, ThatWereAlteredOrLostAreSaidAndNotGivenOut)
{
    const fs::path report = store_ / "cases" / scan_.case_id / "report", altered = report / "version-1-pdf.dcm";
    replaceFile(altered, readFile(altered) + "x");
    fs::remove(report / "version-1-sr.dcm");
    const std::string fault = "version-1-pdf.dcm is not what was kept; version-1-sr.dcm is missing";
    const fs::path again = folder_ / "again";
    for (const std::string& asked :
         {"audit " + scan_.case_id, "export " + scan_.case_id + " --as dicom --out " + again.string(),
          "send " + scan_.case_id + " pacs --later --config " + config_.string()}) {
        const CommandResult told = runVicon(asked + " --store " + store_.string());
        EXPECT_EQ(told.exit_code, 1) << asked;
        EXPECT_THAT(told.output, testing::HasSubstr(fault)) << asked;
    }
    EXPECT_FALSE(fs::exists(again));
    EXPECT_TRUE(viconJson(store_, "outbox")["items"].empty());
}

TEST_F(SignedObjects, AreTakenByAPeerThatKnowsOnlyImplicitLittleEndian)
{
    const fs::path taken = folder_ / "taken";
    fs::create_directories(taken);
    const pid_t peer = ::fork();
    if (peer == 0) {
        ::execlp("storescp", "storescp", "+xi", "-aet", "ORTHANC", "-od", taken.c_str(),
                 std::to_string(peer_port_).c_str(), nullptr);
        std::_Exit(127);
    }
    CommandResult sent{1, ""};
    EXPECT_TRUE(waitUntil([&] {  // until the peer listens
        sent = runVicon("send " + scan_.case_id + " pacs --wait 0 --store " + store_.string() + " --config " +
                        config_.string());
        return sent.exit_code == 0;
    })) << sent.output;
    ::kill(peer, SIGTERM);
    ::waitpid(peer, nullptr, 0);
    EXPECT_EQ(std::distance(fs::directory_iterator(taken), fs::directory_iterator{}), 5) << sent.output;
    json here = read(exported()), there = read(taken);
    EXPECT_EQ(here, there);
}

}  // namespace
}  // namespace vicon::support
