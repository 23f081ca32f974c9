// Two scans of one colon are matched, markers of one finding proposed, confirmed and taken back.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "study.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Supine and prone, the wall drawn out otherwise in each; once for all tests.
class TwoScans : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TemporaryFolder;
        const auto made =
            runVicon("phantom " + (*folder_ / "study").string() + " --stretch --size 160x160x134 --gap 0 --seed 3");
        ASSERT_EQ(made.exit_code, 0) << made.output;
        viconOn(store(), "import " + (*folder_ / "study").string());
        viconOn(store(), "work --until-idle");
        for (const ListedScan& scan : listedScans(store())) {
            scans_[scan.position] = scan;
            truths_[scan.position] = json::parse(readFile(*folder_ / "study" / ("truth-" + scan.position + ".json")));
        }
        ASSERT_EQ(scans_.size(), 2U);
        case_id_ = scans_.begin()->second.case_id;
    }
    static void TearDownTestSuite() { delete folder_; }
    static fs::path store() { return folder_->path() / "store"; }
    static json match(const std::string& more = "") { return viconJson(store(), "match " + case_id_ + more); }
    /// Marks a polyp of the truth; returns the marker's id.
    static std::string mark(const std::string& position, std::size_t polyp)
    {
        std::string at;
        for (const auto& coordinate : truths_[position]["polyps"][polyp]["position_mm"])
            at.append(at.empty() ? "" : ",").append(coordinate.dump());
        return viconJson(store(), "mark " + case_id_ + " --scan " + scans_[position].scan_id + " --at=" + at)["id"];
    }

    static TemporaryFolder* folder_;
    static std::map<std::string, ListedScan> scans_;
    static std::map<std::string, json> truths_;
    static std::string case_id_;
};
TemporaryFolder* TwoScans::folder_ = nullptr;
std::map<std::string, ListedScan> TwoScans::scans_;
std::map<std::string, json> TwoScans::truths_;
std::string TwoScans::case_id_;

TEST_F(TwoScans, AreMatchedBothWaysAsTheSchemaSays)
{
    const json there = match(" --scan " + scans_["supine"].scan_id);
    replaceFile(*folder_ / "match.json", there.dump());
    EXPECT_EQ(schemaFaults("match", {*folder_ / "match.json"}), "");
    ASSERT_EQ(there["maps"].size(), 1U);
    EXPECT_EQ(there["maps"][0]["from_scan"], scans_["supine"].scan_id);
    EXPECT_EQ(there["maps"][0]["by"], "folds and width");
    const json back = match(" --scan " + scans_["prone"].scan_id);
    EXPECT_EQ(back["maps"][0]["from_scan"], scans_["prone"].scan_id);
    EXPECT_EQ(back["maps"][0]["from_length_mm"], there["maps"][0]["to_length_mm"]);
    EXPECT_THAT(viconOn(store(), "match " + case_id_ + " --at 500"), HasSubstr("MOST (80 %)"));
}

TEST_F(TwoScans, MarkersOfOnePolypAreProposedAndPairedOnlyWhenConfirmed)
{
    const std::string first = mark("supine", 2), second = mark("prone", 2), pair = first + "=" + second;
    const json proposed = match()["proposed_pairs"];
    ASSERT_EQ(proposed.size(), 1U) << proposed.dump();
    const std::string one = proposed[0]["first"], other = proposed[0]["second"];
    EXPECT_EQ(std::set({one, other}), std::set({first, second}));
    EXPECT_EQ(proposed[0]["rank"], 1);
    const auto pairOf = [&](const std::string& id) -> std::string {
        const json listed = viconJson(store(), "markers " + case_id_);
        for (const json& marker : listed["markers"])
            if (marker["id"] == id)
                return marker.value("pair", "");
        return "no such marker";
    };
    EXPECT_EQ(pairOf(first), "") << "nothing is paired by itself";
    EXPECT_THAT(viconOn(store(), "markers " + case_id_), HasSubstr("may be one finding"));
    EXPECT_EQ(match(" --confirm " + pair)["proposed_pairs"], json::array());
    EXPECT_EQ(pairOf(first), second);
    EXPECT_EQ(pairOf(second), first);
    EXPECT_EQ(match(" --take-back " + pair)["proposed_pairs"].size(), 1U);
    EXPECT_EQ(pairOf(second), "");
}

TEST_F(TwoScans, WrongUseIsToldInOneLine)
{
    const auto of = [](const std::string& more) {
        return runVicon("match " + case_id_ + more + " --store " + store().string());
    };
    const std::string a = mark("supine", 0), b = mark("supine", 1);
    EXPECT_EQ(of(" --confirm m1").exit_code, 2);
    EXPECT_THAT(of(" --confirm m1").output, HasSubstr("write m1=m4"));
    EXPECT_EQ(of(" --confirm " + a + "=" + b).exit_code, 2);
    EXPECT_THAT(of(" --confirm " + a + "=" + b).output, HasSubstr("two scans"));
    EXPECT_EQ(of(" --take-back " + a + "=" + b).exit_code, 2);
    EXPECT_EQ(of(" --confirm " + a + "=m99").exit_code, 1);
    EXPECT_EQ(of(" --scan s000").exit_code, 1);
}

}  // namespace
}  // namespace vicon::support
