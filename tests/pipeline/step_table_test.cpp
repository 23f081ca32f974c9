#include "step_table.h"

#include <gmock/gmock.h>

#include <set>

#include "vicon/pipeline/corrections.h"
#include "vicon/pipeline/scan_work.h"
#include "vicon/steps/segment.h"

namespace vicon::pipeline {
namespace {

using testing::Contains;
using testing::ElementsAre;

Config declared()
{
    Config config;
    config.declare(stepOptionSpecs());
    return config;
}

std::vector<std::string> stepsThatTake(const Config& config, const std::string& key, const nlohmann::json& value)
{
    std::vector<std::string> names;
    for (const Step& step : stepTable())
        if (const auto parameters = step.parameters(config); parameters.contains(key) && parameters[key] == value)
            names.push_back(step.name);
    return names;
}

TEST(StepTable, TheWallsDensitiesAreOneOptionOfMaskSurfaceAndDistances)
{
    Config config = declared();
    config.set("segment.wall_hu=-600");
    config.set("segment.tissue_hu=50");
    for (const char* key : {"segment.wall_hu", "segment.tissue_hu"})
        EXPECT_THAT(stepsThatTake(config, key, config.at(key).value),
                    ElementsAre("segment", "tissue", "subdivide", "potential"));
}

TEST(StepTable, TheTissueDependsOnTheWallsDensitiesOnlyWhereItPlacesTheWall)
{
    Config config = declared();
    config.set("subdivide.wall=densities");
    config.set("segment.wall_hu=-600");
    EXPECT_THAT(stepsThatTake(config, "segment.wall_hu", config.at("segment.wall_hu").value),
                ElementsAre("segment", "subdivide", "potential"));
    EXPECT_THAT(stepsThatTake(config, "subdivide.wall", "densities"), ElementsAre("tissue", "subdivide", "potential"));
}

TEST(StepTable, NoOptionIsDeclaredTwice)
{
    std::set<std::string> keys;
    for (const OptionSpec& spec : stepOptionSpecs())
        EXPECT_TRUE(keys.insert(spec.key).second) << spec.key;
    EXPECT_THAT(keys, Contains("segment.wall_hu"));
}

TEST(Corrections, AreAddedToThePointsOfTheConfiguration)
{
    Config config = declared();
    config.set("segment.add=1,2,3");
    const Corrections corrections{.add = {{4.25, -5, 6}}, .cut = {}, .drop = {{7, 8, 9}}};
    const auto options = withCorrections(config, corrections).get<steps::SegmentOptions>();
    EXPECT_THAT(options.add, ElementsAre(Point3{1, 2, 3}, Point3{4.25, -5, 6}));
    EXPECT_TRUE(options.cut.empty());
    EXPECT_THAT(options.drop, ElementsAre(Point3{7, 8, 9}));
}

}  // namespace
}  // namespace vicon::pipeline
