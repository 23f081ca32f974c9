#include "vicon/core/study.h"

#include <gtest/gtest.h>

#include "vicon/core/error.h"
#include "vicon/core/scan_records.h"
#include "vicon/core/subdivision.h"

namespace vicon {
namespace {

TEST(PatientPosition, NamesThePositionAndTheWayFluidFalls)
{
    struct Case {
        const char *code, *name;
        Vector3 gravity;
    };
    // DICOM PS3.3 C.7.3.1.1.2; +x is the patient's left, +y posterior.
    const Case cases[] = {
        {"HFS", "supine", {0, 1, 0}}, {"FFS", "supine", {0, 1, 0}},          {"HFP", "prone", {0, -1, 0}},
        {"FFP", "prone", {0, -1, 0}}, {"HFDL", "left decubitus", {1, 0, 0}}, {"FFDR", "right decubitus", {-1, 0, 0}},
        {"", "unknown", {0, 1, 0}},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(positionName(c.code), c.name);
        EXPECT_EQ(gravityFor(c.code), c.gravity) << c.code;
    }
}

TEST(ScanRole, HasAName)
{
    for (const ScanRole role : {ScanRole::scan, ScanRole::kept, ScanRole::refused})
        EXPECT_EQ(scanRoleFrom(nameOf(role)), role);
    EXPECT_THROW(scanRoleFrom("scout"), Error);
}

TEST(SubdivideMethod, HasAName)
{
    for (const auto& [method, name] : std::vector<std::pair<std::optional<SubdivideMethod>, std::string>>{
             {SubdivideMethod::flood, "flood"}, {SubdivideMethod::thesis, "thesis"}, {{}, "none"}}) {
        EXPECT_EQ(nameOf(method), name);
        EXPECT_EQ(subdivideMethodFrom(name), method);
    }
    EXPECT_THROW(subdivideMethodFrom(""), Error);
}

TEST(Series, IsReadFromJson)
{
    const Series series{.uid = "1.2.3", .number = 7, .description = "colon", .kvp = 120, .lossy = true};
    const nlohmann::json json = series;
    EXPECT_EQ(json.get<Series>().number, 7);
    EXPECT_EQ(json.get<Series>().description, "colon");
    EXPECT_EQ(nlohmann::json::object().get<Series>().number, Series{}.number) << "what is missing is as by default";
    for (const double bad : {2e23, -2e23, 3e9})
        EXPECT_THROW((void)nlohmann::json({{"number", bad}}).get<Series>(), nlohmann::json::exception) << bad;
}

}  // namespace
}  // namespace vicon
