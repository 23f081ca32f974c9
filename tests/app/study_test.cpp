#include <gmock/gmock.h>

#include <fstream>

#include "study.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using testing::HasSubstr;

/// The whole path on a small study, once for all tests of this file.
class Study : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TemporaryFolder;
        viconOn(store(), "import " + smallStudy().string());
        work_output_ = viconOn(store(), "work --until-idle");
        const auto scans = listedScans(store());
        ASSERT_EQ(scans.size(), 1u);
        scan_ = scans.front();
        truth_ = nlohmann::json::parse(std::ifstream(smallStudy() / "truth-supine.json"));
    }
    static void TearDownTestSuite()
    {
        delete folder_;
        folder_ = nullptr;
    }
    static fs::path store() { return folder_->path() / "store"; }
    static std::string at(const nlohmann::json& p)
    {
        return " --at=" + std::to_string(p[0].get<double>()) + "," + std::to_string(p[1].get<double>()) + "," +
               std::to_string(p[2].get<double>());
    }

    /// At a polyp, as a reader of a finer scan measured its density. Returns its id.
    static std::string addMeasuredMarker()
    {
        const auto& place = truth_["polyps"][0]["position_mm"];
        const nlohmann::json density = {
            {"position_mm", place}, {"radius_mm", 4},
            {"margin_mm", 2},       {"voxels", 30},
            {"mean_hu", 41.5},      {"sd_hu", 12.25},
            {"fat_fraction", 0},    {"histogram", {{"from_hu", 25}, {"bin_hu", 25}, {"counts", {30}}}}};
        const fs::path file = folder_->path() / "measured.json";
        std::ofstream(file) << nlohmann::json{{"markers",
                                               {{{"id", "m90"},
                                                 {"scan", scan_.scan_id},
                                                 {"position_mm", place},
                                                 {"color", "red"},
                                                 {"density", density}}}}};
        viconOn(store(), "markers " + scan_.case_id + " --import " + file.string());
        return "m90";
    }

    static TemporaryFolder* folder_;
    static std::string work_output_;
    static ListedScan scan_;
    static nlohmann::json truth_;
};
TemporaryFolder* Study::folder_ = nullptr;
std::string Study::work_output_;
ListedScan Study::scan_;
nlohmann::json Study::truth_;

TEST_F(Study, HasEveryFileOfTheContract)
{
    for (const char* file : {"scan.json", "volume.mha", "inside.mha", "skeleton.vtp", "skeleton_voxels.vtp",
                             "segments.mha", "subdivision.json", "cells.vtp", "exit_distance.mha", "wall_distance.mha",
                             "projections/coronal.png", "projections/transverse.png", "projections/sagittal.png"})
        EXPECT_TRUE(fs::exists(scan_.folder / file)) << file;
    EXPECT_EQ(scan_.state, "done");
    EXPECT_EQ(scan_.position, "supine");
    for (const auto& entry : fs::recursive_directory_iterator(store())) {
        const auto mode = entry.status().permissions() & fs::perms::all;
        EXPECT_EQ(mode & (fs::perms::group_all | fs::perms::others_all), fs::perms::none) << entry.path();
        EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr("Phantom"))) << "no patient's name in a path";
    }
}

TEST_F(Study, InAStoreThatAGroupSharesEverythingIsTheGroups)
{
    const TemporaryFolder folder;
    const fs::path shared = folder / "store";
    fs::create_directory(shared);
    fs::permissions(shared, fs::perms::owner_all | fs::perms::group_all | fs::perms::set_gid);
    const ListedScan scan = readSmallStudy(shared);
    viconOn(shared, "report " + scan.case_id);
    constexpr auto kOfGroup = fs::perms::group_read | fs::perms::group_write;
    for (const auto& entry : fs::recursive_directory_iterator(shared)) {
        const auto mode = entry.status().permissions();
        EXPECT_EQ(mode & kOfGroup, kOfGroup) << entry.path();
        EXPECT_EQ(mode & fs::perms::others_all, fs::perms::none) << entry.path();
        if (entry.is_directory()) {
            EXPECT_EQ(mode & fs::perms::set_gid, fs::perms::set_gid) << entry.path();
        }
    }
}

TEST_F(Study, FindsTheColonsLength)
{
    const auto show = viconJson(store(), "show " + scan_.case_id);
    const double length = show["scans"][0]["steps"]["skeleton"]["result"]["length_mm"];
    EXPECT_NEAR(length / truth_["length_mm"].get<double>(), 1, 0.05) << "voxels of 2.4 mm";
}

TEST_F(Study, WorkingAgainChangesNothingAndOtherParametersRedoWhatDependsOnThem)
{
    const auto before = filesOf(store());
    viconOn(store(), "work --until-idle");
    EXPECT_TRUE(filesOf(store()) == before);

    const auto timesOf = [&] {
        std::map<std::string, std::string> times;
        const auto show = viconJson(store(), "show " + scan_.case_id);
        for (const auto& [step, about] : show["scans"][0]["steps"].items())
            times[step] = about["finished"].get<std::string>() + about["digest"].get<std::string>();
        return times;
    };
    const auto first = timesOf();
    const std::string other = "work --until-idle --set subdivide.length_mm=50";
    EXPECT_THAT(viconOn(store(), other), HasSubstr("1 finished scans are out of date"));
    EXPECT_EQ(timesOf(), first) << "nothing is done again unasked";
    viconOn(store(), other + " --redo-outdated");
    const auto second = timesOf();
    for (const char* kept : {"resample", "segment", "tissue", "skeleton", "potential"})
        EXPECT_EQ(second.at(kept), first.at(kept)) << kept;
    EXPECT_NE(second.at("subdivide"), first.at("subdivide"));
    viconOn(store(), "work --until-idle --redo-outdated");
    EXPECT_TRUE(filesOf(store()) == before) << "and back";
}

TEST_F(Study, TheTableOfSubdivisionsHasARowForEveryMeasureOfSizeAndPortalsAndIsWhatTheStepMakes)
{
    const auto lines = [](const std::string& options) {
        std::vector<std::string> rows;
        for (const std::string& line :
             linesWithoutProgress(viconOn(store(), "show " + scan_.case_id + " --subdivision-table" + options)))
            if (line.starts_with(scan_.scan_id))
                rows.push_back(line);
        return rows;
    };
    /// As the table has it: "12 / 13 ... 1234 ... 2345 / 321 ... 456.78".
    const auto stored = [] {
        const auto s = nlohmann::json::parse(std::ifstream(scan_.folder / "subdivision.json"))["statistics"];
        const auto number = [&](const char* key, const char* pattern) {
            char text[40];
            std::snprintf(text, sizeof text, pattern, s[key].get<double>());
            return std::string(text);
        };
        return number("segments", "%.0f") + " / " + number("specified_segments", "%.0f") + " +" +
               number("triangles_average", "%.0f") + " +" + number("triangles_largest", "%.0f") + " / " +
               number("triangles_smallest", "%.0f") + " +" + number("triangles_standard_deviation", "%.2f");
    };
    const auto before = filesOf(store());
    const auto rows = lines("");
    ASSERT_EQ(rows.size(), 10u) << "flood, then three measures of size by three of portals";
    EXPECT_THAT(rows[0], testing::ContainsRegex("flood +- +- +" + stored()));
    int row = 1;
    for (const std::string size : {"surface", "inside", "triangles"})
        for (const std::string portals : {"tangent", "portal_size", "gate_ratio"})
            EXPECT_THAT(rows[std::size_t(row++)],
                        testing::ContainsRegex("thesis +" + size + " +" + portals + " +[0-9]"));
    EXPECT_TRUE(filesOf(store()) == before) << "it only looks";

    viconOn(store(),
            "work --until-idle --redo-outdated --set subdivide.method=thesis --set subdivide.size=inside"
            " --set subdivide.effectiveness=tangent");
    EXPECT_THAT(rows[4], testing::ContainsRegex("thesis +inside +tangent +" + stored()));
    viconOn(store(), "work --until-idle --redo-outdated");
    EXPECT_TRUE(filesOf(store()) == before) << "and back";
}

TEST_F(Study, ACorrectionIsKeptWithTheScanAndRedoesWhatDependsOnIt)
{
    const auto before = filesOf(store());
    const auto stepsOf = [&] {
        const auto show = viconJson(store(), "show " + scan_.case_id);
        return show["scans"][0]["steps"];
    };
    const auto first = stepsOf();
    const auto& p = truth_["curve_mm"][truth_["curve_mm"].size() * 8 / 10];
    const std::string point = std::to_string(p[0].get<double>()) + "," + std::to_string(p[1].get<double>()) + "," +
                              std::to_string(p[2].get<double>());
    viconOn(store(), "work --until-idle --case " + scan_.case_id + " --cut=" + point);
    const auto second = stepsOf();
    EXPECT_EQ(second["resample"]["digest"], first["resample"]["digest"]);
    EXPECT_EQ(second["resample"]["finished"], first["resample"]["finished"]) << "not done again";
    for (const char* redone : {"segment", "tissue", "skeleton", "subdivide", "potential", "quality"})
        EXPECT_NE(second[redone]["digest"], first[redone]["digest"]) << redone;
    EXPECT_NEAR(second["skeleton"]["result"]["length_mm"].get<double>() /
                    first["skeleton"]["result"]["length_mm"].get<double>(),
                0.8, 0.05);
    EXPECT_THAT(viconOn(store(), "show " + scan_.case_id), HasSubstr("corrected: cut at"));

    viconOn(store(), "work --until-idle");
    EXPECT_EQ(stepsOf()["segment"]["digest"], second["segment"]["digest"]) << "kept for every later run";

    viconOn(store(), "work --until-idle --forget-corrections --case " + scan_.case_id);
    EXPECT_TRUE(filesOf(store()) == before) << "and back";
}

TEST_F(Study, RefusesCorrectionsThatCannotBeMeant)
{
    for (const std::string arguments : {" --add=1,2", " --cut=5000,0,0", " --drop=a,b,c"}) {
        const auto refused =
            runVicon("work --until-idle --case " + scan_.case_id + arguments + " --store " + store().string());
        EXPECT_NE(refused.exit_code, 0) << arguments;
        EXPECT_THAT(refused.output, HasSubstr(arguments.substr(1, 5))) << "names the option";
    }
    EXPECT_NE(runVicon("work --until-idle --add=1,2,3 --store " + store().string()).exit_code, 0) << "of which case?";
}

TEST_F(Study, RedoesAFileThatIsMissing)
{
    const auto before = filesOf(store());
    fs::remove(scan_.folder / "skeleton.vtp");
    viconOn(store(), "work --until-idle --redo-outdated");
    EXPECT_TRUE(filesOf(store()) == before);
}

TEST_F(Study, ImportingAgainChangesNothing)
{
    const auto before = filesOf(store());
    viconOn(store(), "import " + smallStudy().string());
    EXPECT_TRUE(filesOf(store()) == before);
    EXPECT_EQ(listedScans(store()).front().state, "done") << "not queued again";
}

TEST_F(Study, PutsMarkersAtTheStationOfTheTruthAndRefusesPointsOutside)
{
    const auto& polyp = truth_["polyps"][0];
    const auto marker =
        viconJson(store(), "mark " + scan_.case_id + at(polyp["position_mm"]) + " --color yellow --note 'a polyp'");
    EXPECT_NEAR(marker["station_mm"].get<double>(), polyp["station_mm"].get<double>(), 15);
    EXPECT_EQ(marker["scan"], scan_.scan_id);
    EXPECT_NEAR(marker["fraction"].get<double>(),
                marker["station_mm"].get<double>() /
                    (marker["station_mm"].get<double>() + marker["from_caecum_mm"].get<double>()),
                1e-9);
    const auto refused = runVicon("mark " + scan_.case_id + " --at 5000,0,0 --store " + store().string());
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.output, HasSubstr("outside the lumen"));
    EXPECT_EQ(runVicon("mark " + scan_.case_id + " --at 1,2 --store " + store().string()).exit_code, 2);

    viconOn(store(), "markers " + scan_.case_id + " --change m1 --color green --note changed");
    viconOn(store(), "markers " + scan_.case_id + " --export " + (folder_->path() / "m.json").string());
    viconOn(store(), "markers " + scan_.case_id + " --remove m1");
    EXPECT_EQ(viconJson(store(), "markers " + scan_.case_id)["markers"].size(), 0u);
    viconOn(store(), "markers " + scan_.case_id + " --import " + (folder_->path() / "m.json").string());
    const auto back = viconJson(store(), "markers " + scan_.case_id)["markers"];
    ASSERT_EQ(back.size(), 1u);
    EXPECT_EQ(back[0]["note"], "changed");
    EXPECT_EQ(back[0]["color"], "green");
    EXPECT_TRUE(nlohmann::json::parse(std::ifstream(scan_.folder / "markers.json"))["markers"] == back);
}

TEST_F(Study, RefusesABiopsyOfAWallThatIsTooThinForTheVoxelsWithItsReason)
{
    // Polyps of 5 to 8 mm on a thin wall, in voxels of 2.4 mm; behind them is fat, which is nobody's density here.
    const std::string place = at(truth_["polyps"][0]["position_mm"]);
    for (const std::string radius_mm : {"2", "12"}) {
        const auto thin =
            runVicon("mark " + scan_.case_id + place + " --biopsy " + radius_mm + " --store " + store().string());
        EXPECT_EQ(thin.exit_code, 2) << radius_mm;
        EXPECT_THAT(thin.output, HasSubstr("too little tissue between its surface and its far side")) << radius_mm;
    }
    EXPECT_EQ(runVicon("mark " + scan_.case_id + place + " --biopsy 0 --store " + store().string()).exit_code, 2);
}

TEST_F(Study, KeepsTheDensityOfAVirtualBiopsyWithTheMarkerUntilItIsMovedAway)
{
    const std::string id = addMeasuredMarker();
    const auto kept = [&] {
        const auto markers = viconJson(store(), "markers " + scan_.case_id)["markers"];
        for (const auto& m : markers)
            if (m["id"] == id)
                return m.contains("density");
        return false;
    };
    EXPECT_TRUE(kept());
    viconOn(store(), "markers " + scan_.case_id + " --change " + id + " --note changed");
    EXPECT_TRUE(kept());
    viconOn(store(), "markers " + scan_.case_id + " --change " + id + at(truth_["polyps"][1]["position_mm"]));
    EXPECT_FALSE(kept()) << "it was another place's";
    viconOn(store(), "markers " + scan_.case_id + " --remove " + id);
}

TEST_F(Study, NamesThePartOfTheColonInShowMarkersAndReport)
{
    const auto scan = viconJson(store(), "show " + scan_.case_id)["scans"][0];
    ASSERT_EQ(scan["parts"].size(), truth_["parts"].size());
    constexpr double kTolerance_mm = 45;
    int checked = 0;
    for (const auto& polyp : truth_["polyps"])
        for (const auto& part : truth_["parts"]) {
            const double station_mm = polyp["station_mm"];
            if (station_mm < part["from_mm"].get<double>() + kTolerance_mm ||
                station_mm > part["to_mm"].get<double>() - kTolerance_mm)
                continue;
            const auto marker = viconJson(store(), "mark " + scan_.case_id + at(polyp["position_mm"]));
            EXPECT_EQ(marker["part"], part["name"]) << station_mm;
            const std::string id = marker["id"], name = part["name"];
            EXPECT_THAT(viconOn(store(), "markers " + scan_.case_id), HasSubstr(name));
            if (checked++ == 0) {
                const fs::path pdf = folder_->path() / "named.pdf";
                viconOn(store(), "report " + scan_.case_id + " --out " + pdf.string());
                const std::string text = runCommand("pdftotext -layout " + pdf.string() + " -").output;
                EXPECT_THAT(text, testing::ContainsRegex("Segment +" + name));
                EXPECT_THAT(text, testing::ContainsRegex(name + " +[0-9]+ mm +[0-9]+ ml, [0-9]+ %"));
            }
            viconOn(store(), "markers " + scan_.case_id + " --remove " + id);
        }
    EXPECT_GE(checked, 2);
    const std::string shown = viconOn(store(), "show " + scan_.case_id);
    for (const char* word : {"quality: ", "hepatic flexure", "FLUID ML", "noise"})
        EXPECT_THAT(shown, HasSubstr(word));
}

TEST_F(Study, MeasuresNoiseAsItIsAndCountsTheFluidThatWasFound)
{
    const auto scan = viconJson(store(), "show " + scan_.case_id)["scans"][0];
    const auto& quality = scan["quality"];
    EXPECT_NEAR(quality["noise_hu"].get<double>() / truth_["noise_hu"].get<double>(), 1, 0.35)
        << "interpolation between slices takes some away";
    const double found_ml = scan["steps"]["segment"]["result"]["fluid_ml"];
    EXPECT_NEAR(quality["fluid_ml"].get<double>(), found_ml, 0.02 * found_ml + 1);
    EXPECT_EQ(quality["parts"].size(), 8u);
}

TEST_F(Study, MakesPicturesAndAReportAndPrintsTheirPaths)
{
    viconOn(store(), "mark " + scan_.case_id + at(truth_["polyps"][1]["position_mm"]) + " --note 'for the report'");
    for (const std::string view : {"endo", "slices", "overview"}) {
        const fs::path out = folder_->path() / (view + ".png");
        const std::string printed =
            viconOn(store(), "snapshot " + scan_.case_id + " --view " + view + " --station 300 --out " + out.string());
        EXPECT_THAT(printed, testing::EndsWith(out.string() + "\n"));
        EXPECT_GT(fs::file_size(out), 5000u) << view;
    }
    const fs::path pdf = folder_->path() / "report.pdf";
    EXPECT_THAT(viconOn(store(), "report " + scan_.case_id + " --out " + pdf.string()),
                testing::EndsWith(pdf.string() + "\n"));
    const std::string text = runCommand("pdftotext -layout " + pdf.string() + " -").output;
    EXPECT_THAT(text, HasSubstr("for the report"));
    EXPECT_THAT(text, HasSubstr("Phantom"));
    EXPECT_EQ(runCommand("qpdf --check " + pdf.string()).exit_code, 0);
    const std::string stored = viconOn(store(), "report " + scan_.case_id);
    EXPECT_THAT(stored, HasSubstr((store() / "cases" / scan_.case_id / "report").string()));
}

TEST_F(Study, FliesTheWholeColon)
{
    const auto report = viconJson(store(), "fly " + scan_.case_id + " --frames 20 --width 200 --height 200 --out " +
                                               (folder_->path() / "flight").string());
    // Poses on a bridge over a collapsed part are skipped; there is nothing to see.
    const std::size_t frames = report["frames"].size();
    EXPECT_GE(frames, 15u);
    EXPECT_LE(frames, 20u);
    const auto pictures = std::count_if(fs::directory_iterator(folder_->path() / "flight"), fs::directory_iterator{},
                                        [](const auto& entry) { return entry.path().extension() == ".png"; });
    EXPECT_EQ(std::size_t(pictures), frames);
    EXPECT_GT(report["coverage"].get<double>(), 0.3);
}

TEST_F(Study, WritesJsonAsItsSchemasSay)
{
    const std::string id = addMeasuredMarker();
    EXPECT_EQ(schemaFaults("scan", {scan_.folder / "scan.json"}), "");
    EXPECT_EQ(schemaFaults("subdivision", {scan_.folder / "subdivision.json"}), "");
    EXPECT_EQ(schemaFaults("projections", {scan_.folder / "projections/projections.json"}), "");
    EXPECT_EQ(schemaFaults("markers", {scan_.folder / "markers.json", scan_.folder / "../markers.json"}), "");
    const fs::path cases = folder_->path() / "cases.json", show = folder_->path() / "show.json";
    std::ofstream(cases) << viconJson(store(), "cases");
    std::ofstream(show) << viconJson(store(), "show " + scan_.case_id);
    EXPECT_EQ(schemaFaults("cases", {cases}), "");
    EXPECT_EQ(schemaFaults("show", {show}), "");
    EXPECT_THAT(schemaFaults("cases", {show}), HasSubstr("'cases' is a required property")) << "the judge judges";
    viconOn(store(), "markers " + scan_.case_id + " --remove " + id);
    viconJson(store(), "import " + smallStudy().string());
    viconJson(store(), "work --until-idle");
    viconJson(store(), "doctor");
    viconJson(store(), "finding " + scan_.case_id);
    viconJson(store(), "assess " + scan_.case_id + " --preparation good");
    viconJson(store(), "priors " + scan_.case_id);
    viconJson(store(), "audit " + scan_.case_id);
    viconJson(store(), "outbox");
    viconJson(store(), "delete " + scan_.case_id);
    viconJson(store(), "anonymise " + scan_.case_id + " " + (folder_->path() / "anonymous").string());
    viconJson(store(), "report " + scan_.case_id + " --out " + (folder_->path() / "r.pdf").string());
    viconJson(store(), "export " + scan_.case_id + " --as json");
    viconJson(store(), "config");
    viconJson(store(), "match " + scan_.case_id);
    viconJson(store(), "markers " + scan_.case_id);
    EXPECT_EQ(schemaFaults("fly", {folder_->path() / "flight/flight.json"}), "");
    EXPECT_EQ(schemaFaults("truth", {smallStudy() / "truth-supine.json"}), "");
}

TEST_F(Study, NamesNoPatientInWhatWorkPrints)
{
    EXPECT_THAT(work_output_, testing::Not(HasSubstr("Phantom")));
}

}  // namespace
}  // namespace vicon::support
