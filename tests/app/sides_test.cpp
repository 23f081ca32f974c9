#include <gmock/gmock.h>

#include <fstream>

#include "study.h"
#include "vicon/picture/png_file.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

bool isGreen(const std::uint8_t* c)
{
    return c[1] > 150 && c[0] < 110 && c[2] < 110;
}
bool isDark(const std::uint8_t* c)
{
    return c[0] < 60 && c[1] < 60 && c[2] < 60;
}

/// Mean column of the pixels that `is` holds for, as a part of the width; -1 when there are fewer than `least`.
double meanColumn(const picture::Picture& picture, bool (*is)(const std::uint8_t*), int least)
{
    double sum = 0;
    int count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            if (is(&picture.pixels[3 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))])) {
                sum += x;
                ++count;
            }
    return count < least ? -1 : sum / count / picture.width;
}

struct PositionCase {
    const char* arguments;
    const char* position;  ///< of the truth's file
    const char* dicom;
};

class Sides : public testing::TestWithParam<PositionCase> {};

/// The patient's left is +x in LPS and lies on the right side of a picture seen from the front.
TEST_P(Sides, AMarkerOnThePatientsLeftIsOnTheRightOfOverviewAndReport)
{
    const PositionCase c = GetParam();
    const TemporaryFolder folder;
    const fs::path study = folder / "study", store = folder / "store";
    const auto made =
        runVicon("phantom " + study.string() + " --size 128x128x108 --no-folds --gap 0 --seed 5 " + c.arguments);
    ASSERT_EQ(made.exit_code, 0) << made.output;
    viconOn(store, "import " + study.string());
    viconOn(store, "work --until-idle");
    const auto scans = listedScans(store);
    ASSERT_EQ(scans.size(), 1u);
    EXPECT_EQ(scans[0].position, c.position);
    const auto scan_json = nlohmann::json::parse(std::ifstream(scans[0].folder / "scan.json"));
    EXPECT_EQ(scan_json["series"]["patient_position"], c.dicom);

    const auto truth = nlohmann::json::parse(std::ifstream(study / ("truth-" + std::string(c.position) + ".json")));
    nlohmann::json leftmost = truth["curve_mm"][0];
    for (const auto& p : truth["curve_mm"])
        if (p[0].get<double>() > leftmost[0].get<double>())
            leftmost = p;
    std::string at;
    for (const auto& coordinate : leftmost)
        at += (at.empty() ? "" : ",") + std::to_string(coordinate.get<double>());
    viconOn(store, "mark " + scans[0].case_id + " --color green --at=" + at);

    viconOn(store, "snapshot " + scans[0].case_id + " --view overview --out " + (folder / "overview.png").string());
    const double in_overview = meanColumn(picture::readPng(folder / "overview.png"), isGreen, 10);
    EXPECT_GT(in_overview, 0.55);

    viconOn(store, "report " + scans[0].case_id + " --out " + (folder / "report.pdf").string());
    ASSERT_EQ(runCommand("pdftoppm -r 100 -png " + (folder / "report.pdf").string() + " " + (folder / "page").string())
                  .exit_code,
              0);
    // Of the pages, the first with a dark picture and green in it is the overview's; where in that picture is the
    // green?
    bool seen = false;
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        if (entry.path().extension() != ".png" || !entry.path().filename().string().starts_with("page"))
            continue;
        const picture::Picture page = picture::readPng(entry.path());
        const double green = meanColumn(page, isGreen, 5),
                     picture = meanColumn(page, isDark, page.width * page.height / 20);
        if (entry.path().filename().string().find("1.png") == std::string::npos || green < 0 || picture < 0)
            continue;
        seen = true;
        EXPECT_GT(green, picture) << "the marker lies right of the overview's middle";
    }
    EXPECT_TRUE(seen) << "no page shows the overview with its marker";
}

INSTANTIATE_TEST_SUITE_P(EveryPosition, Sides,
                         testing::Values(PositionCase{"--supine", "supine", "HFS"},
                                         PositionCase{"--prone", "prone", "HFP"},
                                         PositionCase{"--supine --feet-first", "supine", "FFS"},
                                         PositionCase{"--prone --feet-first", "prone", "FFP"}),
                         [](const auto& info) { return std::string(info.param.dicom); });

}  // namespace
}  // namespace vicon::support
