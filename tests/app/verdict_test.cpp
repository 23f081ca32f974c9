// What the command says of scans that hold no colon, or a part of one, or that do not fit into memory.
#include <gmock/gmock.h>

#include "body_shapes.h"
#include "dicom_writer.h"
#include "study.h"
#include "vicon/phantom/phantom.h"

namespace vicon::support {
namespace {

using testing::HasSubstr;

vicon::test::SeriesSpec seriesOf(std::array<int, 3> size, double spacing_mm, vicon::test::Densities densities)
{
    vicon::test::SeriesSpec spec;
    spec.columns = size[0];
    spec.rows = size[1];
    spec.slices = size[2];
    spec.pixel_mm = spec.row_mm = spec.thickness_mm = spacing_mm;
    spec.step_mm = {0, 0, spacing_mm};
    spec.first_mm = {-(size[0] - 1) * spacing_mm / 2, -(size[1] - 1) * spacing_mm / 2, -(size[2] - 1) * spacing_mm / 2};
    spec.bits_stored = 16;
    spec.high_bit = 15;
    spec.is_signed = true;
    spec.intercept = 0;
    spec.densities = std::move(densities);
    return spec;
}

const std::array<int, 3> kBody{80, 56, 90};
constexpr double kBody_mm = 2;

/// Runs import and work on a series, and hands back what scan.json says of its segment step.
struct Worked {
    nlohmann::json segment, scan;
    std::string shown;
    std::filesystem::path folder;
};
Worked work(const std::filesystem::path& series, const std::filesystem::path& store)
{
    viconOn(store, "import " + series.string());
    Worked out;
    const std::string said = viconOn(store, "work --until-idle");
    EXPECT_THAT(said, HasSubstr("1 done, 0 failed, 0 waiting"));
    const auto scans = listedScans(store);
    EXPECT_EQ(scans.size(), 1U);
    if (scans.size() != 1)
        return out;
    out.folder = scans[0].folder;
    out.shown = viconOn(store, "show " + scans[0].case_id);
    out.scan = viconJson(store, "show " + scans[0].case_id)["scans"][0];
    out.segment = out.scan["steps"]["segment"]["result"];
    return out;
}

void expectVerdict(const Worked& worked, const std::string& verdict, const char* reason)
{
    EXPECT_EQ(worked.segment.value("verdict", ""), verdict) << worked.segment.dump(1);
    EXPECT_THAT(worked.segment.value("reason", ""), HasSubstr(reason));
    EXPECT_THAT(worked.shown, HasSubstr(verdict));
    EXPECT_THAT(worked.shown, HasSubstr(reason));
    if (verdict == "no colon") {
        EXPECT_FALSE(std::filesystem::exists(worked.folder / "inside.mha"));
        EXPECT_FALSE(std::filesystem::exists(worked.folder / "skeleton.vtp"));
    }
}

TEST(VerdictOfTheCommand, AScanWithoutAColonIsAFinishedJobWithAReason)
{
    struct Case {
        const char* name;
        vicon::test::Densities densities;
        const char* reason;
    };
    const std::vector<Case> cases = {
        {"air", [](Point3) { return -1000.0; }, "no body in the scan"},
        {"water", [](Point3) { return 0.0; }, "no gas in the body"},
        {"nothing measured", [](Point3) { return -2000.0; }, "no body in the scan"},
        {"noise",
         [](Point3 p) {
             return std::fmod(std::abs(std::sin(p.x * 12.9 + p.y * 78.2 + p.z * 37.7) * 43758.5), 1) * 100 - 1000;
         },
         "no body in the scan"},
        {"chest", steps::test::chestHu, "colon"},
        {"head", steps::test::headHu, "colon"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const TemporaryFolder folder;
        vicon::test::writeSeries(folder / "series", seriesOf(kBody, kBody_mm, c.densities));
        expectVerdict(work(folder / "series", folder / "store"), "no colon", c.reason);
        EXPECT_EQ(runVicon("report " + listedScans(folder / "store").at(0).case_id + " --store " +
                           (folder / "store").string())
                      .exit_code,
                  0);
    }
}

TEST(VerdictOfTheCommand, ARealChestHasNoColon)
{
    VICON_NEEDS_DATA("dicom/ct64");
    const TemporaryFolder folder;
    expectVerdict(work(sharedData("dicom/ct64"), folder / "store"), "no colon", "too little for a colon");
}

/// The phantom's slices between two fractions of its height.
std::filesystem::path croppedColon(const std::filesystem::path& folder, double from, double to)
{
    static const phantom::PhantomScan whole = [] {
        NoProgress quiet;
        phantom::PhantomOptions options;
        options.seed = 3;
        options.size = {128, 128, 108};
        options.folds = false;
        options.gaps = 0;
        return phantom::makeScan(options, "HFS", quiet);
    }();
    const Grid& grid = whole.hu.grid;
    auto spec = seriesOf(grid.size, 1, [&](Point3 p) { return double(whole.hu.at(grid.indexAt(p))); });
    const int first = int(from * grid.size[2]);
    spec.slices = int(to * grid.size[2]) - first;
    spec.pixel_mm = grid.spacing_mm[0];
    spec.row_mm = grid.spacing_mm[1];
    spec.thickness_mm = grid.spacing_mm[2];
    spec.step_mm = {0, 0, grid.spacing_mm[2]};
    spec.first_mm = grid.pointAt(Index3{0, 0, first});
    spec.padding = kPaddingHu;
    vicon::test::writeSeries(folder, spec);
    return folder;
}

TEST(VerdictOfTheCommand, AColonThatTheScanCutsIsNeverTakenForWhole)
{
    struct Case {
        const char* name;
        double from, to;
        const char* verdict;
    };
    const std::vector<Case> cases = {{"upper half missing", 0, 0.5, "unsure"},
                                     {"rectum missing", 0.25, 1, "unsure"},
                                     {"only the middle", 0.3, 0.7, "unsure"}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        const TemporaryFolder folder;
        const Worked worked = work(croppedColon(folder / "series", c.from, c.to), folder / "store");
        expectVerdict(worked, c.verdict, "beyond the end of the scan");
        EXPECT_LT(worked.segment.value("confidence", 1.0), 0.5);
        EXPECT_EQ(worked.scan.value("state", ""), "done");
    }
}

TEST(VerdictOfTheCommand, MemoryThatCannotBeHadFailsTheJobWithItsReasonAndARetrySucceeds)
{
    const TemporaryFolder folder;
    const auto store = folder / "store";
    vicon::test::writeSeries(folder / "series", seriesOf(kBody, kBody_mm, steps::test::headHu));
    viconOn(store, "import " + (folder / "series").string());
    const std::string once = "work --until-idle --set queue.most_attempts=1 --store " + store.string();
    const CommandResult little = runVicon(once + " --set work.memory_mb=20");
    EXPECT_EQ(little.exit_code, 1) << little.output;
    EXPECT_THAT(little.output, HasSubstr("work.memory_mb allows 20 MB"));
    EXPECT_THAT(viconOn(store, "cases"), HasSubstr("work.memory_mb allows 20 MB"));
    EXPECT_EQ(runVicon("work --until-idle --retry --store " + store.string()).exit_code, 0);
    EXPECT_EQ(listedScans(store).at(0).state, "done");
}

TEST(VerdictOfTheCommand, OfAColonThatIsNotFoundAnyMoreNothingIsTold)
{
    const TemporaryFolder folder;
    const auto store = folder / "store";
    ASSERT_EQ(runVicon("phantom " + (folder / "phantom").string() + " --supine --size 96x96x80 --seed 3").exit_code, 0);
    ASSERT_TRUE(work(folder / "phantom", store).scan["steps"].contains("quality"));
    const std::string case_id = listedScans(store).at(0).case_id;
    viconOn(store, "work --until-idle --redo-outdated --case " + case_id + " --set segment.gas_below_hu=-1000");
    const auto scan = viconJson(store, "show " + case_id)["scans"][0];
    EXPECT_EQ(scan["steps"]["segment"]["result"]["verdict"], "no colon");
    for (const std::string step : {"tissue", "skeleton", "quality", "subdivide", "potential"})
        EXPECT_FALSE(scan["steps"].contains(step)) << step;
}

#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes of addresses
TEST(VerdictOfTheCommand, ALimitOfTheProcessFailsTheJobWithItsReason)
{
    const TemporaryFolder folder;
    const auto store = folder / "store";
    vicon::test::writeSeries(folder / "series", seriesOf(kBody, kBody_mm, steps::test::headHu));
    viconOn(store, "import " + (folder / "series").string());
    // Enough for the program and its libraries, not for a scan.
    const CommandResult little =
        runCommand("(ulimit -v 280000; " + viconBinary() +
                   " work --until-idle --retry --set queue.most_attempts=1 --store " + store.string() + " 2>&1)");
    EXPECT_EQ(little.exit_code, 1) << little.output;
    EXPECT_THAT(little.output, HasSubstr("(ulimit -v) leaves"));
    EXPECT_THAT(viconOn(store, "cases"), HasSubstr("failed"));
}
#endif

}  // namespace
}  // namespace vicon::support
