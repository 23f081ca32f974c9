#include "course.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace vicon::phantom {
namespace {

const DrawnCourse& courseOf(std::uint64_t seed, Position position)
{
    static std::map<std::pair<std::uint64_t, Position>, DrawnCourse> drawn;
    const auto key = std::pair(seed, position);
    if (!drawn.contains(key))
        drawn.emplace(key, drawCourse({.seed = seed, .position = position}));
    return drawn.at(key);
}

class CourseOfEverySeed : public ::testing::TestWithParam<int> {};

TEST_P(CourseOfEverySeed, HasAPlausibleLengthAndBendsNoSharperThanItIsWide)
{
    for (const Position position : {Position::supine, Position::prone, Position::left}) {
        const Course& course = courseOf(std::uint64_t(GetParam()), position).course;
        EXPECT_GT(course.length_mm(), 1400);
        EXPECT_LT(course.length_mm(), 2000);
        for (const CourseSample& s : course.samples) {
            EXPECT_LT(s.radius_mm * s.curvature, 0.9);
            EXPECT_GT(s.radius_mm, 8);
            EXPECT_LT(s.radius_mm, 36);
        }
    }
}

TEST_P(CourseOfEverySeed, KeepsItsLoopsAWallApart)
{
    constexpr double kTwoWalls = 3.2;
    const Course& course = courseOf(std::uint64_t(GetParam()), Position::prone).course;
    const auto& s = course.samples;
    for (std::size_t a = 0; a < s.size(); a += 3)
        for (std::size_t b = a + 1; b < s.size(); b += 3)
            if (course.step_mm * double(b - a) > loopDistance_mm(s[a].radius_mm, s[b].radius_mm)) {
                ASSERT_GT(distance(s[a].position_mm, s[b].position_mm), s[a].radius_mm + s[b].radius_mm + kTwoWalls)
                    << "stations " << a << " and " << b;
            }
}

TEST_P(CourseOfEverySeed, RunsFromTheRectumInTheMiddleUpTheLeftAndDownTheRight)
{
    const Course& course = courseOf(std::uint64_t(GetParam()), Position::supine).course;
    const auto& s = course.samples;
    const Point3 rectum = s.front().position_mm, caecum = s.back().position_mm;
    EXPECT_LT(std::abs(rectum.x), 15);
    EXPECT_GT(rectum.y, 20) << "at the back";
    EXPECT_LT(rectum.z, 70);
    EXPECT_LT(caecum.x, -40) << "on the right";
    EXPECT_LT(caecum.z, 190) << "low";
    const auto highest = [&](double side) {
        const CourseSample* top = nullptr;
        for (const CourseSample& sample : s)
            if (sample.position_mm.x * side > 60 && (top == nullptr || sample.position_mm.z > top->position_mm.z))
                top = &sample;
        return std::size_t(top - s.data());
    };
    const std::size_t splenic = highest(1), hepatic = highest(-1);
    EXPECT_LT(splenic, hepatic) << "first the left flexure";
    EXPECT_GT(s[splenic].position_mm.z, 290);
    double front = 0;
    for (std::size_t n = splenic; n < hepatic; ++n)
        front = std::min(front, s[n].position_mm.y);
    EXPECT_LT(front, -40) << "the transverse colon lies in front";
}

TEST_P(CourseOfEverySeed, IsSampledEvenlyWithAFrameThatDoesNotTwist)
{
    const Course& course = courseOf(std::uint64_t(GetParam()), Position::supine).course;
    const auto& s = course.samples;
    for (std::size_t n = 1; n < s.size(); ++n) {
        ASSERT_NEAR(distance(s[n].position_mm, s[n - 1].position_mm), course.step_mm, 0.01);
        ASSERT_NEAR(dot(s[n].normal, s[n].tangent), 0, 1e-9);
        ASSERT_NEAR(length(s[n].binormal), 1, 1e-9);
        const Vector3 turn = s[n].normal - s[n - 1].normal;
        ASSERT_NEAR(dot(turn, s[n].binormal), 0, 0.02) << "turns about the tangent";
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, CourseOfEverySeed, ::testing::Range(1, 5));

TEST(Course, MovesWithThePositionAndStaysThePatients)
{
    const DrawnCourse &supine = courseOf(3, Position::supine), &prone = courseOf(3, Position::prone);
    EXPECT_NEAR(supine.course.length_mm(), prone.course.length_mm(), 0.06 * supine.course.length_mm());
    double furthest = 0;
    for (int n = 0; n <= 100; ++n) {
        const auto at = [n](const Course& c) { return c.samples[c.sampleAt(n / 100.0 * c.length_mm())].position_mm; };
        furthest = std::max(furthest, distance(at(supine.course), at(prone.course)));
    }
    EXPECT_GT(furthest, 8);
    EXPECT_LT(furthest, 120);
    ASSERT_EQ(supine.relief.folds.size(), prone.relief.folds.size());
    for (std::size_t n = 0; n < supine.relief.folds.size(); ++n)
        EXPECT_EQ(supine.relief.folds[n].depth_mm, prone.relief.folds[n].depth_mm);
}

TEST(Relief, HasFoldsAndPolypsOfTheStatedSizes)
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Relief relief = drawRelief(seed, 1700, 2, 5);
        for (std::size_t n = 1; n < relief.ring_mm.size(); ++n) {
            EXPECT_GE(relief.ring_mm[n] - relief.ring_mm[n - 1], 20);
            EXPECT_LE(relief.ring_mm[n] - relief.ring_mm[n - 1], 35);
        }
        for (const Fold& fold : relief.folds) {
            EXPECT_GE(fold.depth_mm, 5);
            EXPECT_LE(fold.depth_mm, 12);
            EXPECT_GE(fold.thickness_mm, 2);
            EXPECT_LE(fold.thickness_mm, 4);
        }
        ASSERT_EQ(relief.polyps.size(), 5U);
        for (const PolypSite& polyp : relief.polyps) {
            EXPECT_GE(polyp.diameter_mm, 5);
            EXPECT_LE(polyp.diameter_mm, 10);
        }
    }
}

}  // namespace
}  // namespace vicon::phantom
