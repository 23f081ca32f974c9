#include "slices/measured_line.h"

#include <QObject>
#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

constexpr double kNearSlice_mm = 5;  // as a marker's ring
constexpr double kRimNearSlice_mm = 1;
constexpr double kForeshortened_mm = 0.05;  // drawn shorter by this: more than a length of one decimal rounds off
constexpr double kAtEye_mm = 1e-3;          // no direction leads there

QPointF toQt(Pixel at)
{
    return {at.x, at.y};
}

/// The lines from each point of a rim to the next, where both are seen.
template <class ToPicture, class IsSeen>
void addRim(Calliper& calliper, const std::vector<Point3>& rim_mm, ToPicture toPicture, IsSeen isSeen)
{
    for (std::size_t n = 0; n < rim_mm.size(); ++n) {
        const Point3 from = rim_mm[n], to = rim_mm[(n + 1) % rim_mm.size()];
        if (isSeen(from) && isSeen(to))
            calliper.rim << QLineF(toQt(toPicture(from)), toQt(toPicture(to)));
    }
}

}  // namespace

std::optional<PictureCircle> inSlice(const SampledBall& ball, const PlaneView& view)
{
    const double depth_mm = view.depth_mm(ball.centre_mm),
                 squared = ball.radius_mm * ball.radius_mm - depth_mm * depth_mm;
    if (squared <= 0)
        return std::nullopt;
    return PictureCircle{view.toPixel(ball.centre_mm), std::sqrt(squared) / view.mm_per_pixel};
}

std::optional<Calliper> inSlice(const MeasuredLine& line, const PlaneView& view, const Grid& grid)
{
    if (line.way_mm.empty())
        return std::nullopt;
    const double half_voxel_mm = *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end()) / 2;
    const Point3 from = line.way_mm.front(), to = line.way_mm.back();
    const double depth_from = view.depth_mm(from), depth_to = view.depth_mm(to);
    const bool crosses = depth_from * depth_to < 0;
    if (!crosses && std::min(std::abs(depth_from), std::abs(depth_to)) > kNearSlice_mm)
        return std::nullopt;
    Calliper made;
    const auto ends = {std::pair(from, depth_from), std::pair(to, depth_to)};
    std::size_t n = 0;
    for (const auto& [end, depth] : ends) {
        if (std::abs(depth) <= half_voxel_mm)
            made.grips[n] = toQt(view.toPixel(end));
        else
            made.dashed = true;
        ++n;
    }
    if (line.way_mm.size() < 2) {
        made.grips[1].reset();
        return made;
    }
    made.lines << QLineF(toQt(view.toPixel(from)), toQt(view.toPixel(to)));
    addRim(
        made, line.rim_mm, [&](Point3 p) { return view.toPixel(p); },
        [&](Point3 p) { return std::abs(view.depth_mm(p)) <= kRimNearSlice_mm; });
    made.label_at =
        made.lines.front().x1() > made.lines.front().x2() ? made.lines.front().p1() : made.lines.front().p2();
    made.text = made.dashed ? QObject::tr("%1, not in this plane").arg(line.text) : line.text;
    return made;
}

std::optional<Calliper> inEndoscopy(const MeasuredLine& line, const Pose& pose, const Lens& lens)
{
    if (line.way_mm.empty())
        return std::nullopt;
    const auto at = [&](Point3 p) { return project(pose, lens, p); };
    const Projected from = at(line.way_mm.front()), to = at(line.way_mm.back());
    if (from.depth_mm <= 0 || to.depth_mm <= 0)
        return std::nullopt;
    Calliper made;
    made.grips[0] = toQt(from.at);
    if (line.way_mm.size() < 2)
        return made;
    made.grips[1] = toQt(to.at);
    for (std::size_t n = 1; n < line.way_mm.size(); ++n) {
        const Projected a = at(line.way_mm[n - 1]), b = at(line.way_mm[n]);
        if (a.depth_mm > 0 && b.depth_mm > 0)
            made.lines << QLineF(toQt(a.at), toQt(b.at));
    }
    addRim(
        made, line.rim_mm, [&](Point3 p) { return at(p).at; }, [&](Point3 p) { return at(p).depth_mm > 0; });
    made.label_at = from.at.x > to.at.x ? *made.grips[0] : *made.grips[1];
    made.text = line.text;
    return made;
}

std::optional<Calliper> inCube(const MeasuredLine& line, const Pose& pose, const CubeLayout& layout)
{
    const auto atEye = [&](Point3 p) { return distance(p, pose.eye_mm) < kAtEye_mm; };
    if (line.way_mm.empty() || std::any_of(line.way_mm.begin(), line.way_mm.end(), atEye))
        return std::nullopt;
    Calliper made;
    made.grips[0] = toQt(layout.toPixel(pose, line.way_mm.front()));
    if (line.way_mm.size() < 2)
        return made;
    made.grips[1] = toQt(layout.toPixel(pose, line.way_mm.back()));
    const auto draw = [&](QVector<QLineF>& lines, Point3 from, Point3 to) {
        for (const CubeFace face : kCubeFaces)
            if (const auto part = layout.partOn(face, pose, from, to))
                lines << QLineF(toQt(part->first), toQt(part->second));
    };
    for (std::size_t n = 1; n < line.way_mm.size(); ++n)
        draw(made.lines, line.way_mm[n - 1], line.way_mm[n]);
    for (std::size_t n = 0; n < line.rim_mm.size(); ++n)
        draw(made.rim, line.rim_mm[n], line.rim_mm[(n + 1) % line.rim_mm.size()]);
    made.label_at = made.grips[0]->x() > made.grips[1]->x() ? *made.grips[0] : *made.grips[1];
    made.text = line.text;
    return made;
}

std::optional<Calliper> inProjection(const MeasuredLine& line, const PlaneView& view,
                                     const std::function<bool(Point3)>& isHidden)
{
    if (line.way_mm.empty())
        return std::nullopt;
    const Point3 from = line.way_mm.front(), to = line.way_mm.back();
    const QPointF first = toQt(view.toPixel(from)), last = toQt(view.toPixel(to));
    Calliper made;
    if (!isHidden(from))
        made.grips[0] = first;
    if (line.way_mm.size() < 2)
        return made;
    if (!isHidden(to))
        made.grips[1] = last;
    made.lines << QLineF(first, last);
    addRim(
        made, line.rim_mm, [&](Point3 p) { return view.toPixel(p); }, [&](Point3 p) { return !isHidden(p); });
    const double drawn_mm = made.lines.front().length() * view.mm_per_pixel;
    made.dashed = drawn_mm < distance(from, to) - kForeshortened_mm;
    made.label_at = first.x() > last.x() ? first : last;
    made.text = made.dashed ? QObject::tr("%1, foreshortened").arg(line.text) : line.text;
    if (!made.grips[0] && !made.grips[1])
        made.text = QObject::tr("%1, behind other wall").arg(made.text);
    return made;
}

std::optional<Calliper> inBand(const MeasuredLine& line, const std::vector<BandPlace>& ends, const BandMap& band,
                               const BandPage& page)
{
    if (ends.empty())
        return std::nullopt;
    const int row = page.rowOf(ends.front().station_mm);
    const auto isShown = [&](const BandPlace& place) {
        return place.station_mm >= page.rowLeast_mm(row) && place.station_mm <= page.rowMost_mm(row) &&
               std::abs(place.around_rad) <= BandPage::kTurn_rad / 2 + BandPage::kBeyond_rad;
    };
    // The short way around; where that leaves the band at one edge, the same at the other.
    BandPlace from = ends.front(), to = ends.back();
    to.around_rad += BandPage::kTurn_rad * std::round((from.around_rad - to.around_rad) / BandPage::kTurn_rad);
    if (!isShown(to)) {
        const double turn = std::copysign(BandPage::kTurn_rad, -to.around_rad);
        from.around_rad += turn;
        to.around_rad += turn;
        if (!isShown(from) || !isShown(to)) {
            from.around_rad -= turn;
            to.around_rad -= turn;
        }
    }
    Calliper made;
    made.dashed = true;
    const QPointF first = toQt(page.toPixel(band, from, row)), last = toQt(page.toPixel(band, to, row));
    if (isShown(from))
        made.grips[0] = first;
    if (ends.size() > 1 && isShown(to))
        made.grips[1] = last;
    if (!made.grips[0] && !made.grips[1])
        return std::nullopt;
    if (ends.size() < 2)
        return made;
    made.lines << QLineF(first, last);
    made.label_at = first.x() > last.x() ? first : last;
    made.text = QObject::tr("%1; the band is stretched").arg(line.text);
    return made;
}

}  // namespace vicon::viewer
