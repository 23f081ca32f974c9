#include "station_chain.h"

#include <algorithm>
#include <cmath>

namespace vicon {
namespace {

constexpr int kBeyond_mm = 40;  // a centreline may begin before the other
constexpr double kChange = 1;   // sigma of the speed's change from step to step, in speeds
constexpr int kMostChange = 4;
// How alike the same place looks in two postures: correlation of the features. Found on whole scans of stretched
// phantoms, seeds 21 to 29 (0.6, 0.2, 0.5); with evidence, change and middle chosen on these and on pairs of profiles,
// seeds 1 to 100.
constexpr std::array<double, ProfileFeatures::kCount> kAlike{0.6, 0.1, 0.4};
constexpr double kEvidence = 0.33;                     // neighbouring samples are not independent
constexpr double kOtherwise = 0.1;                     // of the samples show something else
constexpr double kWildMark = 0.05;                     // of the landmarks are wrong
constexpr std::array<double, 2> kSamples{0.25, 0.75};  // of a step
// So much of the probability, as the chain counts it, holds the place in 80 of 100: what it sees is worth more than
// kEvidence makes of it, but the map is best so.
constexpr double kMiddle = 0.74;

/// How much likelier two standardised values are as the same place than as two places.
double likeness(double x, double y, double alike)
{
    const double rest = 1 - alike * alike;
    return -0.5 * std::log(rest) - (alike * alike * (x * x + y * y) - 2 * alike * x * y) / (2 * rest);
}

}  // namespace

StationChain::StationChain(const ColonProfile& from, const ColonProfile& to)
    : from_(from),
      to_(to),
      here_(featuresOf(from)),
      there_(featuresOf(to)),
      nodes_(std::max<std::size_t>(3, std::size_t(std::lround(from.length_mm / kStep_mm)) + 1))
{
    const std::vector<LandmarkPair> marks = sharedLandmarks(from, to);
    placeWindows(marks);
    holdMarks(marks);
    compare();
    forward();
    backward();
}

void StationChain::placeWindows(const std::vector<LandmarkPair>& marks)
{
    std::size_t part = 0;
    for (std::size_t node = 0; node < nodes_; ++node) {
        while (part + 2 < marks.size() && nodeAt(node) > marks[part + 1].from_mm)
            ++part;
        const LandmarkPair &a = marks[part], &b = marks[part + 1];
        const double middle =
            std::lerp(a.to_mm, b.to_mm, (nodeAt(node) - a.from_mm) / std::max(1.0, b.from_mm - a.from_mm));
        lowest_.push_back(int(std::lround(middle)) - kReach_mm);
    }
}

void StationChain::holdMarks(const std::vector<LandmarkPair>& marks)
{
    hold_.assign(nodes_ * columns(), 1);
    for (const LandmarkPair& mark : marks) {
        const auto node = std::size_t(std::lround(mark.from_mm / from_.length_mm * double(nodes_ - 1)));
        const double expected = mark.to_mm + nodeAt(node) - mark.from_mm;
        for (std::size_t n = 0; n < columns(); ++n) {
            const double off = (lowest_[node] + double(n) - expected) / mark.deviation_mm;
            hold_[node * columns() + n] *=
                float((1 - kWildMark) * std::exp(-0.5 * off * off) + kWildMark * mark.deviation_mm / kReach_mm);
        }
    }
    for (const std::size_t node : {std::size_t(0), nodes_ - 1})  // the ends lie near the ends
        for (std::size_t n = 0; n < columns(); ++n) {
            const double station = lowest_[node] + double(n);
            if (station < -kBeyond_mm || station > to_.length_mm + kBeyond_mm)
                hold_[node * columns() + n] = 0;
        }
}

float StationChain::likenessOf(long here, long there) const
{
    if (here < 0 || there < 0 || here >= long(here_.known.size()) || there >= long(there_.known.size()))
        return 1;
    const auto n = std::size_t(here), m = std::size_t(there);
    if (here_.known[n] <= 0 || there_.known[m] <= 0)
        return 1;
    double alike = 0;
    for (std::size_t f = 0; f < ProfileFeatures::kCount; ++f)
        if (!here_.value[f].empty() && !there_.value[f].empty())
            alike += likeness(double(here_.value[f][n]), double(there_.value[f][m]), kAlike[f]);
    return float(std::pow((1 - kOtherwise) * std::exp(alike) + kOtherwise, kEvidence));
}

void StationChain::compare()
{
    likeness_.resize(nodes_ * kSamples.size() * (columns() + kFastest));
    std::size_t at = 0;
    for (std::size_t node = 0; node < nodes_; ++node)
        for (const double sample : kSamples) {
            const long here = std::lround(nodeAt(node) + sample * (nodeAt(1) - nodeAt(0)));
            for (std::size_t n = 0; n < columns() + kFastest; ++n)
                likeness_[at++] = likenessOf(here, lowest_[node] + long(n));
        }
}

float StationChain::evidence(std::size_t node, int station, int speed) const
{
    float product = 1;
    for (std::size_t sample = 0; sample < kSamples.size(); ++sample) {
        const auto on = std::size_t(std::lround(kSamples[sample] * (speed + kSlowest)));
        product *= likeness_[(node * kSamples.size() + sample) * (columns() + kFastest) +
                             std::size_t(station - lowest_[node]) + on];
    }
    return product;
}

bool StationChain::freeAt(std::size_t node, int station) const
{
    const auto n = std::min(std::size_t(nodeAt(node)), here_.known.size() - 1);
    const auto m = std::size_t(std::clamp(station, 0, int(there_.known.size()) - 1));
    return here_.known[n] <= 0 || there_.known[m] <= 0;
}

void StationChain::forward()
{
    ahead_.assign(nodes_ * columns(), Speeds{});
    for (std::size_t n = 0; n < columns(); ++n)
        ahead_[n].fill(hold_[n]);
    for (std::size_t node = 0; node + 1 < nodes_; ++node) {
        float most = 0;
        for (std::size_t n = 0; n < columns(); ++n) {
            const int station = lowest_[node] + int(n);
            const Speeds& before = ahead_[node * columns() + n];
            if (*std::max_element(before.begin(), before.end()) <= 0)
                continue;
            const Speeds after = spread(before, freeAt(node, station));
            for (int speed = 0; speed < kSpeeds; ++speed) {
                const int next = station + speed + kSlowest;
                if (!has(node + 1, next))
                    continue;
                const std::size_t to = cell(node + 1, next);
                float& value = ahead_[to][std::size_t(speed)];
                value = after[std::size_t(speed)] * evidence(node, station, speed) * hold_[to];
                most = std::max(most, value);
            }
        }
        for (std::size_t n = 0; n < columns() && most > 0; ++n)
            for (float& value : ahead_[(node + 1) * columns() + n])
                value /= most;
    }
}

void StationChain::backward()
{
    behind_.assign(nodes_ * columns(), Speeds{});
    for (std::size_t n = 0; n < columns(); ++n)
        behind_[(nodes_ - 1) * columns() + n].fill(1);
    for (std::size_t node = nodes_ - 1; node-- > 0;) {
        float most = 0;
        for (std::size_t n = 0; n < columns(); ++n) {
            const int station = lowest_[node] + int(n);
            Speeds after{};
            for (int speed = 0; speed < kSpeeds; ++speed) {
                const int next = station + speed + kSlowest;
                if (has(node + 1, next))
                    after[std::size_t(speed)] = evidence(node, station, speed) * hold_[cell(node + 1, next)] *
                                                behind_[cell(node + 1, next)][std::size_t(speed)];
            }
            Speeds& before = behind_[node * columns() + n];
            before = spread(after, freeAt(node, station));  // the change is as likely either way
            most = std::max(most, *std::max_element(before.begin(), before.end()));
        }
        for (std::size_t n = 0; n < columns() && most > 0; ++n)
            for (float& value : behind_[node * columns() + n])
                value /= most;
    }
}

StationInterval StationChain::intervalAt(std::size_t node) const
{
    std::vector<double> passed{0};
    for (std::size_t n = 0; n < columns(); ++n) {
        const std::size_t at = node * columns() + n;
        double here = 0;
        for (std::size_t speed = 0; speed < kSpeeds; ++speed)
            here += double(ahead_[at][speed]) * double(behind_[at][speed]);
        passed.push_back(passed.back() + here);
    }
    const auto quantile = [&](double share) {
        const double wanted = share * passed.back();
        const auto above = std::upper_bound(passed.begin(), passed.end(), wanted);
        if (above == passed.end())
            return double(lowest_[node]) + double(columns());
        const auto n = std::size_t(above - passed.begin());
        const double part = (wanted - passed[n - 1]) / (passed[n] - passed[n - 1]);
        return std::clamp(lowest_[node] + double(n - 1) + part - 0.5, 0.0, to_.length_mm);
    };
    return {quantile(0.5), quantile(0.5 - kMiddle / 2), quantile(0.5 + kMiddle / 2)};
}

bool StationChain::passes() const
{
    for (std::size_t node = 0; node < nodes_; ++node) {
        double sum = 0;
        for (std::size_t n = node * columns(); n < (node + 1) * columns(); ++n)
            for (std::size_t speed = 0; speed < kSpeeds; ++speed)
                sum += double(ahead_[n][speed]) * double(behind_[n][speed]);
        if (!(sum > 0))
            return false;
    }
    return true;
}

/// From a speed to the next.
StationChain::Speeds StationChain::spread(const Speeds& before, bool free)
{
    static const std::array<float, kMostChange + 1> kernel = [] {
        std::array<float, kMostChange + 1> k{};
        double sum = 0;
        for (int n = 0; n <= kMostChange; ++n)
            sum += (n == 0 ? 1 : 2) * (k[std::size_t(n)] = float(std::exp(-0.5 * n * n / (kChange * kChange))));
        for (float& value : k)
            value /= float(sum);
        return k;
    }();
    Speeds after{};
    if (free) {  // over a collapsed part the centreline takes a short cut: anything may follow
        float sum = 0;
        for (const float value : before)
            sum += value;
        after.fill(sum / kSpeeds);
        return after;
    }
    for (int a = 0; a < kSpeeds; ++a)
        for (int b = std::max(0, a - kMostChange); b <= std::min(kSpeeds - 1, a + kMostChange); ++b)
            after[std::size_t(b)] += kernel[std::size_t(std::abs(a - b))] * before[std::size_t(a)];
    return after;
}

bool StationChain::seesWall() const
{
    return !here_.value[0].empty() && !there_.value[0].empty();
}

StationMap StationChain::map() const
{
    StationMap map{MapSource::wall, from_.length_mm, to_.length_mm, {}, {}};
    for (std::size_t node = 0; node < nodes_; ++node) {
        map.from_mm.push_back(nodeAt(node));
        map.to.push_back(intervalAt(node));
    }
    return map;
}

}  // namespace vicon
