#include "biopsy/biopsy_tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "peeling/peeling_panel.h"
#include "reading/reading.h"
#include "vicon/viewer/model/circled_wall.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr const char* kColours = "biopsy";  // where the reader has chosen none
constexpr double kLeast_mm = 1, kMost_mm = 25;
constexpr double kLeast_px = 4;  // of a circle: the eye is too far from it to see anything there

}  // namespace

void BiopsyTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::edit, tr("Virtual biopsy: circle a finding"), QKeySequence("T"), [this] { start(); });
    connect(reading_.views().endoscopic(), &PictureView::circled, this, &BiopsyTool::circled);
    for (SliceView* slice : reading_.views().slices())
        connect(slice, &PictureView::circled, this,
                [this, slice](Pixel centre, double radius_px) { circledSlice(slice->shown(), centre, radius_px); });
    connect(&reading_.session(), &CaseSession::biopsied, this, &BiopsyTool::show);
}

void BiopsyTool::start()
{
    if (!reading_.navigator())
        return;
    if (reading_.scan()->files.quantity() == Quantity::signal) {
        reading_.warn(tr("A biopsy measures densities, and MR has none."));
        return;
    }
    reading_.begin(CircleFinding{},
                   tr("Virtual biopsy, from inside or in a slice: drag from the middle of the finding to its edge; or "
                      "arrows and Return at both"));
}

void BiopsyTool::scanOpened(const Arrival&)
{
    giveUp();
}

void BiopsyTool::giveUp()
{
    circle_.reset();
    unkept_.reset();
    drawSampled({});
}

/// What is circled may be marked after it: its density is kept with that marker.
void BiopsyTool::nextClickChanged()
{
    if (!circle_ || reading_.interaction().inUse<PlaceMarker>())
        return;
    giveUp();
    panel_.showHistogram({});
    reading_.drawEndoscopic(true);
}

void BiopsyTool::circled(Pixel centre, double radius_px)
{
    reading_.interaction().finish();
    reading_.toolChanged();
    const ShownPicture& shown = reading_.shown();
    if (!reading_.navigator() || !shown.isOf(reading_.sharedScan()))
        return;
    const auto point = shown.wallAt(centre);
    if (!point) {
        reading_.say(tr("There is no wall in the middle of the circle."));
        return;
    }
    const double depth_mm = project(shown.place.pose, shown.lens, *point).depth_mm;
    const double radius_mm = std::clamp(radius_px * depth_mm / shown.lens.focal_px(), kLeast_mm, kMost_mm);
    circle_ = Circle{*point, radius_mm};
    reading_.drawEndoscopic(true);
    reading_.say(tr("Taking the biopsy ..."));
    // Half of a finding's height below its top, which is as far as half of its radius where it stands as half a ball.
    const Vector3 inwards = rayThrough(shown.place.pose, shown.lens, centre);
    const double raised_mm = std::min(raisedOver(*point, inwards, centre, radius_px), radius_mm);
    reading_.session().takeBiopsy(*point + inwards * (radius_mm / 2), radius_mm,
                                  CircledWall{*point, inwards, raised_mm});
}

/// A ball of tissue; where it reaches the wall, what lies behind that is left out as from inside.
void BiopsyTool::circledSlice(const PlaneView& view, Pixel centre, double radius_px)
{
    reading_.interaction().finish();
    reading_.toolChanged();
    if (!reading_.navigator())
        return;
    const Lumen& lumen = reading_.scan()->lumen;
    const Point3 middle = view.pointAt(centre);
    if (lumen.inside(middle)) {
        reading_.warn(tr("The middle of the circle lies in the lumen: nothing was taken. Circle tissue."));
        return;
    }
    const double radius_mm = std::clamp(radius_px * view.mm_per_pixel, kLeast_mm, kMost_mm);
    const auto wall = circledWall(lumen, middle, radius_mm);
    circle_ = Circle{middle, radius_mm, wall.has_value()};
    reading_.drawEndoscopic(true);
    reading_.say(tr("Taking the biopsy ..."));
    reading_.session().takeBiopsy(middle, radius_mm, wall);
}

void BiopsyTool::drawSampled(const std::optional<SampledBall>& ball)
{
    for (SliceView* slice : reading_.views().slices())
        slice->setSampled(ball);
}

/// How far the wall along the circle lies behind its middle, in the middle of all its places.
double BiopsyTool::raisedOver(Point3 middle, Vector3 inwards, Pixel centre, double radius_px) const
{
    constexpr int kPlaces = 24;
    const ShownPicture& shown = reading_.shown();
    std::vector<double> behind_mm;
    for (int n = 0; n < kPlaces; ++n) {
        const double angle = radians(360.0 * n / kPlaces);
        const Pixel at{centre.x + radius_px * std::cos(angle), centre.y + radius_px * std::sin(angle)};
        if (const auto wall = shown.wallAt(at))
            behind_mm.push_back(dot(*wall - middle, inwards));
    }
    if (behind_mm.empty())
        return 0;
    const auto half = behind_mm.begin() + std::ptrdiff_t(behind_mm.size() / 2);
    std::nth_element(behind_mm.begin(), half, behind_mm.end());
    return std::max(0.0, *half);
}

void BiopsyTool::show(const DensitySample& biopsy)
{
    if (!circle_)
        return;
    if (biopsy.voxels == 0) {
        reading_.warn(
            tr("Within the circle there is too little tissue between its surface and its far side to measure its "
               "density: nothing was taken."));
        return;
    }
    panel_.showHistogram(biopsy);
    drawSampled(SampledBall{biopsy.centre_mm, biopsy.radius_mm});
    QString text = tr("%1 \u00b1 %2 HU within %3 mm")
                       .arg(biopsy.mean_hu, 0, 'f', 0)
                       .arg(biopsy.sd_hu, 0, 'f', 0)
                       .arg(biopsy.radius_mm, 0, 'f', 1);
    constexpr double kWorthSaying = 0.2;
    if (biopsy.fat_fraction >= kWorthSaying)
        text += tr(", %1 % of fat attenuation").arg(100 * biopsy.fat_fraction, 0, 'f', 0);
    unkept_ = Unkept{biopsy, text};
    if (!keep() && !reading_.session().busy())
        reading_.say(text + tr("; no marker beside it to keep it with"));
}

/// With the marker beside the circle; one that is being saved may be it.
bool BiopsyTool::keep()
{
    if (reading_.session().busy())
        return false;
    const auto marker = reading_.markerNear(reading_.scan()->record.id, [&](Point3 place) {
        return std::min(distance(place, circle_->centre_mm), distance(place, unkept_->sample.centre_mm));
    });
    if (!marker)
        return false;
    const Unkept kept = *std::exchange(unkept_, {});
    Marker after = *marker;
    after.density = kept.sample;
    reading_.session().changeMarker(*marker, after, false,
                                    tr("%1; kept with %2").arg(kept.text, QString::fromStdString(marker->id)));
    return true;
}

void BiopsyTool::markersChanged()
{
    if (circle_ && unkept_)
        keep();
}

void BiopsyTool::complete(EndoscopicRequest& request) const
{
    if (!circle_ || !circle_->on_wall)
        return;
    SnapshotRequest& picture = request.snapshot;
    const Lens lens{picture.view_angle_deg, picture.width, picture.height};
    const Projected at = project(request.place.pose, lens, circle_->centre_mm);
    const double radius_px = at.depth_mm > 0 ? circle_->radius_mm * lens.focal_px() / at.depth_mm : 0;
    const bool seen = radius_px >= kLeast_px && at.at.x > -radius_px && at.at.y > -radius_px &&
                      at.at.x < lens.width + radius_px && at.at.y < lens.height + radius_px;
    if (!seen) {
        if (!panel_.on())
            picture.peel.preset.clear();
        return;
    }
    if (picture.peel.preset.empty())
        picture.peel.preset = kColours;
    picture.peel.middle_only = true;
    picture.peel.circle_at = at.at;
    picture.peel.circle_px = radius_px;
}

}  // namespace vicon::viewer
