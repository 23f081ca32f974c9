// The choice of portals alone, on sizes and portals given as tables.
#include "subdivide/thesis/walk.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <random>

#include "subdivide/thesis/choice.h"

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
        for (const CutPlane& plane : choosePortals(table(portals), sizesOf(30), quiet).planes)
            at.push_back(plane.at);
        return at;
    };
    EXPECT_THAT(chosen(), ElementsAre(9, 19));
    portals[9].badness = 2;
    EXPECT_THAT(chosen(), ElementsAre(8, 19));
}

/// The least cost of all selections of given portals, by trying every one.
double leastOfAll(const std::map<std::size_t, Given>& portals, int voxels)
{
    const PathSizes sizes = sizesOf(voxels);
    const auto costOf = [&](double size) { return std::pow(std::log(std::max(size, 1.0) / kTarget), 2); };
    std::vector<CutPlane> all;
    for (const auto& [at, given] : portals)
        all.push_back(table(portals)(at).front());
    double least = 1e300;
    for (unsigned chosen = 0; chosen < 1U << all.size(); ++chosen) {
        double cost = 0;
        std::vector<const CutPlane*> taken;
        std::size_t from = 0;
        bool valid = true;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (!(chosen >> n & 1U))
                continue;
            const double size = sizes.between(from, all[n].at);
            valid = valid && (taken.empty() || (size >= 0.25 * kTarget && size <= 4 * kTarget)) &&
                    std::none_of(taken.begin(), taken.end(), [&](const CutPlane* t) { return intersect(*t, all[n]); });
            cost += costOf(size) + all[n].badness + (all[n].good ? 0 : 1);
            from = all[n].at;
            taken.push_back(&all[n]);
        }
        if (valid)
            least = std::min(least, cost + costOf(sizes.up_to.back() - sizes.up_to[from]));
    }
    return least;
}

TEST(ThesisChoice, KeepsApartWhatMeetsBeyondItsNeighbour)
{
    // The lumen turns back: the third portal meets the first, not the second. Kept apart from its neighbour alone it is
    // chosen and dropped again, which leaves a segment of twice the size; a little worse one meets none.
    auto portals = everywhere(0, {});
    portals[10] = {.badness = 0, .good = true, .voxels = {1, 2}};
    portals[20] = {.badness = 0, .good = true, .voxels = {5}};
    portals[30] = {.badness = 0, .good = true, .voxels = {2, 3}};
    portals[31] = {.badness = 0.1, .good = true, .voxels = {9}};
    NoProgress quiet;
    const PortalChoice choice = choosePortals(table(portals), sizesOf(41), quiet);
    std::vector<std::size_t> at;
    for (const CutPlane& plane : choice.planes)
        at.push_back(plane.at);
    EXPECT_THAT(at, ElementsAre(10, 20, 31));
    EXPECT_NEAR(choice.cost, leastOfAll(portals, 41), 1e-9);
    EXPECT_EQ(choice.at_least, choice.cost) << "proved";
    EXPECT_GT(choice.neighbours_only, choice.cost + 0.2);
}

TEST(ThesisChoice, IsTheBestOfAllSelections)
{
    std::mt19937 random(5);
    const auto below = [&](unsigned n) { return unsigned(random() % n); };
    NoProgress quiet;
    int better = 0;
    for (int trial = 0; trial < 150; ++trial) {
        std::map<std::size_t, Given> portals;
        for (std::size_t at = 3; at < 58; at += 2 + below(5)) {
            Given given{.badness = below(100) / 200.0, .good = below(3) > 0, .voxels = {}};
            for (std::uint32_t voxel = 0; voxel < 12; ++voxel)
                if (below(5) == 0)
                    given.voxels.push_back(voxel);
            portals[at] = given;
        }
        const PortalChoice choice = choosePortals(table(portals), sizesOf(60), quiet);
        ASSERT_NEAR(choice.cost, leastOfAll(portals, 60), 1e-9) << trial;
        ASSERT_EQ(choice.at_least, choice.cost) << trial;
        for (std::size_t a = 0; a < choice.planes.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                ASSERT_FALSE(intersect(choice.planes[a], choice.planes[b])) << trial;
        better += choice.neighbours_only > choice.cost + 1e-9;
    }
    EXPECT_GT(better, 30) << "where keeping neighbours apart is enough, nothing is shown";
}

TEST(ThesisChoice, SaysHowFarFromTheOptimumItMayBeWhereItGivesUp)
{
    auto portals = everywhere(0, {});
    for (std::size_t n = 5; n < 96; ++n)  // every portal meets all but those of its own stretch
        portals[n] = {.badness = 0.001 * double(n % 7), .good = true, .voxels = {std::uint32_t(n / 10 % 2)}};
    NoProgress quiet;
    const PortalChoice hasty = choosePortals(table(portals), sizesOf(100), quiet, 1);
    const PortalChoice patient = choosePortals(table(portals), sizesOf(100), quiet);
    EXPECT_LT(hasty.at_least, hasty.cost);
    EXPECT_LE(hasty.at_least, patient.cost);
    EXPECT_LE(patient.cost, hasty.cost);
    EXPECT_EQ(hasty.cost, hasty.neighbours_only);
}

}  // namespace
}  // namespace vicon::steps
