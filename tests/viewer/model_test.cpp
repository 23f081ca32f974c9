#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "vicon/core/error.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/coverage.h"
#include "vicon/viewer/model/orientation.h"
#include "vicon/viewer/model/path_frames.h"
#include "vicon/viewer/model/transfer_function.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {
namespace {

TEST(Orientation, LettersNameThePatientsSides)
{
    const struct {
        Vector3 direction;
        std::string letters;
    } cases[] = {{{1, 0, 0}, "L"},      {{-1, 0, 0}, "R"},         {{0, 1, 0}, "P"},     {{0, -1, 0}, "A"},
                 {{0, 0, 1}, "H"},      {{0, 0, -1}, "F"},         {{1, -0.9, 0}, "LA"}, {{-0.6, 0, 1}, "HR"},
                 {{0.4, 0.1, -1}, "F"}, {{0.02, -0.5, -0.9}, "FA"}};
    for (const auto& c : cases) {
        EXPECT_EQ(lettersFor(c.direction), c.letters);
        EXPECT_EQ(letterFor(c.direction), c.letters[0]);
    }
}

TEST(Orientation, SlicesAreSeenAsRadiologistsSeeThem)
{
    const struct {
        SlicePlane plane;
        char left, right, top, bottom, towards;
    } cases[] = {{SlicePlane::axial, 'R', 'L', 'A', 'P', 'H'},
                 {SlicePlane::coronal, 'R', 'L', 'H', 'F', 'P'},
                 {SlicePlane::sagittal, 'A', 'P', 'H', 'F', 'R'}};
    for (const auto& c : cases) {
        const SliceAxes axes = axesOf(c.plane);
        EXPECT_EQ(letterFor(-axes.right), c.left) << nameOf(c.plane);
        EXPECT_EQ(letterFor(axes.right), c.right) << nameOf(c.plane);
        EXPECT_EQ(letterFor(-axes.down), c.top) << nameOf(c.plane);
        EXPECT_EQ(letterFor(axes.down), c.bottom) << nameOf(c.plane);
        EXPECT_EQ(letterFor(cross(axes.right, axes.down)), c.towards) << nameOf(c.plane);
    }
}

TEST(Camera, LookingPosteriorHeadUpThePatientsLeftIsOnTheRight)
{
    const Pose pose = lookAt({0, -100, 0}, {0, 0, 0}, {0, 0, 1});
    const Lens lens{90, 400, 300};
    EXPECT_EQ(letterFor(pose.right()), 'L');
    const Projected left_of_patient = project(pose, lens, {20, 0, 0}), head = project(pose, lens, {0, 0, 20});
    EXPECT_GT(left_of_patient.at.x, 200);
    EXPECT_LT(head.at.y, 150);
}

TEST(Camera, RaysGoThroughThePixelsTheyWereMadeFor)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int n = 0; n < 200; ++n) {
        const Pose pose = lookAt({any(random), any(random), any(random)}, {5 * any(random), 5, 5 * any(random)},
                                 {any(random), any(random), any(random)});
        const Lens lens{60 + 30 * any(random), 640, 480};
        const Pixel pixel{320 + 300 * any(random), 240 + 200 * any(random)};
        const Projected back = project(pose, lens, pose.eye_mm + rayThrough(pose, lens, pixel) * 37);
        EXPECT_NEAR(back.at.x, pixel.x, 1e-6);
        EXPECT_NEAR(back.at.y, pixel.y, 1e-6);
        EXPECT_GT(back.depth_mm, 0);
    }
    EXPECT_LE(project(lookAt({}, {1, 0, 0}, {0, 0, 1}), {90, 10, 10}, {-3, 0, 0}).depth_mm, 0);
}

TEST(Camera, UprightIsAUnitVectorAcrossEvenWhereTheWantedUpIsAlong)
{
    for (const Vector3 forward : {Vector3{0, 0, 1}, Vector3{1, 0, 0}, normalized({1, 2, -3})})
        for (const Vector3 wanted : {forward, -forward, Vector3{0, -1, 0}, Vector3{}}) {
            const Vector3 up = uprightOn(forward, wanted);
            EXPECT_NEAR(length(up), 1, 1e-12);
            EXPECT_NEAR(dot(up, forward), 0, 1e-12);
        }
}

Skeleton helix()
{
    SkeletonPiece piece;
    double station = 0;
    for (int n = 0; n <= 600; ++n) {
        const double a = n * 0.02;
        const Point3 p{40 * std::cos(a), 40 * std::sin(a), 6 * a};
        if (n > 0)
            station += distance(p, piece.points.back().position_mm);
        piece.points.push_back({p, station, 10});
    }
    return {{piece}};
}

TEST(PathFrames, AreOrthonormalAndTurnNoMoreThanThePathDoes)
{
    const Skeleton skeleton = helix();
    const PathFrames frames(skeleton);
    // Between two frames the least rotation that takes one tangent to the other turns up by as much; a frame that spins
    // about the path turns by more.
    for (double s = 1; s < frames.length_mm(); s += 1) {
        const PathFrame a = frames.at(s - 1), b = frames.at(s);
        EXPECT_NEAR(length(b.forward), 1, 1e-9);
        EXPECT_NEAR(length(b.up), 1, 1e-9);
        EXPECT_NEAR(dot(b.forward, b.up), 0, 1e-9);
        const double bend = std::acos(std::min(1.0, dot(a.forward, b.forward)));
        const Vector3 axis = normalized(cross(a.forward, b.forward));
        const Vector3 carried = a.up * std::cos(bend) + cross(axis, a.up) * std::sin(bend) +
                                axis * (dot(axis, a.up) * (1 - std::cos(bend)));
        EXPECT_GT(dot(carried, b.up), std::cos(radians(0.05)));
    }
}

TEST(PathFrames, NearestStationIsFoundOnlyWithinReach)
{
    const Skeleton skeleton = helix();
    const PathFrames frames(skeleton);
    const Point3 beside = frames.at(200).position_mm + frames.at(200).up * 5;
    EXPECT_NEAR(frames.nearestStation(beside, 195, 20), 200, 0.5);
    EXPECT_LE(frames.nearestStation(beside, 100, 20), 121);
}

TEST(Marker, LabelsAreReadOnDarkenedTissue)
{
    const auto luminance = [](Rgb c) {  // WCAG 2
        const auto linear = [](double v) { return std::pow((v / 255 + 0.055) / 1.055, 2.4); };
        return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
    };
    constexpr Rgb kTissue{60, 60, 60};  // below a text
    for (const MarkerColor color : {MarkerColor::red, MarkerColor::yellow, MarkerColor::green})
        EXPECT_GE((luminance(labelColorOf(color)) + 0.05) / (luminance(kTissue) + 0.05), 4.5) << nameOf(color);
}

TEST(WindowLevel, SpreadsItsDensitiesFromBlackToWhite)
{
    const WindowLevel colon = windowPreset("colon");
    EXPECT_EQ(colon.width_hu, 1500);
    EXPECT_EQ(colon.level_hu, -200);
    EXPECT_EQ(colon.greyOf(-950), 0);
    EXPECT_EQ(colon.greyOf(550), 255);
    EXPECT_EQ(colon.greyOf(-200), 128);
    EXPECT_EQ(colon.greyOf(-3000), 0);
    EXPECT_EQ(colon.greyOf(3000), 255);
    const WindowLevel soft = windowPreset("soft-tissue");
    EXPECT_EQ(soft.width_hu, 400);
    EXPECT_EQ(soft.level_hu, 40);
    EXPECT_THROW(windowPreset("no such"), Error);
}

TEST(WindowLevel, EachOrganHasPresetsOfItsOwnAndItsDefaultFirst)
{
    const auto named = [](const std::string& organ) {
        std::vector<std::string> names;
        for (const WindowLevel& window : windowPresets(organ))
            names.push_back(window.name);
        return names;
    };
    using testing::Contains, testing::Not;
    EXPECT_EQ(named("colon").front(), "colon");
    EXPECT_EQ(named("airway").front(), "lung");
    EXPECT_EQ(named("aorta").front(), "vessel");
    EXPECT_EQ(named("another").front(), "soft-tissue");
    EXPECT_THAT(named("airway"), Not(Contains("colon")));
    EXPECT_THAT(named("colon"), Not(Contains("vessel")));
    for (const char* organ : {"colon", "airway", "aorta"})
        for (const char* common : {"soft-tissue", "bone", "lung"})
            EXPECT_THAT(named(organ), Contains(common)) << organ;
}

TEST(TransferFunction, PresetsRiseInDensityAndInterpolate)
{
    EXPECT_EQ(transferFunctions().size(), 5U);
    for (const TransferFunction& f : transferFunctions()) {
        ASSERT_GE(f.points.size(), 2U) << f.name;
        for (std::size_t n = 1; n < f.points.size(); ++n) {
            const TransferPoint &a = f.points[n - 1], &b = f.points[n];
            EXPECT_LT(a.density_hu, b.density_hu) << f.name;
            const TransferPoint middle = f.at((a.density_hu + b.density_hu) / 2);
            EXPECT_NEAR(middle.opacity_per_mm, (a.opacity_per_mm + b.opacity_per_mm) / 2, 1e-12) << f.name;
        }
        EXPECT_EQ(f.at(-5000).opacity_per_mm, f.points.front().opacity_per_mm);
        EXPECT_EQ(f.at(5000).red, f.points.back().red);
    }
    EXPECT_THROW(transferFunction("no such"), Error);
}

TEST(Annotation, StationsAreToldFromBothEnds)
{
    EXPECT_EQ(stationTexts(250, 1000, wordsFor(Organ()))[0], "250 mm from the rectum (25 %)");
    EXPECT_EQ(stationTexts(250, 1000, wordsFor(Organ()))[1], "750 mm from the caecum");
    EXPECT_EQ(stationTexts(250, 1000, wordsFor(Organ("aorta")))[0], "250 mm from the root (25 %)");
    EXPECT_EQ(stationTexts(250, 1000, wordsFor(Organ("aorta")))[1], "750 mm from the tip");
}

TEST(Annotation, LongTextIsCutBetweenWordsAndMarkedWhereItEnds)
{
    EXPECT_THAT(wrapped("flat lesion on a fold", 12, 5), testing::ElementsAre("flat lesion", "on a fold"));
    EXPECT_THAT(wrapped("äöü äöü äöü", 7, 5), testing::ElementsAre("äöü äöü", "äöü"));
    EXPECT_THAT(wrapped("one two three four", 8, 2), testing::ElementsAre("one two", "three…"));
}

TEST(Annotation, ScaleBarIsAsLongAsItSays)
{
    for (const double mm_per_pixel : {0.05, 0.2, 0.7, 1.3}) {
        Overlay overlay;
        addScaleBar(overlay, {0, 0, 500, 400}, mm_per_pixel, 12);
        ASSERT_EQ(overlay.lines.size(), 1U);
        const auto& p = overlay.lines[0].points;
        const double length_mm = (p[2].x - p[1].x) * mm_per_pixel;
        const std::string& text = overlay.texts[0].text;
        const double said_mm = std::stod(text) * (text.ends_with("cm") ? 10 : 1);
        EXPECT_NEAR(length_mm, said_mm, 1e-6) << text;
    }
}

TEST(Coverage, CountsEachTrianglesAreaOnce)
{
    // Two triangles of areas 0.5 and 2.
    const std::vector<float> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 5, 0, 2, 5, 0, 0, 5};
    const std::vector<std::uint32_t> triangles{0, 1, 2, 3, 4, 5};
    Coverage coverage(triangleAreas_mm2(points, triangles));
    EXPECT_NEAR(coverage.wholeArea_mm2(), 2.5, 1e-6);
    coverage.see({1, 1, 7});
    coverage.see({1});
    EXPECT_NEAR(coverage.fraction(), 0.8, 1e-6);
    EXPECT_EQ(coverage.seenCount(), 1U);
    EXPECT_FALSE(coverage.seen(0));
    coverage.forget();
    EXPECT_EQ(coverage.fraction(), 0);
}

}  // namespace
}  // namespace vicon::viewer
