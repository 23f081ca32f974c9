#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/prior_report.h"
#include "vicon/cases/report_content.h"
#include "vicon/core/options.h"

namespace vicon {

struct PriorOptions {
    /// Follow-up is matched by the fraction inside the part; no error across years was published, so that of supine to
    /// prone is assumed, and the reader confirms.
    double window_percent = 5;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("priors.window_percent", window_percent, "% of the colon",
          "A finding may be that of an earlier report where it lies within this on either side of its place.", {0, 50});
    }
};

/// A scan's colon as a scale of stations.
struct ScanColon {
    std::string scan_id, position;  ///< "supine", ...
    double length_mm = 0;
    ColonPartRanges parts;
};
/// Of the scans of a case whose colon was found.
std::vector<ScanColon> colonsOf(CaseStore& store, const std::string& case_id);

/// Where in a scan of today a finding of an earlier report should lie.
struct ExpectedPlace {
    double station_mm = 0, least_mm = 0, most_mm = 0;
    std::string by;  ///< in words: "fraction inside the sigmoid"
};
/// By the fraction inside its part; where the report does not say that, by the fraction of the whole colon; else
/// anywhere in the part. Nothing where none is known. Of several sights that of the scan's position, else the leading
/// one.
std::optional<ExpectedPlace> expectedIn(const PriorReport& report, const PriorFinding& finding, const ScanColon& scan,
                                        const PriorOptions& options);

/// A finding of today that may be one of an earlier report.
struct PriorCandidate {
    std::string finding_id;
    double off_mm = 0;  ///< from the expected place, towards the caecum; of the sight that is nearest to it
    std::string by;
};

/// What there is today of a finding of an earlier report.
struct PriorMatch {
    std::string report_uid, prior_uid;
    std::vector<PriorCandidate> candidates;  ///< within the window and of a kind with it, the nearest first
    bool alone = false;                      ///< one candidate, which is that of no other finding of the report
};
/// Of every finding of the report, in its order.
std::vector<PriorMatch> matchFindings(const PriorReport& report, const std::vector<FindingWithFacts>& findings,
                                      const std::vector<ScanColon>& colons, const PriorOptions& options);

}  // namespace vicon
