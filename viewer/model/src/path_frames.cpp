#include "vicon/viewer/model/path_frames.h"

#include <algorithm>

#include "vicon/core/error.h"
#include "vicon/core/nearest_on_segment.h"

namespace vicon::viewer {
namespace {

constexpr Vector3 kAnterior{0, -1, 0};

Vector3 reflected(Vector3 v, Vector3 mirror_normal)
{
    const double n2 = dot(mirror_normal, mirror_normal);
    return n2 > 0 ? v - mirror_normal * (2 * dot(v, mirror_normal) / n2) : v;
}

// Up at `b` from up at `a`: mirrored in the plane between the two points, then in the one that maps the mirrored
// tangent to that of `b`.
Vector3 carriedUp(const PathFrame& a, const PathFrame& b)
{
    const Vector3 step = b.position_mm - a.position_mm;
    const Vector3 up = reflected(a.up, step);
    const Vector3 forward = reflected(a.forward, step);
    return uprightOn(b.forward, reflected(up, b.forward - forward));
}

}  // namespace

PathFrames::PathFrames(const Skeleton& skeleton, double step_mm, double window_mm) : length_mm_(skeleton.length_mm())
{
    if (skeleton.empty() || length_mm_ <= 0)
        throw Error(ErrorCode::bad_input, "the centreline has no length", {}, "run 'vicon work' to make it anew");
    const int steps = std::max(1, int(std::ceil(length_mm_ / step_mm)));
    step_mm_ = length_mm_ / steps;
    for (int n = 0; n <= steps; ++n) {
        const double station = n * step_mm_;
        const SkeletonPoint p = skeleton.at(station);
        PathFrame frame{
            p.position_mm, skeleton.tangentAt(station, window_mm), {}, p.radius_mm, skeleton.onBridge(station)};
        if (length(frame.forward) == 0)
            frame.forward = frames_.empty() ? Vector3{0, 0, 1} : frames_.back().forward;
        frame.up = frames_.empty() ? uprightOn(frame.forward, kAnterior) : carriedUp(frames_.back(), frame);
        frames_.push_back(frame);
    }
}

PathFrames PathFrames::withoutPath(const PathFrame& home)
{
    PathFrames frames;
    frames.frames_ = {home, home};
    return frames;
}

PathFrame PathFrames::at(double station_mm) const
{
    const double place = std::clamp(station_mm, 0.0, length_mm_) / step_mm_;
    const std::size_t n = std::min(std::size_t(place), frames_.size() - 2);
    const PathFrame &a = frames_[n], &b = frames_[n + 1];
    const double t = std::clamp(place - double(n), 0.0, 1.0);
    PathFrame frame = t < 0.5 ? a : b;
    frame.position_mm = interpolate(a.position_mm, b.position_mm, t);
    frame.radius_mm = std::lerp(a.radius_mm, b.radius_mm, t);
    frame.forward = normalized(a.forward + (b.forward - a.forward) * t);
    frame.up = uprightOn(frame.forward, a.up + (b.up - a.up) * t);
    return frame;
}

double PathFrames::nearestStation(Point3 p, double around_mm, double reach_mm) const
{
    if (!isPath())
        return 0;
    const auto indexOf = [&](double station) { return std::size_t(std::clamp(station, 0.0, length_mm_) / step_mm_); };
    const std::size_t last = frames_.size() - 2;
    double best = std::clamp(around_mm, 0.0, length_mm_), best_distance = 1e300;
    for (std::size_t n = std::min(indexOf(around_mm - reach_mm), last);
         n <= std::min(indexOf(around_mm + reach_mm), last); ++n) {
        const Point3 a = frames_[n].position_mm, b = frames_[n + 1].position_mm;
        const double t = nearestOnSegment(a, b, p);
        if (const double d = distance(p, interpolate(a, b, t)); d < best_distance) {
            best_distance = d;
            best = (double(n) + t) * step_mm_;
        }
    }
    return best;
}

}  // namespace vicon::viewer
