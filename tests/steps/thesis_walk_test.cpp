// The choice of portals alone, on sizes and portals given as tables.
#include "subdivide/thesis/walk.h"

#include <gmock/gmock.h>

#include <map>

namespace vicon::steps {
namespace {

using testing::ElementsAre;

constexpr double kTarget = 10;  // voxels of the path: each counts one

PathSizes sizesOf(int voxels)
{
    PathSizes sizes{.up_to = {}, .target = kTarget};
    for (int n = 0; n < voxels; ++n)
        sizes.up_to.push_back(n + 1);
    return sizes;
}

struct Given {
    double badness = 1;
    bool good = false;
    std::vector<std::uint32_t> voxels;  // none: its own
};

/// One portal at each of these voxels of the path.
PlanesAt table(const std::map<std::size_t, Given>& portals)
{
    return [portals](std::size_t n) {
        std::vector<CutPlane> planes;
        if (const auto found = portals.find(n); found != portals.end()) {
            CutPlane plane;
            plane.at = n;
            plane.badness = found->second.badness;
            plane.good = found->second.good;
            plane.voxels = found->second.voxels.empty() ? std::vector{std::uint32_t(1000 + n)} : found->second.voxels;
            plane.low = {0, 0, 0};
            plane.high = {100, 100, 100};
            planes.push_back(plane);
        }
        return planes;
    };
}

std::map<std::size_t, Given> everywhere(int voxels, const Given& given)
{
    std::map<std::size_t, Given> portals;
    for (int n = 0; n < voxels; ++n)
        portals[std::size_t(n)] = given;
    return portals;
}

std::vector<std::size_t> walked(const std::map<std::size_t, Given>& portals, int voxels)
{
    NoProgress quiet;
    std::vector<std::size_t> at;
    for (const CutPlane& plane : walkLocally(table(portals), sizesOf(voxels), quiet))
        at.push_back(plane.at);
    return at;
}

TEST(ThesisWalk, TakesTheFirstGoodPortalThatEndsASegmentOfFeasibleSize)
{
    auto portals = everywhere(30, {.badness = 0.5});
    portals[5] = {.badness = 0, .good = true};     // 5 of 10: too small a segment
    portals[9] = {.badness = 0.4, .good = true};   // the first
    portals[11] = {.badness = 0.1, .good = true};  // better, but later
    EXPECT_THAT(walked(portals, 22), ElementsAre(9));
}

TEST(ThesisWalk, GoesBackToTheBestEarlierCandidateWhenTheSegmentGrowsTooLarge)
{
    auto portals = everywhere(40, {.badness = 0.9});
    portals[6].badness = 0.2;   // the best of those passed before 1.5 targets are exceeded
    portals[17].badness = 0.1;  // the next one after that
    EXPECT_THAT(walked(portals, 24), ElementsAre(6));
}

TEST(ThesisWalk, GoesOnFromTheEarlierCandidate)
{
    auto portals = everywhere(40, {.badness = 0.9});
    portals[6].badness = 0.2;
    portals[12].badness = 0.3;  // passed before the walk went back to 6: a candidate only if it goes on from there
    EXPECT_THAT(walked(portals, 28), ElementsAre(6, 12));
}

TEST(ThesisWalk, TakesTheNextPortalWhereNoneWasPassed)
{
    EXPECT_THAT(walked({{19, {.badness = 0.9}}, {21, {.badness = 0.1}}}, 40), ElementsAre(19));
}

TEST(ThesisWalk, LeavesTooLittleNeitherBeforeNorBehindAPortal)
{
    EXPECT_THAT(walked({{3, {.badness = 0, .good = true}}, {17, {.badness = 0, .good = true}}}, 20), ElementsAre());
    EXPECT_THAT(walked({{3, {.badness = 0, .good = true}}, {15, {.badness = 0, .good = true}}}, 20), ElementsAre(15));
}

TEST(ThesisWalk, TakesNoPortalThatMeetsOneAlreadyTaken)
{
    auto portals = everywhere(0, {});
    portals[9] = {.badness = 0, .good = true, .voxels = {7, 8}};
    portals[18] = {.badness = 0, .good = true, .voxels = {8, 9}};
    portals[19] = {.badness = 0.5, .good = true, .voxels = {10}};
    EXPECT_THAT(walked(portals, 30), ElementsAre(9, 19));
}

TEST(ThesisChoice, IsTheLeastSumOfBadnessAndUnevenness)
{
    // Even segments cost nothing: of two sets of equally bad portals the even one; a far worse portal is avoided.
    auto portals = everywhere(0, {});
    for (const std::size_t n : {8, 9, 13, 19, 23})
        portals[n] = {.badness = 0.1, .good = true};
    NoProgress quiet;
    const auto chosen = [&] {
        std::vector<std::size_t> at;
        for (const CutPlane& plane : choosePortals(table(portals), sizesOf(30), quiet))
            at.push_back(plane.at);
        return at;
    };
    EXPECT_THAT(chosen(), ElementsAre(9, 19));
    portals[9].badness = 2;
    EXPECT_THAT(chosen(), ElementsAre(8, 19));
}

}  // namespace
}  // namespace vicon::steps
