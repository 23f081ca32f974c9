// Organs that are no colon, through the command.
#include <gmock/gmock.h>

#include "study.h"
#include "vicon/core/file.h"

namespace vicon::support {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A store with a phantom of that organ that has been worked on.
void prepare(const TemporaryFolder& folder, const std::string& organ, const std::string& size)
{
    const auto made =
        runVicon("phantom " + (folder / "study").string() + " --organ " + organ + " --seed 21 --size " + size);
    ASSERT_EQ(made.exit_code, 0) << made.output;
    EXPECT_EQ(schemaFaults("organ_truth", {folder / "study" / ("truth-" + organ + ".json")}), "");
    viconOn(folder / "store", "import " + (folder / "study").string());
    const std::string named = " --case " + listedScans(folder / "store").at(0).case_id;
    EXPECT_THAT(viconOn(folder / "store", "work --until-idle --organ " + organ + named),
                HasSubstr("1 done, 0 failed, 0 waiting"));
    EXPECT_EQ(schemaFaults("organ", {listedScans(folder / "store").at(0).folder / "organ.json"}), "");
}

TEST(OrganOfTheCommand, AnAirwayGoesThroughTheStepsAndIsFlownThrough)
{
    const TemporaryFolder folder;
    const auto store = folder / "store";
    prepare(folder, "airway", "128x128x128");
    const ListedScan scan = listedScans(store).at(0);
    for (const char* file : {"inside.mha", "skeleton.vtp", "skeleton_voxels.vtp", "segments.mha", "cells.vtp",
                             "exit_distance.mha", "wall_distance.mha", "projections/coronal.png"})
        EXPECT_TRUE(std::filesystem::exists(scan.folder / file)) << file;
    const std::string shown = viconOn(store, "show " + scan.case_id);
    EXPECT_THAT(shown, HasSubstr("organ: airway"));
    EXPECT_THAT(shown, HasSubstr("GENERATION"));
    EXPECT_THAT(shown, Not(HasSubstr("rectum")));
    EXPECT_THAT(viconOn(store, "cases"), Not(HasSubstr("unsure")));
    EXPECT_THAT(viconOn(store, "fly " + scan.case_id + " --frames 3 --width 200 --height 200"),
                HasSubstr("frames over"));
    EXPECT_THAT(viconOn(store, "fly " + scan.case_id + " --branch 1 --frames 2 --width 200 --height 200"),
                HasSubstr("frames over"));
    // However narrow the way is by its tip, the eye goes there: what is clicked in a picture lies where it says.
    viconOn(store,
            "fly " + scan.case_id + " --frames 5 --width 200 --height 200 --out " + (folder / "flight").string());
    const auto flight = nlohmann::json::parse(readFile(folder / "flight" / "flight.json"));
    ASSERT_EQ(flight["frames"].size(), 5U);
    for (const auto& frame : flight["frames"]) {
        const auto& eye = frame["eye_mm"];
        const auto marker = viconJson(
            store, "mark " + scan.case_id + " --at=" + eye[0].dump() + "," + eye[1].dump() + "," + eye[2].dump());
        EXPECT_NEAR(marker["station_mm"].get<double>(), frame["station_mm"].get<double>(), 3);
    }
    EXPECT_NEAR(flight["frames"].back()["station_mm"].get<double>(), flight["length_mm"].get<double>(), 1);
    for (const char* view : {"endo", "slices", "overview"}) {
        const auto picture = folder / (std::string(view) + ".png");
        viconOn(store, "snapshot " + scan.case_id + " --view " + view + " --station 60 --out " + picture.string());
        EXPECT_TRUE(std::filesystem::exists(picture)) << view;
    }
    const auto report = runVicon("report " + scan.case_id + " --store " + store.string());
    EXPECT_EQ(report.exit_code, 1);
    EXPECT_THAT(report.output, HasSubstr("a report tells of a colon; the scans of this case show the airway"));
    const auto wrong = runVicon("fly " + scan.case_id + " --branch 900 --store " + store.string());
    EXPECT_EQ(wrong.exit_code, 2) << wrong.output;
    // The scan stays what it was said to be; said to be another, it is worked on anew.
    EXPECT_THAT(viconOn(store, "work --until-idle"), HasSubstr("0 done, 0 failed, 0 waiting"));
    EXPECT_THAT(viconOn(store, "work --until-idle --organ aorta --case " + scan.case_id), HasSubstr("no aorta"));
    EXPECT_FALSE(std::filesystem::exists(scan.folder / "skeleton.vtp"));
}

TEST(OrganOfTheCommand, AnAortaIsMarkedOnTheBranchWhereTheMarkerLies)
{
    const TemporaryFolder folder;
    const auto store = folder / "store";
    prepare(folder, "aorta", "112x112x112");
    const ListedScan scan = listedScans(store).at(0);
    EXPECT_EQ(viconJson(store, "show " + scan.case_id)["scans"][0].value("organ", ""), "aorta");
    viconOn(store, "snapshot " + scan.case_id + " --view endo --station 200 --out " + (folder / "endo.png").string());
    EXPECT_EQ(runVicon("work --organ spleen --store " + store.string()).exit_code, 2);
    EXPECT_EQ(
        runVicon("work --until-idle --case " + scan.case_id + " --drop 0,0,0 --store " + store.string()).exit_code, 2);
}

TEST(OrganOfTheCommand, AStomachGoesThroughTheStepsWithoutAPathAndWhatNeedsOneSaysSo)
{
    const TemporaryFolder folder;
    const auto store = folder / "store";
    prepare(folder, "stomach", "112x112x104");
    const ListedScan scan = listedScans(store).at(0);
    for (const char* file : {"inside.mha", "skeleton.vtp", "segments.mha", "cells.vtp", "wall_distance.mha"})
        EXPECT_TRUE(std::filesystem::exists(scan.folder / file)) << file;
    for (const char* file : {"exit_distance.mha", "skeleton_voxels.vtp"})
        EXPECT_FALSE(std::filesystem::exists(scan.folder / file)) << file;
    EXPECT_EQ(schemaFaults("scan", {scan.folder / "scan.json"}), "");
    EXPECT_EQ(schemaFaults("subdivision", {scan.folder / "subdivision.json"}), "");
    const std::string shown = viconOn(store, "show " + scan.case_id);
    EXPECT_THAT(shown, HasSubstr("organ: stomach"));
    EXPECT_THAT(shown, Not(HasSubstr("GENERATION")));
    EXPECT_THAT(viconOn(store, "cases"), Not(HasSubstr("unsure")));
    for (const char* view : {"endo", "slices", "overview", "cube"})
        viconOn(store, "snapshot " + scan.case_id + " --view " + view + " --out " + (folder / "view.png").string());
    const auto marker = viconJson(store, "mark " + scan.case_id + " --at=45,-5,35");
    EXPECT_EQ(marker["station_mm"], 0);
    viconOn(store, "snapshot " + scan.case_id + " --view endo --marker " + marker["id"].get<std::string>() + " --out " +
                       (folder / "marker.png").string());
    for (const std::string& needs_path :
         {"fly " + scan.case_id + " --frames 3 --width 200 --height 200",
          "snapshot " + scan.case_id + " --view band --out " + (folder / "band.png").string()}) {
        const auto refused = runVicon(needs_path + " --store " + store.string());
        EXPECT_EQ(refused.exit_code, 2) << refused.output;
        EXPECT_THAT(refused.output, HasSubstr("centreline")) << needs_path;
        EXPECT_EQ(std::count(refused.output.begin(), refused.output.end(), '\n'), 1) << refused.output;
    }
    // Taken for an organ with a path, and for what it is again: what was made of the path is gone.
    viconOn(store, "work --until-idle --redo-outdated --set organ.root=far_from_feet --set 'organ.seed=[[45,-5,35]]'");
    EXPECT_TRUE(std::filesystem::exists(scan.folder / "exit_distance.mha"));
    viconOn(store, "work --until-idle --redo-outdated");
    for (const char* file : {"exit_distance.mha", "skeleton_voxels.vtp"})
        EXPECT_FALSE(std::filesystem::exists(scan.folder / file)) << file;
}

/// What waits may show anything: a colon called an airway would get no report.
TEST(OrganOfTheCommand, AnOrganIsSaidOfOneCaseOnly)
{
    const TemporaryFolder folder;
    const auto store = folder / "store";
    viconOn(store, "import " + smallStudy().string());
    const auto refused = runVicon("work --until-idle --organ airway --store " + store.string());
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.output, "vicon: --organ: an organ is said of one case; name the case with --case\n");
    EXPECT_FALSE(std::filesystem::exists(listedScans(store).at(0).folder / "organ.json"));
}

TEST(OrganOfTheCommand, ARealChestOfCoarseVoxelsEndsInAVerdict)
{
    VICON_NEEDS_DATA("dicom/ct64");
    const TemporaryFolder folder;
    const auto store = folder / "store";
    viconOn(store, "import " + sharedData("dicom/ct64").string());
    const std::string case_id = listedScans(store).at(0).case_id;
    viconOn(store, "work --until-idle --organ airway --case " + case_id);
    EXPECT_THAT(viconOn(store, "show " + case_id), HasSubstr("airway tree"));
}

}  // namespace
}  // namespace vicon::support
