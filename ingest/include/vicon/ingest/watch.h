#pragma once

#include <string>
#include <vector>

#include "vicon/core/option_names.h"
#include "vicon/ingest/query.h"

namespace vicon::ingest {

enum class WatchModality { ct, mr, any };
inline constexpr EnumNames<WatchModality, 3> kWatchModalityNames{
    {{WatchModality::ct, "CT"}, {WatchModality::mr, "MR"}, {WatchModality::any, "any"}}};
constexpr const auto& optionNames(WatchModality /*value*/)
{
    return kWatchModalityNames;
}

/// Which studies of a peer are fetched unasked: those with one series that fits all of it.
struct WatchOptions {
    WatchModality modality = WatchModality::ct;
    std::vector<std::string> body_parts;
    std::vector<std::string> descriptions;
    int least_slices = 100;
    /// Studies reach an archive within a day or two of their date.
    int days = 3;
    double poll_s = 60;
    int priors = 0;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("watch.modality", modality, "", "Modality of the series; any: either.", choicesOf(modality));
        v("watch.body_parts", body_parts, "", "Body Part Examined of the series, one of these; none: any.");
        v("watch.descriptions", descriptions, "",
          "Description of the study or the series, one of these patterns with * and ?, in any case; none: any.");
        v("watch.least_slices", least_slices, "", "Images of the series, at least.", {0, 1000000});
        v("watch.days", days, "days", "A study is looked for until it is so old.", {0, 36500});
        v("watch.poll_s", poll_s, "s", "The peer is asked so often.", {1, 86400});
        v("watch.priors", priors, "",
          "So many earlier studies of the patient that fit are fetched as well, with their structured reports.",
          {0, 100});
    }
};

/// Whether a study has a series that fits. A peer that does not say how many images it has is not held to the number.
bool fits(const WatchOptions& rule, const FoundStudy& study, const std::vector<FoundSeries>& series);

/// What the peer is asked for: the rule's modality in DICOM's words; empty: any.
std::string modalityAsked(const WatchOptions& rule);

/// The series of the rule's modality.
std::vector<std::string> imageSeries(const WatchOptions& rule, const std::vector<FoundSeries>& series);
/// Its structured reports.
std::vector<std::string> reportSeries(const std::vector<FoundSeries>& series);

/// From which study date on the peer is asked: so many days before the newest study that it ever showed, or before
/// today where that is earlier, so that neither a pause nor a wrong clock leaves studies out.
/// @param today, newest YYYYMMDD; `newest` is empty before the first study
std::string watchedSince(const WatchOptions& rule, const std::string& today, const std::string& newest);

}  // namespace vicon::ingest
