#include "station_chain.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vicon {
namespace {

constexpr int kBeyond_mm = 40;  // a centreline may begin before the other
constexpr double kChange = 1;   // sigma of the speed's change from step to step, in speeds
constexpr int kMostChange = 4;
constexpr double kTurn_deg = 6;       // sigma of the turn's change from step to step,
constexpr double kTurnOver_deg = 20;  // and over a collapsed part, where the frame is carried along a short cut
constexpr double kWildMark = 0.05;    // of the landmarks are wrong
constexpr float kNothing = 1e-30F;    // below it numbers become slow, and say nothing
// So much of the probability, as the chain counts it, holds the place in 80 of 100: what it sees is worth more than
// is made of it, but the map is best so. These were chosen on whole scans of stretched phantoms, seeds 21 to 44, and on
// pairs of profiles, seeds 1 to 100.
constexpr double kMiddle = 0.74;

/// Half of a Gaussian whose whole adds up to 1.
std::vector<float> halfKernel(double sigma, int reach)
{
    std::vector<float> kernel;
    double sum = 0;
    for (int n = 0; n <= reach; ++n) {
        kernel.push_back(float(std::exp(-0.5 * n * n / (sigma * sigma))));
        sum += (n == 0 ? 1 : 2) * double(kernel.back());
    }
    for (float& value : kernel)
        value /= float(sum);
    return kernel;
}

void addTo(float* to, const float* from, float weight, std::size_t count)
{
    for (std::size_t n = 0; n < count; ++n)
        to[n] += weight * from[n];
}

void normalise(std::vector<float>& values)
{
    const float most = *std::max_element(values.begin(), values.end());
    if (most > 0)
        for (float& value : values)
            value = value < kNothing * most ? 0 : value / most;
}

/// From each speed, a row of a layer, to the next. Over a collapsed part the centreline takes a short cut: anything may
/// follow.
/// @param free by column
std::vector<float> spread(const float* layer, const std::vector<float>& free, std::size_t speeds)
{
    static const std::vector<float> kernel = halfKernel(kChange, kMostChange);
    const std::size_t columns = free.size();
    std::vector<float> out(speeds * columns, 0), mean(columns, 0);
    for (std::size_t a = 0; a < speeds; ++a) {
        addTo(mean.data(), layer + a * columns, 1 / float(speeds), columns);
        for (std::size_t b = 0; b < speeds; ++b)
            if (const std::size_t change = a < b ? b - a : a - b; change < kernel.size())
                addTo(&out[b * columns], layer + a * columns, kernel[change], columns);
    }
    for (std::size_t speed = 0; speed < speeds; ++speed)
        for (std::size_t n = 0; n < columns; ++n)
            out[speed * columns + n] += free[n] * (mean[n] - out[speed * columns + n]);
    return out;
}

std::vector<double> nodesAlong(double length_mm)
{
    const auto count = std::max<std::size_t>(3, std::size_t(std::lround(length_mm / StationChain::kStep_mm)) + 1);
    std::vector<double> out;
    for (std::size_t node = 0; node < count; ++node)
        out.push_back(length_mm * double(node) / double(count - 1));
    return out;
}

/// The first station within reach of each, by the landmarks.
std::vector<int> windowsAlong(const std::vector<double>& nodes_mm, const std::vector<LandmarkPair>& marks)
{
    std::vector<int> lowest;
    std::size_t part = 0;
    for (const double at_mm : nodes_mm) {
        while (part + 2 < marks.size() && at_mm > marks[part + 1].from_mm)
            ++part;
        const LandmarkPair &a = marks[part], &b = marks[part + 1];
        const double middle = std::lerp(a.to_mm, b.to_mm, (at_mm - a.from_mm) / std::max(1.0, b.from_mm - a.from_mm));
        lowest.push_back(int(std::lround(middle)) - StationChain::kReach_mm);
    }
    return lowest;
}

}  // namespace

StationChain::StationChain(const ColonProfile& from, const ColonProfile& to, const Progress* wanted)
    : from_(from),
      to_(to),
      here_(featuresOf(from)),
      there_(featuresOf(to)),
      node_mm_(nodesAlong(from.length_mm)),
      lowest_(windowsAlong(node_mm_, sharedLandmarks(from, to))),
      likeness_(here_, there_, node_mm_, node_mm_[1], lowest_, kColumns + kFastest, wanted)
{
    holdMarks(sharedLandmarks(from, to));
    forward(wanted);
    backward(wanted);
}

void StationChain::holdMarks(const std::vector<LandmarkPair>& marks)
{
    const std::size_t last = node_mm_.size() - 1;
    hold_.assign(node_mm_.size() * kColumns, 1);
    for (const LandmarkPair& mark : marks) {
        const auto node = std::size_t(std::lround(mark.from_mm / from_.length_mm * double(last)));
        const double expected = mark.to_mm + node_mm_[node] - mark.from_mm;
        for (std::size_t n = 0; n < kColumns; ++n) {
            const double off = (lowest_[node] + double(n) - expected) / mark.deviation_mm;
            hold_[node * kColumns + n] *=
                float((1 - kWildMark) * std::exp(-0.5 * off * off) + kWildMark * mark.deviation_mm / kReach_mm);
        }
    }
    for (const std::size_t node : {std::size_t(0), last})  // the ends lie near the ends
        for (std::size_t n = 0; n < kColumns; ++n) {
            const double station = lowest_[node] + double(n);
            if (station < -kBeyond_mm || station > to_.length_mm + kBeyond_mm)
                hold_[node * kColumns + n] = 0;
        }
}

StationChain::Reach StationChain::reachOf(std::size_t node, std::size_t speed) const
{
    const long shift = long(speed) + kSlowest + lowest_[node] - lowest_[node + 1];
    const long from = std::max(0L, -shift), to = std::min(long(kColumns), long(kColumns) - shift);
    return {std::size_t(from), std::size_t(std::max(from, to)), shift};
}

std::array<float, StationChain::kColumns> StationChain::evidence(std::size_t node, std::size_t turn,
                                                                 std::size_t speed) const
{
    std::array<float, kColumns> out{};
    const Reach reach = reachOf(node, speed);
    std::copy(holdOf(node + 1) + long(reach.from) + reach.shift, holdOf(node + 1) + long(reach.to) + reach.shift,
              out.begin() + long(reach.from));
    for (std::size_t sample = 0; sample < StationLikeness::kSamples.size(); ++sample) {
        const long on = std::lround(StationLikeness::kSamples[sample] * double(speed + kSlowest));
        const float* factor = likeness_.of(node, turn, sample) + on;
        for (std::size_t n = 0; n < kColumns; ++n)
            out[n] *= factor[n];
    }
    return out;
}

bool StationChain::seenAt(std::size_t node) const
{
    return here_.known[std::min(std::size_t(node_mm_[node]), here_.known.size() - 1)] > 0;
}

std::vector<float> StationChain::freeAt(std::size_t node) const
{
    std::vector<float> free(kColumns, seenAt(node) ? 0.F : 1.F);
    for (std::size_t n = 0; n < kColumns; ++n)
        if (there_.known[std::size_t(std::clamp(lowest_[node] + int(n), 0, int(there_.known.size()) - 1))] <= 0)
            free[n] = 1;
    return free;
}

StationChain::Plane StationChain::turned(const Plane& plane, std::size_t node) const
{
    const auto turns = long(likeness_.turns());
    if (turns == 1)
        return plane;
    const double step_deg = 360 / double(turns), sigma = (seenAt(node) ? kTurn_deg : kTurnOver_deg) / step_deg;
    const std::vector<float> kernel = halfKernel(sigma, int(std::ceil(3 * sigma)));
    Plane out(plane.size(), 0);
    for (long turn = 0; turn < turns; ++turn)
        for (long off = 1 - long(kernel.size()); off < long(kernel.size()); ++off)
            addTo(&out[std::size_t(turn) * kLayer], &plane[std::size_t((turn + off + turns) % turns) * kLayer],
                  kernel[std::size_t(std::abs(off))], kLayer);
    return out;
}

void StationChain::forward(const Progress* wanted)
{
    ahead_.assign(node_mm_.size(), Plane(likeness_.turns() * kLayer, 0));
    for (std::size_t row = 0; row < likeness_.turns() * kSpeeds; ++row)
        std::copy_n(holdOf(0), kColumns, &ahead_[0][row * kColumns]);
    for (std::size_t node = 0; node + 1 < node_mm_.size(); ++node) {
        if (wanted)
            wanted->check();
        const Plane now = turned(ahead_[node], node);
        const std::vector<float> free = freeAt(node);
        Plane& next = ahead_[node + 1];
        for (std::size_t turn = 0; turn < likeness_.turns(); ++turn) {
            const std::vector<float> after = spread(&now[turn * kLayer], free, kSpeeds);
            for (std::size_t speed = 0; speed < kSpeeds; ++speed) {
                const Reach reach = reachOf(node, speed);
                const auto says = evidence(node, turn, speed);
                float* to = &next[turn * kLayer + speed * kColumns];
                for (std::size_t n = reach.from; n < reach.to; ++n)
                    to[long(n) + reach.shift] = after[speed * kColumns + n] * says[n];
            }
        }
        normalise(next);
    }
}

StationChain::Plane StationChain::before(std::size_t node, const Plane& behind) const
{
    const std::vector<float> free = freeAt(node);
    Plane out(behind.size(), 0);
    for (std::size_t turn = 0; turn < likeness_.turns(); ++turn) {
        std::vector<float> after(kLayer, 0);
        for (std::size_t speed = 0; speed < kSpeeds; ++speed) {
            const Reach reach = reachOf(node, speed);
            const auto says = evidence(node, turn, speed);
            const float* from = &behind[turn * kLayer + speed * kColumns];
            for (std::size_t n = reach.from; n < reach.to; ++n)
                after[speed * kColumns + n] = says[n] * from[long(n) + reach.shift];
        }
        const std::vector<float> layer = spread(after.data(), free, kSpeeds);  // the change is as likely either way
        std::copy(layer.begin(), layer.end(), &out[turn * kLayer]);
    }
    normalise(out);
    return turned(out, node);
}

void StationChain::backward(const Progress* wanted)
{
    passed_.resize(node_mm_.size());
    Plane behind(likeness_.turns() * kLayer, 1);
    for (std::size_t node = node_mm_.size(); node-- > 0;) {
        if (wanted)
            wanted->check();
        if (node + 1 < node_mm_.size())
            behind = before(node, behind);
        passed_[node] = intervalAt(node, behind);
        ahead_[node] = {};
    }
}

StationInterval StationChain::intervalAt(std::size_t node, const Plane& behind)
{
    std::vector<double> passed(kColumns + 1, 0);
    for (std::size_t at = 0; at < behind.size(); ++at)
        passed[at % kColumns + 1] += double(ahead_[node][at]) * double(behind[at]);
    for (std::size_t n = 0; n < kColumns; ++n)
        passed[n + 1] += passed[n];
    passes_ = passes_ && passed.back() > 0;
    const auto quantile = [&](double share) {
        const double wanted = share * passed.back();
        const auto above = std::upper_bound(passed.begin(), passed.end(), wanted);
        if (above == passed.end())
            return double(lowest_[node]) + double(kColumns);
        const auto n = std::size_t(above - passed.begin());
        const double part = (wanted - passed[n - 1]) / (passed[n] - passed[n - 1]);
        return std::clamp(lowest_[node] + double(n - 1) + part - 0.5, 0.0, to_.length_mm);
    };
    return {quantile(0.5), quantile(0.5 - kMiddle / 2), quantile(0.5 + kMiddle / 2)};
}

StationMap StationChain::map() const
{
    return {MapSource::wall, from_.length_mm, to_.length_mm, node_mm_, passed_};
}

}  // namespace vicon
