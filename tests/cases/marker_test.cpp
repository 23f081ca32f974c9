#include "vicon/cases/marker.h"

#include <gtest/gtest.h>

#include "marker_samples.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon {
namespace {

TEST(Marker, SurvivesJsonWithKeysOfOthers)
{
    Marker m{
        .id = "m1", .scan_id = "s1", .position_mm = {1.5, -2, 3}, .color = MarkerColor::green, .note = "Größe 5 мм"};
    m.extra["size_mm"] = 5.5;
    const Marker back = markerFromJson(toJson(m));
    EXPECT_EQ(back.position_mm, m.position_mm);
    EXPECT_EQ(back.color, MarkerColor::green);
    EXPECT_EQ(back.note, m.note);
    EXPECT_EQ(back.extra, m.extra);
}

TEST(Marker, FilesTooDeepToBeCopiedAreRefused)
{
    const support::TemporaryFolder folder;
    constexpr std::size_t kDeep = 1'000'000;
    std::string text = R"({"markers":[{"position_mm":[1,2,3],"color":"red","else":)";
    text.append(kDeep, '[').append(kDeep, ']').append("}]}");
    replaceFile(folder / "m.json", text);
    EXPECT_THROW(readMarkers(folder / "m.json"), Error);
}

TEST(Marker, KeepsAllThatWasMeasuredOfIt)
{
    const Marker m = test::markerWithEverything(), back = markerFromJson(toJson(m));
    EXPECT_EQ(toJson(back), toJson(m));
    EXPECT_EQ(back.part, ColonPart::splenic_flexure);
    EXPECT_EQ(back.partners, std::vector<std::string>{"m2"});
    ASSERT_TRUE(back.size && back.size->plane && back.density && back.view);
    EXPECT_EQ(back.size->along_mm, 8);
    EXPECT_EQ(back.size->plane->along, Vector3(1, 0, 0));
    EXPECT_EQ(back.density->counts, (std::vector<std::size_t>{1, 30}));
    EXPECT_EQ(back.view->station_mm, 412.5);
    EXPECT_TRUE(back.extra.empty());
}

TEST(Marker, IsPairedInSeveralScansAndFilesOfOnePartnerReadAsBefore)
{
    Marker m = test::markerWithEverything();
    EXPECT_EQ(toJson(m)["pair"], "m2") << "as other programs know it";
    m.partners = {"m2", "m5"};
    EXPECT_EQ(toJson(m)["pair"], nlohmann::json({"m2", "m5"}));
    EXPECT_EQ(markerFromJson(toJson(m)).partners, m.partners);
    EXPECT_EQ(partnerNames(m), "m2, m5");
    for (const auto& [written, read] : {std::pair<nlohmann::json, std::string>{"m7", "m7"}, {"", ""}}) {
        nlohmann::json json = toJson(m);
        json["pair"] = written;
        EXPECT_EQ(partnerNames(markerFromJson(json)), read);
    }
}

TEST(Marker, LeavesWhatOthersWroteUnderItsKeysAsItIs)
{
    for (const char* key : {"part", "pair", "size", "density", "view"}) {
        nlohmann::json json = toJson(test::markerWithEverything());
        json[key] = {{"whatever", {1, 2, 3}}};
        const Marker read = markerFromJson(json);
        EXPECT_EQ(read.extra.size(), 1u) << key;
        EXPECT_EQ(toJson(read), json) << key;
    }
    nlohmann::json json = toJson(test::markerWithEverything());
    json["part"] = "stomach";
    EXPECT_FALSE(markerFromJson(json).part);
    EXPECT_EQ(toJson(markerFromJson(json))["part"], "stomach");
}

TEST(Marker, LiesInAMassWhereverItStandsOnIt)
{
    const MarkerSize mass{.straight_mm = 30, .from_mm = {-15, 0, 0}, .to_mm = {15, 0, 0}};
    for (const Point3 on_it : {Point3{0, 0, 0}, Point3{0, 0, 15}, Point3{-15, 0, 0}, Point3{9, 0, 12}})
        EXPECT_NEAR(outsideOf_mm(mass, on_it), 0, 1e-9);
    EXPECT_NEAR(outsideOf_mm(mass, {25, 0, 0}), 10, 1e-9);
    EXPECT_NEAR(outsideOf_mm(mass, {0, 27, 0}), 12, 1e-9);
    const MarkerSize point{.from_mm = {1, 2, 3}, .to_mm = {1, 2, 3}};
    EXPECT_NEAR(outsideOf_mm(point, {1, 2, 5}), 2, 1e-9);
}

TEST(Marker, RefusesWhatIsNone)
{
    EXPECT_THROW(markerFromJson({{"color", "red"}}), Error);
    EXPECT_THROW(markerFromJson({{"color", "blue"}, {"position_mm", {1, 2, 3}}}), Error);
    EXPECT_THROW(markerFromJson({{"color", "red"}, {"position_mm", {1, 2}}}), Error);
    EXPECT_THROW(markerFromJson({{"color", "red"}, {"position_mm", {1, 2, 3, 4}}}), Error);
    EXPECT_THROW(markerFromJson({{"color", "red"}, {"position_mm", "1,2,3"}}), Error);
}

}  // namespace
}  // namespace vicon
