// From where a marker is seen that was placed in a slice.
#include "measuring.h"

namespace vicon::viewer {
namespace {

using test::Outlining;

TEST_F(Outlining, AMarkerThatIsPlacedInASliceFarFromTheEyeIsShownFromBesideIt)
{
    // On the other side of the patient.
    const double station_mm = path_.nearest(Point3{-55, 4, 22}).station_mm;
    const Point3 middle_mm = path_.at(station_mm).position_mm;
    const auto& shown = the<SliceView>("coronal")->shown();
    scroll("coronal", int(std::lround(shown.depth_mm(middle_mm) / kVoxel_mm)));
    ASSERT_LT(std::abs(shown.depth_mm(middle_mm)), 2 * kVoxel_mm);
    const double eye_mm = station();
    ASSERT_GT(std::abs(eye_mm - station_mm), 100);
    click("coronal", placeIn("coronal", middle_mm + Vector3{-10, 0, 0}), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2 && settled(); }));
    waitUntilQuiet();
    const Marker marker = stored()[1];
    EXPECT_NEAR(marker.station_mm, station_mm, 10);
    EXPECT_NEAR(station(), eye_mm, 1) << "the eye stays";
    screenshot("marked_in_slice");
    clickRow(markers(), 1);
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
    waitUntilQuiet();
    screenshot("marked_in_slice_shown");
    EXPECT_NEAR(station(), marker.station_mm, 30) << "from where it is seen";
}

}  // namespace
}  // namespace vicon::viewer
