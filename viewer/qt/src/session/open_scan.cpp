#include "session/open_scan.h"

#include <QObject>
#include <QStringList>
#include <algorithm>

#include "session/saved_view.h"
#include "vicon/cases/printed.h"

namespace vicon::viewer {
namespace {

/// The saved one, unless the path was made anew meanwhile and runs elsewhere there.
double stationOf(const OpenScan& scan, const SavedView& view)
{
    if (!scan.files.hasPath())
        return 0;
    constexpr double kOtherPath_mm = 20;  // a colon's radius; a piece of it that was added or dropped is longer
    const SkeletonFoot nearest = scan.files.skeleton().nearest(view.pose.eye_mm);
    const double off_mm = distance(scan.files.frames().at(view.station_mm).position_mm, view.pose.eye_mm);
    return off_mm > nearest.distance_mm + kOtherPath_mm ? nearest.station_mm : view.station_mm;
}

/// Which scan of the case it is of; the banner says whose and when.
Caption unnamed(Caption caption)
{
    caption.named = false;
    caption.study_date.clear();
    return caption;
}

}  // namespace

QString OpenScan::inWords() const
{
    const Caption& c = saved_caption;
    QStringList parts{QString::fromStdString(printedPatientName(c.patient_name))};
    if (!c.patient_id.empty())
        parts << QObject::tr("ID %1").arg(QString::fromStdString(c.patient_id));
    if (!c.birth_date.empty())
        parts << QObject::tr("born %1").arg(QString::fromStdString(printedDate(c.birth_date)));
    parts << QString::fromStdString(c.position + " " + printedDate(c.study_date));
    return parts.join(" - ");
}

OpenScan::OpenScan(PreparedScan prepared, const ScanRecord& scan, const CaseRecord& a_case)
    : files(std::move(prepared)),
      record(scan),
      caption(unnamed(captionFor(a_case, scan))),
      saved_caption(captionFor(a_case, scan)),
      lumen(files.lumen()),
      navigator(files.frames(), lumen, files.hasPath() ? std::optional(files.exitDistance()) : std::nullopt),
      coverage(triangleAreas_mm2(files.cells().points_mm, files.cells().triangles))
{
}

double OpenScan::voxel_mm() const
{
    const auto& spacing = files.inside().grid.spacing_mm;
    return *std::min_element(spacing.begin(), spacing.end());
}

bool haveSamePlaces(const OpenScan& a, const OpenScan& b)
{
    return a.navigator.hasPath() && b.navigator.hasPath();
}

std::filesystem::file_time_type madeAt(const std::filesystem::path& folder)
{
    std::error_code none;
    return std::filesystem::last_write_time(folder / "inside.mha", none);  // every correction makes it anew
}

Point3 placeInSlices(const OpenScan& scan, const NavigationState& state)
{
    return state.carried ? scan.files.frames().at(state.station_mm).position_mm : state.pose.eye_mm;
}

ViewPose viewOfMarker(const OpenScan& scan, const Marker& marker)
{
    if (const auto saved = savedView(marker); saved && scan.lumen.inside(saved->pose.eye_mm))
        return {saved->pose, stationOf(scan, *saved), scan.lumen.clearance_mm(saved->pose.eye_mm), true};
    return poseForPoint(scan.files.skeleton(), scan.files.frames(), scan.lumen, marker.position_mm);
}

}  // namespace vicon::viewer
