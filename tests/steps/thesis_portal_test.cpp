// The thesis' criteria of a single portal: mandatory, that it cuts the path once; of quality, that it is effective.
#include "subdivide/thesis/portal.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "field_shapes.h"

namespace vicon::steps {
namespace {

constexpr int kMiddle = 30;  // of the path

/// A bar along z whose middle moves by `slope` voxels a slice along x, and its path, one voxel a slice.
class Bar {
public:
    Bar(int wide, int deep, double slope = 0) : slope_(slope), inside_(Grid{.size = {70, 30, 61}})
    {
        for (int k = 0; k < inside_.grid.size[2]; ++k) {
            for (int j = 0; j < deep; ++j)
                for (int i = 0; i < wide; ++i)
                    inside_.at({middle(k) - wide / 2 + i, 15 - deep / 2 + j, k}) = kGas;
            path_.voxels.push_back({inside_.grid.offset({middle(k), 15, k}), double(k)});
        }
    }

    /// The valid portals half-way along the path.
    std::vector<CutPlane> portals(PortalEffectiveness effectiveness, const SubdivideOptions& options = {}) const
    {
        SubdivideOptions chosen = options;
        chosen.method = SubdivideMethod::thesis;
        chosen.effectiveness = effectiveness;
        const Skeleton skeleton{{pieceThrough({{15, 15, 0}, {15 + 60 * slope_, 15, 60}}, 5)}};
        return CutPlanes(inside_, skeleton, path_, chosen).at(kMiddle);
    }

private:
    int middle(int k) const { return 15 + int(slope_ * k); }

    double slope_;
    InsideVolume inside_;
    Path path_;
};

const CutPlane& across(const std::vector<CutPlane>& planes, Vector3 normal)
{
    for (const CutPlane& plane : planes)
        if (plane.normal == normal)
            return plane;
    throw std::runtime_error("no such portal");
}

constexpr Vector3 kX{1, 0, 0}, kZ{0, 0, 1};

TEST(ThesisPortal, IsGoodWhereTheGatesRatioLiesWithinTheLimits)
{
    struct Case {
        int wide, deep;
        bool good;
    };
    for (const Case& c : {Case{10, 10, true}, {14, 10, true}, {16, 10, false}, {10, 14, true}, {10, 16, false}}) {
        const auto planes = Bar(c.wide, c.deep).portals(PortalEffectiveness::gate_ratio);
        ASSERT_EQ(planes.size(), 1U);
        EXPECT_DOUBLE_EQ(planes[0].ratio, double(c.wide) / c.deep);
        EXPECT_DOUBLE_EQ(planes[0].badness, std::abs(std::log(double(c.wide) / c.deep)));
        EXPECT_EQ(planes[0].good, c.good) << c.wide << " x " << c.deep;
    }
}

TEST(ThesisPortal, TakesTheLimitsOfTheRatioFromItsOptions)
{
    EXPECT_TRUE(Bar(16, 10).portals(PortalEffectiveness::gate_ratio, {.gate_ratio_high = 1.7})[0].good);
    EXPECT_TRUE(Bar(10, 16).portals(PortalEffectiveness::gate_ratio, {.gate_ratio_low = 0.6})[0].good);
    EXPECT_FALSE(Bar(14, 10).portals(PortalEffectiveness::gate_ratio, {.gate_ratio_high = 1.3})[0].good);
    EXPECT_FALSE(Bar(10, 14).portals(PortalEffectiveness::gate_ratio, {.gate_ratio_low = 0.8})[0].good);
}

TEST(ThesisPortal, IsGoodAcrossTheTangentsLargeComponents)
{
    const auto planes = Bar(11, 11, 0.5).portals(PortalEffectiveness::tangent);
    ASSERT_EQ(planes.size(), 2U);
    EXPECT_TRUE(across(planes, kZ).good);  // 6 slices for 3 columns: 27 degrees from the tangent
    EXPECT_NEAR(across(planes, kZ).badness, 1 - 2 / std::sqrt(5.0), 1e-9);
    EXPECT_FALSE(across(planes, kX).good);  // 63 degrees
    EXPECT_NEAR(across(planes, kX).badness, 1 - 1 / std::sqrt(5.0), 1e-9);
}

TEST(ThesisPortal, IsGoodWhereItIsTheSmallest)
{
    const auto planes = Bar(11, 11, 0.5).portals(PortalEffectiveness::portal_size);
    ASSERT_EQ(planes.size(), 2U);
    EXPECT_EQ(across(planes, kZ).voxels.size(), 121U);
    EXPECT_NEAR(across(planes, kX).voxels.size(), 242, 11);  // the bar runs twice as far along z as along x
    EXPECT_TRUE(across(planes, kZ).good);
    EXPECT_FALSE(across(planes, kX).good);
    EXPECT_NEAR(across(planes, kZ).badness, 1.21, 1e-6);  // of the square of the width, 10 mm
    EXPECT_GT(across(planes, kX).badness, across(planes, kZ).badness);
}

/// Up one limb and down the other, in one block or with a septum between.
std::vector<CutPlane> portalsOfHairpin(bool septum)
{
    InsideVolume inside(Grid{.size = {41, 11, 60}});
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        const Index3 v = inside.grid.indexOf(n);
        inside.voxels[n] = septum && v.i == 20 && v.k < 50 ? kOutside : kGas;
    }
    Path path;
    const auto add = [&](int i, int k) {
        path.voxels.push_back({inside.grid.offset({i, 5, k}), double(path.voxels.size())});
    };
    for (int k = 5; k < 55; ++k)
        add(10, k);
    for (int i = 11; i < 30; ++i)
        add(i, 55);
    for (int k = 54; k >= 5; --k)
        add(30, k);
    const Skeleton skeleton{{pieceThrough({{10, 5, 5}, {10, 5, 55}, {30, 5, 55}, {30, 5, 5}}, 5)}};
    return CutPlanes(inside, skeleton, path, {.method = SubdivideMethod::thesis}).at(20);
}

TEST(ThesisPortal, IsValidWhereItCutsThePathOnce)
{
    EXPECT_NO_THROW(across(portalsOfHairpin(true), kZ));
    EXPECT_ANY_THROW(across(portalsOfHairpin(false), kZ));  // it would cut both limbs
}

}  // namespace
}  // namespace vicon::steps
