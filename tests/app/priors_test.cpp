// An earlier report comes as an object alone, is matched, confirmed and named by the new report.
#include <gmock/gmock.h>

#include "study.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The point as an option's value.
std::string pointOf(const json& point)
{
    std::string at;
    for (const auto& coordinate : point)
        at.append(at.empty() ? "" : ",").append(coordinate.dump());
    return at;
}

/// The same study is read twice: once as that of years ago, whose report alone comes back, and once as today's.
class EarlierReport : public testing::Test {
protected:
    TemporaryFolder folder_;
    const fs::path then_ = folder_ / "then", now_ = folder_ / "now", config_ = folder_ / "c.toml";
    std::string case_id_, finding_at_;

    void SetUp() override
    {
        const std::string person = runCommand("id -un").output;
        replaceFile(config_, "[roles]\nsign = [\"" + person.substr(0, person.find('\n')) +
                                 "\"]\n[report]\nobjects = [\"pdf\", \"sr\"]\n");
        viconOn(now_, "import " + smallStudy().string());
        viconOn(now_, "work --until-idle");
        case_id_ = listedScans(now_).at(0).case_id;
        const json truth = json::parse(readFile(smallStudy() / "truth-supine.json"));
        finding_at_ = pointOf(truth["polyps"][0]["position_mm"]);
        viconOn(now_, "mark " + case_id_ + " --at=" + finding_at_);
        viconOn(now_, "finding " + case_id_ + " --add m1 --kind polyp --size 9");
        runCommand("cp -r " + now_.string() + " " + then_.string());
        viconOn(then_, "finding " + case_id_ + " --change f1 --size 7 --morphology sessile");
        sign(then_);
    }
    void sign(const fs::path& store) const
    {
        viconOn(store, "assess " + case_id_ + " --c-rads C2a --why test --e-rads E1 --e-why test");
        viconOn(store, "sign " + case_id_ + " --config " + config_.string());
    }
    /// The report as it would have come of another study of this patient.
    fs::path earlierReport() const
    {
        const fs::path sr = folder_ / "earlier.dcm";
        fs::copy_file(then_ / "cases" / case_id_ / "report/version-1-sr.dcm", sr);
        const auto changed = runCommand("dcmodify -nb -m StudyDate=20210315 -m StudyInstanceUID=1.2.3 " + sr.string());
        EXPECT_EQ(changed.exit_code, 0) << changed.output;
        return sr;
    }
    json priors(const std::string& more = "") const { return viconJson(now_, "priors " + case_id_ + more); }
};

TEST_F(EarlierReport, IsListedMatchedConfirmedAndNamed)
{
    EXPECT_EQ(priors()["priors"], json::array());
    viconOn(now_, "import " + earlierReport().string());
    const json listed = priors()["priors"].at(0), finding = listed["findings"].at(0);
    EXPECT_EQ(listed["study"]["date"], "20210315");
    EXPECT_EQ(finding["size_mm"], 7);
    EXPECT_EQ(finding["morphology"], "sessile");
    EXPECT_TRUE(finding["sights"][0].contains("part_fraction")) << finding;
    EXPECT_EQ(finding["alone"], true);
    EXPECT_EQ(finding["candidates"][0]["finding"], "f1");
    EXPECT_NEAR(finding["candidates"][0]["off_mm"].get<double>(), 0, 0.1) << "the same place of the same colon";
    EXPECT_THAT(viconOn(now_, "priors " + case_id_), HasSubstr("proposed: f1 (0 mm)"));

    viconOn(now_, "priors " + case_id_ + " --reject f1=1.1");
    EXPECT_EQ(priors()["comparisons"][0]["confirmed"], false);
    viconOn(now_, "priors " + case_id_ + " --take-back f1=1.1");
    EXPECT_EQ(priors()["comparisons"], json::array());
    const json said = priors(" --confirm f1=1.1")["comparisons"].at(0);
    EXPECT_EQ(said["before"]["size_mm"], 7);
    EXPECT_EQ(said["now"]["size_mm"], 9);
    EXPECT_EQ(said["report_uid"], listed["sop_uid"]);
    const std::string growth = said["growth"]["why_not"];
    EXPECT_THAT(growth, HasSubstr("too thick")) << "voxels of the small study are large";
    EXPECT_THAT(viconOn(now_, "audit " + case_id_), HasSubstr("comparison confirmed"));

    sign(now_);
    const std::string document = viconOn(now_, "export " + case_id_ + " --as json");
    replaceFile(folder_ / "report.json", document);
    EXPECT_EQ(schemaFaults("report", {folder_ / "report.json"}), "");
    const fs::path report = now_ / "cases" / case_id_ / "report";
    const std::string sr = runCommand("dsrdump +Pu " + (report / "version-1-sr.dcm").string()).output;
    EXPECT_THAT(sr, HasSubstr("Earlier report"));
    EXPECT_THAT(sr, HasSubstr(listed["sop_uid"].get<std::string>()));
    EXPECT_THAT(runCommand("dciodvfy " + (report / "version-1-sr.dcm").string()).output,
                testing::Not(HasSubstr("Error")));
    const std::string words = "then polyp of 7.0 mm in the";
    EXPECT_THAT(viconOn(now_, "export " + case_id_ + " --as text"), HasSubstr("COMPARED WITH EARLIER REPORTS"));
    EXPECT_THAT(runCommand("pdftotext -layout " + (report / "version-1.pdf").string() + " -").output, HasSubstr(words));
    EXPECT_EQ(runVicon("priors " + case_id_ + " --reject f1=1.1 --store " + now_.string()).exit_code, 2)
        << "the report is signed";
}

}  // namespace
}  // namespace vicon::support
