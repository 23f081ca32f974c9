#include "measuring/line_from_inside.h"

namespace vicon::viewer {
namespace {

bool isHidden(const ShownPicture& shown, Point3 end)
{
    constexpr double kBehind_mm = 3;  // of the wall: an end in a slice need not lie on it
    const Point3 eye_mm = shown.place.pose.eye_mm;
    const double far_mm = distance(eye_mm, end);
    if (far_mm <= kBehind_mm)
        return false;
    const auto wall_mm = shown.distanceToWall_mm(normalized(end - eye_mm));
    return wall_mm && *wall_mm + kBehind_mm < far_mm;
}

bool isSeen(const std::optional<MeasuredLine>& line, const std::shared_ptr<OpenScan>& scan, const ShownPicture& shown)
{
    if (!line || line->way_mm.empty() || !shown.isOf(scan) || line->scan_id != scan->record.id)
        return false;
    return !isHidden(shown, line->way_mm.front()) || !isHidden(shown, line->way_mm.back());
}

}  // namespace

std::optional<Calliper> lineFromInside(const std::optional<MeasuredLine>& line, const std::shared_ptr<OpenScan>& scan,
                                       const ShownPicture& shown)
{
    return isSeen(line, scan, shown) ? inEndoscopy(*line, shown.place.pose, shown.lens) : std::nullopt;
}

std::optional<Calliper> lineOnCube(const std::optional<MeasuredLine>& line, const std::shared_ptr<OpenScan>& scan,
                                   const ShownPicture& shown)
{
    return isSeen(line, scan, shown) ? inCube(*line, shown.place.pose, {shown.lens.width, shown.lens.height})
                                     : std::nullopt;
}

}  // namespace vicon::viewer
