#include "station_likeness.h"

#include <algorithm>
#include <cmath>

namespace vicon {
namespace {

// How alike the same place looks in two postures: correlation of the features. Found on whole scans of stretched
// phantoms, seeds 21 to 29 (0.6, 0.2, 0.5); chosen on these and on pairs of profiles, seeds 1 to 100.
constexpr std::array<double, ProfileFeatures::kCount> kAlike{0.6, 0.1, 0.4};
constexpr double kOtherwise = 0.1;  // of the samples show something else
// The same of the folds about the centreline, on whole scans of stretched phantoms, seeds 21 to 44.
constexpr double kFoldsAlike = 0.7, kFoldsOtherwise = 0.3;
// Neighbouring samples and sectors are not independent: what one says counts so much. Chosen on the same.
constexpr double kEvidence = 0.165, kFoldEvidence = 0.2;

/// How much likelier two standardised values are as the same place than as two places: the logarithm.
double likeness(double squares, double product, double alike)
{
    return -(alike * alike * squares - 2 * alike * product) / (2 * (1 - alike * alike));
}

/// What they say even of values that are neither large nor small.
double base(double alike)
{
    return -0.5 * std::log(1 - alike * alike);
}

float dotAt(const std::array<float, ProfileFeatures::kSectors>& a,
            const std::array<float, 2 * ProfileFeatures::kSectors>& b, std::size_t turn)
{
    float sum = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
        sum += a[n] * b[n + turn];
    return sum;
}

}  // namespace

StationLikeness::StationLikeness(const ProfileFeatures& here, const ProfileFeatures& there,
                                 const std::vector<double>& from_mm, double step_mm, const std::vector<int>& lowest_mm,
                                 std::size_t columns, const Progress* wanted)
    : here_(here),
      there_(there),
      turns_(here.folds.empty() || there.folds.empty() ? 1 : ProfileFeatures::kSectors),
      columns_(columns),
      factor_(from_mm.size() * turns_ * kSamples.size() * columns, 1)
{
    for (std::size_t node = 0; node < from_mm.size(); ++node) {
        if (wanted)
            wanted->check();
        for (std::size_t sample = 0; sample < kSamples.size(); ++sample)
            compare(node, sample, std::lround(from_mm[node] + kSamples[sample] * step_mm), lowest_mm[node]);
    }
}

void StationLikeness::compare(std::size_t node, std::size_t sample, long here, int lowest)
{
    if (here < 0 || here >= long(here_.known.size()) || here_.known[std::size_t(here)] <= 0)
        return;
    float* factor = &factor_[(node * turns_ * kSamples.size() + sample) * columns_];
    for (std::size_t column = 0; column < columns_; ++column) {
        const long there = lowest + long(column);
        if (there < 0 || there >= long(there_.known.size()) || there_.known[std::size_t(there)] <= 0)
            continue;
        const float plain = along(std::size_t(here), std::size_t(there));
        const Turns turned = turns_ > 1 ? about(std::size_t(here), std::size_t(there)) : Turns{1};
        for (std::size_t turn = 0; turn < turns_; ++turn)
            factor[turn * kSamples.size() * columns_ + column] = plain * turned[turn];
    }
}

float StationLikeness::along(std::size_t here, std::size_t there) const
{
    double alike = 0;
    for (std::size_t f = 0; f < ProfileFeatures::kCount; ++f)
        if (!here_.value[f].empty() && !there_.value[f].empty()) {
            const double x = here_.value[f][here], y = there_.value[f][there];
            alike += base(kAlike[f]) + likeness(x * x + y * y, x * y, kAlike[f]);
        }
    return float(std::pow((1 - kOtherwise) * std::exp(alike) + kOtherwise, kEvidence));
}

StationLikeness::Turns StationLikeness::about(std::size_t here, std::size_t there) const
{
    constexpr std::size_t kSectors = ProfileFeatures::kSectors;
    static const double all = base(kFoldsAlike) * double(kSectors);
    const auto &a = here_.folds[here], &b = there_.folds[there];
    std::array<float, 2 * kSectors> twice{};
    double squares = 0;
    for (std::size_t n = 0; n < kSectors; ++n) {
        twice[n] = twice[n + kSectors] = b[n];
        squares += double(a[n] * a[n] + b[n] * b[n]);
    }
    Turns out{};
    for (std::size_t turn = 0; turn < kSectors; ++turn) {
        const double alike = all + likeness(squares, double(dotAt(a, twice, turn)), kFoldsAlike);
        out[turn] = float(std::sqrt((1 - kFoldsOtherwise) * std::exp(kFoldEvidence * alike) + kFoldsOtherwise));
    }
    return out;
}

}  // namespace vicon
