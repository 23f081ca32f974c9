// MR colonography from the files to the signed report: nowhere is a signal called a density.
#include <gmock/gmock.h>

#include "study.h"
#include "vicon/core/file.h"

namespace vicon::support {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Mr : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TemporaryFolder;
        const auto made = runVicon("phantom " + (*folder_ / "in").string() +
                                   " --mr bright --supine --no-folds --seed 614 --size 160x160x134 --gap 0");
        ASSERT_EQ(made.exit_code, 0) << made.output;
        viconOn(store(), "import " + (*folder_ / "in" / "series-2-supine").string());
        viconOn(store(), "work --until-idle");
    }
    static void TearDownTestSuite() { delete folder_; }
    static fs::path store() { return *folder_ / "store"; }
    static ListedScan scan() { return listedScans(store()).at(0); }
    static std::string polyp()
    {
        const auto truth = nlohmann::json::parse(readFile(*folder_ / "in" / "truth-supine.json"));
        const auto at = truth["polyps"][0]["position_mm"];
        return std::to_string(at[0].get<double>()) + "," + std::to_string(at[1].get<double>()) + "," +
               std::to_string(at[2].get<double>());
    }

    static TemporaryFolder* folder_;
};
TemporaryFolder* Mr::folder_ = nullptr;

TEST_F(Mr, IsPreparedAndToldInItsOwnUnit)
{
    const std::string shown = viconOn(store(), "show " + scan().case_id);
    EXPECT_THAT(shown, AllOf(HasSubstr("contrast bright"), HasSubstr("threshold_signal"), Not(HasSubstr(" HU"))));
    const auto segment = viconJson(store(), "show " + scan().case_id)["scans"][0]["steps"]["segment"]["result"];
    EXPECT_EQ(segment["verdict"], "colon") << segment.dump(1);
    EXPECT_FALSE(segment.contains("noise_hu"));
    EXPECT_THAT(segment["reason"], AllOf(HasSubstr("one run of lumen"), Not(HasSubstr("gas"))));
    EXPECT_TRUE(fs::exists(scan().folder / "lumen_scale.mha"));
    EXPECT_FALSE(fs::exists(scan().folder / "cleansed.mha")) << "nothing is tagged in MR";
    EXPECT_THAT(viconOn(store(), "work --until-idle --redo-outdated"), HasSubstr("0 done")) << "nothing is out of date";
}

TEST_F(Mr, StepsBehindTheLumenAreMadeAgainFromWhatIsOnTheDisk)
{
    const auto before = readFile(scan().folder / "inside.mha");
    fs::remove(scan().folder / "tissue.mha");
    EXPECT_THAT(viconOn(store(), "work --until-idle --redo-outdated"), HasSubstr("1 done, 0 failed"));
    EXPECT_EQ(readFile(scan().folder / "inside.mha"), before);
}

TEST_F(Mr, WhatNeedsDensitiesIsRefusedAndSaysWhy)
{
    const std::string on = " --store " + store().string();
    const auto biopsy = runVicon("mark " + scan().case_id + " --at " + polyp() + " --biopsy 3" + on);
    EXPECT_EQ(biopsy.exit_code, 2) << biopsy.output;
    EXPECT_THAT(biopsy.output, HasSubstr("MR has none"));
    const std::string snapshot = "snapshot " + scan().case_id + " --out " + (*folder_ / "x.png").string() + on;
    const auto peel = runVicon(snapshot + " --view endo --peel fat");
    EXPECT_EQ(peel.exit_code, 2) << peel.output;
    EXPECT_THAT(peel.output, HasSubstr("MR has none"));
    const auto acquired = runVicon(snapshot + " --view cube --as-acquired");
    EXPECT_EQ(acquired.exit_code, 2) << acquired.output;
    EXPECT_THAT(acquired.output, HasSubstr("MR has none"));
    const auto window = runVicon(snapshot + " --view slices --window bone");
    EXPECT_EQ(window.exit_code, 2) << window.output;
    EXPECT_THAT(window.output, HasSubstr("use one of whole, wall, tissue"));
    viconOn(store(),
            "snapshot " + scan().case_id + " --view slices --window wall --out " + (*folder_ / "wall.png").string());
    const auto organ = runVicon("work --until-idle --case " + scan().case_id + " --organ airway" + on);
    EXPECT_THAT(organ.output, HasSubstr("in MR the colon alone is sought"));
    viconOn(store(), "work --until-idle --case " + scan().case_id + " --organ colon");
}

TEST_F(Mr, AGivenLumenTellsPolarityAndThreshold)
{
    const std::string mask = (*folder_ / "in" / "truth-supine-inside.mha").string();
    const std::string import = "import --mask " + scan().case_id + " " + scan().scan_id + " ";
    viconOn(store(), import + mask);
    viconOn(store(), "work --until-idle");
    const auto segment = viconJson(store(), "show " + scan().case_id)["scans"][0]["steps"]["segment"]["result"];
    EXPECT_EQ(segment["contrast"], "bright") << segment.dump(1);
    EXPECT_GT(segment["lumen_signal"].get<double>(), segment["tissue_signal"].get<double>());
    viconOn(store(), import + "none");
    viconOn(store(), "work --until-idle");
}

TEST_F(Mr, AReportSpeaksOfMr)
{
    const std::string id = scan().case_id;
    const std::string marker = viconJson(store(), "mark " + id + " --at " + polyp())["id"];
    viconOn(store(), "finding " + id + " --add " + marker + " --size 7 --morphology sessile");
    viconOn(store(), "assess " + id + " --c-rads C2a --why test --e-rads E1 --e-why test");
    const fs::path config = *folder_ / "signs.toml";
    replaceFile(config, "[roles]\nsign = [\"" + runCommand("id -un | tr -d '\\n'").output + "\"]\n");
    viconOn(store(), "sign " + id + " --config " + config.string());
    const fs::path report = store() / "cases" / id / "report";
    const std::string text = viconOn(store(), "export " + id + " --as text");
    EXPECT_THAT(text, AllOf(HasSubstr("MR COLONOGRAPHY REPORT"), Not(HasSubstr(" HU"))));
    const auto pdf = runCommand("pdftotext -layout " + (report / "version-1.pdf").string() + " -");
    EXPECT_THAT(pdf.output, AllOf(HasSubstr("MR colonography report"), Not(HasSubstr(" HU")),
                                  Not(HasSubstr("CT colonography report")), Not(HasSubstr("fat green"))));
    const auto sr = runCommand("dsrdump " + (report / "version-1-sr.dcm").string());
    EXPECT_THAT(sr.output, AllOf(HasSubstr("Magnetic Resonance"), HasSubstr("MR colonography"),
                                 Not(HasSubstr("Computed Tomography"))));
    const auto fhir = nlohmann::json::parse(viconOn(store(), "export " + id + " --as fhir"));
    EXPECT_THAT(fhir.dump(), AllOf(HasSubstr(R"("code":"MR")"), Not(HasSubstr(R"("code":"CT")"))));
    EXPECT_THAT(viconOn(store(), "export " + id + " --as hl7"), HasSubstr("MR_COLONOGRAPHY"));
    const auto kept = nlohmann::json::parse(viconOn(store(), "export " + id + " --as json"));
    EXPECT_EQ(kept["content"]["scans"][0]["modality"], "MR");
}

}  // namespace
}  // namespace vicon::support
