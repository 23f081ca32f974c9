#include "vicon/viewer/model/peeling_pace.h"

namespace vicon::viewer {
namespace {

constexpr double kMost_s = 0.075;  // of a tenth of a second; the rest is for text, and for the window
constexpr double kNews = 0.4;      // weight of the last picture: some take twice as long as their neighbours

double raysOf(int width, int height, int coarse)
{
    const int across = (width + coarse - 1) / coarse, down = (height + coarse - 1) / coarse;
    return double(across) * down;
}

}  // namespace

int PeelingPace::coarseFor(int width, int height) const
{
    int coarse = 1;
    while (coarse < kCoarsest && raysOf(width, height, coarse) * ray_s_ > kMost_s)
        ++coarse;
    return coarse;
}

void PeelingPace::tell(int width, int height, int coarse, double seconds)
{
    ray_s_ += kNews * (seconds / raysOf(width, height, coarse) - ray_s_);
}

}  // namespace vicon::viewer
