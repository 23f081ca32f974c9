#include "vicon/steps/projections.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon::steps {
namespace {

NoProgress quiet;

/// Adds a ball of triangles (longitude by latitude) to a surface.
void addBall(CellSurface& s, Point3 centre, double radius_mm)
{
    constexpr int kAround = 32, kUp = 16;
    const auto first = std::uint32_t(s.pointCount());
    for (int v = 0; v <= kUp; ++v)
        for (int u = 0; u < kAround; ++u) {
            const double lon = 2 * M_PI * u / kAround, lat = M_PI * v / kUp;
            const Vector3 out{std::sin(lat) * std::cos(lon), std::sin(lat) * std::sin(lon), std::cos(lat)};
            const Point3 p = centre + out * radius_mm;
            for (const double x : {p.x, p.y, p.z})
                s.points_mm.push_back(float(x));
            for (const double x : {-out.x, -out.y, -out.z})
                s.normals.push_back(float(x));
        }
    for (std::uint32_t v = 0; v < kUp; ++v)
        for (std::uint32_t u = 0; u < kAround; ++u) {
            const std::uint32_t a = first + v * kAround + u, b = first + v * kAround + (u + 1) % kAround;
            for (const std::uint32_t n : {a, b, a + kAround, b, b + kAround, a + kAround})
                s.triangles.push_back(n);
            s.segment.insert(s.segment.end(), 2, 1);
        }
}

bool covered(const Projection& picture, Point3 p)
{
    const int x = int(std::lround(picture.column(p))), y = int(std::lround(picture.row(p)));
    return x >= 0 && y >= 0 && x < picture.width && y < picture.height &&
           picture.rgba[4 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x)) + 3] > 127;
}

int brightness(const Projection& picture, Point3 p)
{
    const int x = int(std::lround(picture.column(p))), y = int(std::lround(picture.row(p)));
    return picture.rgba[4 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
}

constexpr Point3 kLeftHead{60, -20, 130};  // +x: left, -y: front, +z: head
constexpr Point3 kRightFeet{-40, 40, -90};

CellSurface twoBalls()
{
    CellSurface s;
    addBall(s, kLeftHead, 10);
    addBall(s, kRightFeet, 10);
    return s;
}

TEST(Projections, ShowThePatientsLeftOnTheRightHeadUpAndFrontUp)
{
    const auto [coronal, transverse, sagittal] = project(twoBalls(), {}, quiet);
    EXPECT_EQ(coronal.name, "coronal");
    EXPECT_GT(coronal.column(kLeftHead), coronal.column(kRightFeet));
    EXPECT_LT(coronal.row(kLeftHead), coronal.row(kRightFeet));
    EXPECT_EQ(transverse.name, "transverse");
    EXPECT_GT(transverse.column(kLeftHead), transverse.column(kRightFeet));
    EXPECT_LT(transverse.row(kLeftHead), transverse.row(kRightFeet));
    EXPECT_EQ(sagittal.name, "sagittal");
    EXPECT_LT(sagittal.column(kLeftHead), sagittal.column(kRightFeet));
    EXPECT_LT(sagittal.row(kLeftHead), sagittal.row(kRightFeet));
}

TEST(Projections, HaveTheSurfaceWhereTheMappingSays)
{
    for (const double pixel_mm : {0.6, 1.7})
        for (const Projection& picture : project(twoBalls(), {pixel_mm}, quiet)) {
            const Vector3 ahead = cross(picture.right, picture.down);
            for (const Point3 centre : {kLeftHead, kRightFeet})
                for (int n = 0; n < 16; ++n) {
                    const Vector3 across =
                        picture.right * std::cos(n * M_PI / 8) + picture.down * std::sin(n * M_PI / 8);
                    EXPECT_TRUE(covered(picture, centre + across * (9.5 - pixel_mm) + ahead * 500));
                    EXPECT_FALSE(covered(picture, centre + across * (10.5 + pixel_mm)));
                }
        }
}

TEST(Projections, ShowWhatIsNearer)
{
    // Behind one another in each view: the nearer ball is brighter, and it is the one in front, below, and left.
    struct Case {
        std::size_t view;
        Vector3 nearer;
    };
    for (const Case& c : {Case{0, {0, -1, 0}}, Case{1, {0, 0, -1}}, Case{2, {1, 0, 0}}}) {
        CellSurface far_only, both;
        const Point3 away = Point3{} - c.nearer * 60, near = Point3{} + c.nearer * 60;
        const Vector3 aside = c.view == 0 ? Vector3{0, 0, 40} : c.view == 1 ? Vector3{40, 0, 0} : Vector3{0, 40, 0};
        addBall(both, away, 20);
        addBall(both, near, 10);
        addBall(both, away + aside, 10);
        const auto picture = project(both, {}, quiet)[c.view];
        EXPECT_GT(brightness(picture, near), brightness(picture, away + aside) + 50);
    }
}

TEST(Projections, RefuseAnEmptySurface)
{
    EXPECT_THROW(project({}, {}, quiet), Error);
}

}  // namespace
}  // namespace vicon::steps
