#include <algorithm>

#include "peeling_panel.h"
#include "reading_window.h"

namespace vicon::viewer {
namespace {

constexpr const char* kColours = "biopsy";  // where the reader has chosen none
constexpr double kLeast_mm = 1, kMost_mm = 25;
constexpr double kLeast_px = 4;  // of a circle: the eye is too far from it to see anything there

}  // namespace

void ReadingWindow::connectBiopsy()
{
    connect(endoscopic_, &PictureView::circled, this, &ReadingWindow::circledAt);
    connect(&session_, &CaseSession::biopsied, this, &ReadingWindow::showBiopsy);
}

void ReadingWindow::startCircling()
{
    if (!navigator())
        return;
    begin(CircleFinding{},
          tr("Virtual biopsy: drag from the middle of the finding to its edge; or arrows and Return at both"));
}

void ReadingWindow::forgetCircle()
{
    if (!circle_)
        return;
    circle_.reset();
    peeling_->showHistogram({});
    drawEndoscopic(true);
}

void ReadingWindow::circledAt(Pixel centre, double radius_px)
{
    interaction_.finish();
    showTool();
    if (!navigator() || !shown_.isOf(session_.sharedScan()))
        return;
    const auto point = wallAt(*session_.scan(), shown_, centre);
    if (!point) {
        tell(tr("There is no wall in the middle of the circle."));
        return;
    }
    const double depth_mm = project(shown_.place.pose, shown_.lens, *point).depth_mm;
    const double radius_mm = std::clamp(radius_px * depth_mm / shown_.lens.focal_px(), kLeast_mm, kMost_mm);
    circle_ = Circle{*point, radius_mm};
    drawEndoscopic(true);
    tell(tr("Taking the biopsy ..."));
    // Half of a finding's height below its top, which is as far as half of its radius where it stands as half a ball.
    const Vector3 inwards = rayThrough(shown_.place.pose, shown_.lens, centre);
    session_.takeBiopsy(*point + inwards * (radius_mm / 2), radius_mm);
}

void ReadingWindow::showBiopsy(const DensitySample& biopsy)
{
    if (!circle_)
        return;
    if (biopsy.voxels == 0) {
        warn(tr("The tissue there is too thin to measure its density apart from gas and fluid; draw a larger circle."));
        return;
    }
    peeling_->showHistogram(biopsy);
    QString text = tr("%1 \u00b1 %2 HU within %3 mm")
                       .arg(biopsy.mean_hu, 0, 'f', 0)
                       .arg(biopsy.sd_hu, 0, 'f', 0)
                       .arg(biopsy.radius_mm, 0, 'f', 1);
    constexpr double kWorthSaying = 0.2;
    if (biopsy.fat_fraction >= kWorthSaying)
        text += tr(", %1 % as light as fat").arg(100 * biopsy.fat_fraction, 0, 'f', 0);
    const auto marker = markerBeside({circle_->centre_mm, biopsy.centre_mm});
    if (!marker) {
        tell(text + tr("; no marker beside it to keep it with"));
        return;
    }
    Marker after = *marker;
    after.density = biopsy;
    session_.changeMarker(*marker, after, false, tr("%1; kept with %2").arg(text, QString::fromStdString(marker->id)));
}

void ReadingWindow::fillCircle(SnapshotRequest& request, const Pose& pose) const
{
    if (!circle_)
        return;
    const Lens lens{request.view_angle_deg, request.width, request.height};
    const Projected at = project(pose, lens, circle_->centre_mm);
    const double radius_px = at.depth_mm > 0 ? circle_->radius_mm * lens.focal_px() / at.depth_mm : 0;
    const bool seen = radius_px >= kLeast_px && at.at.x > -radius_px && at.at.y > -radius_px &&
                      at.at.x < lens.width + radius_px && at.at.y < lens.height + radius_px;
    if (!seen) {
        if (!peeling_->on())
            request.peel.clear();
        return;
    }
    if (request.peel.empty())
        request.peel = kColours;
    request.peel_middle_only = true;
    request.peel_circle_at = at.at;
    request.peel_circle_px = radius_px;
}

}  // namespace vicon::viewer
