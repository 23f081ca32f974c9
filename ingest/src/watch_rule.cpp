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

bool isWatched(const WatchOptions& rule, const std::string& modality)
{
    const bool is_ct = modality == "CT", is_mr = modality == "MR";
    return (is_ct && rule.modality != WatchModality::mr) || (is_mr && rule.modality != WatchModality::ct);
}

template <class Which>
std::vector<std::string> uidsOf(const std::vector<FoundSeries>& series, Which which)
{
    std::vector<std::string> uids;
    for (const FoundSeries& one : series)
        if (which(one))
            uids.push_back(one.uid);
    return uids;
}

}  // namespace

std::string modalityAsked(const WatchOptions& rule)
{
    return rule.modality == WatchModality::any ? "" : nameIn(kWatchModalityNames, rule.modality);
}

std::vector<std::string> imageSeries(const WatchOptions& rule, const std::vector<FoundSeries>& series)
{
    return uidsOf(series, [&](const FoundSeries& one) { return isWatched(rule, one.modality); });
}

std::vector<std::string> reportSeries(const std::vector<FoundSeries>& series)
{
    return uidsOf(series, [](const FoundSeries& one) { return one.modality == "SR"; });
}

bool fits(const WatchOptions& rule, const FoundStudy& study, const std::vector<FoundSeries>& series)
{
    return std::any_of(series.begin(), series.end(), [&](const FoundSeries& one) {
        return isWatched(rule, one.modality) && isOneOf(one.body_part, rule.body_parts) &&
               (isOneOf(study.description, rule.descriptions) || isOneOf(one.description, rule.descriptions)) &&
               (one.images < 0 || one.images >= rule.least_slices);
    });
}

std::string watchedSince(const WatchOptions& rule, const std::string& today, const std::string& newest)
{
    return dateOf(dayOf(newest.empty() ? today : std::min(today, newest)) - std::chrono::days(rule.days));
}

}  // namespace vicon::ingest
