#include <algorithm>

#include "dates.h"
#include "pattern.h"
#include "vicon/ingest/watch.h"

namespace vicon::ingest {
namespace {

bool isOneOf(const std::string& text, const std::vector<std::string>& patterns)
{
    return patterns.empty() ||
           std::any_of(patterns.begin(), patterns.end(), [&](const auto& pattern) { return isLike(text, pattern); });
}

}  // namespace

bool fits(const WatchOptions& rule, const FoundStudy& study, const std::vector<FoundSeries>& series)
{
    return std::any_of(series.begin(), series.end(), [&](const FoundSeries& one) {
        return (rule.modality.empty() || one.modality == rule.modality) && isOneOf(one.body_part, rule.body_parts) &&
               (isOneOf(study.description, rule.descriptions) || isOneOf(one.description, rule.descriptions)) &&
               (one.images < 0 || one.images >= rule.least_slices);
    });
}

std::string watchedSince(const WatchOptions& rule, const std::string& today, const std::string& newest)
{
    return dateOf(dayOf(newest.empty() ? today : std::min(today, newest)) - std::chrono::days(rule.days));
}

}  // namespace vicon::ingest
