#pragma once

#include "case_fixture.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/scan_quality.h"

namespace vicon::test {

/// A case whose colon was found, with two paired markers, m1 and m2, of a polyp of 7.3 mm, and m3 of something else.
class MarkedCase : public StoreOfOneScan {
public:
    MarkedCase()
    {
        record("segment", {{"verdict", "colon"}, {"confidence", 1}});
        release();
        mark("m2", 7.3);
        mark("m1", 0);
        mark("", 0);
    }

    Finding add(std::vector<std::string> markers, FindingKind kind = FindingKind::polyp)
    {
        return *editFindings(store, "c1", {{std::nullopt, Finding{.kind = kind, .markers = std::move(markers)}}})
                    .at(0)
                    .after;
    }
    /// Chooses what is proposed.
    void choose()
    {
        const ReadCase read = readCase(store, "c1");
        Assessment after = read.assessment;
        const auto proposed = read.colon_proposal.category;  // nothing where there are markers of no finding
        after.colon_category = {proposed.value_or(ColonCategory::c2a), proposed ? "" : "the other marker is a scar"};
        after.extracolonic_category = {read.extracolonic_proposal.category.value(), ""};
        saveAssessment(store, "c1", read.assessment, after);
    }

private:
    void mark(const std::string& pair, double size_mm)
    {
        Marker marker{.scan_id = "s1"};
        if (!pair.empty())
            marker.partners = {pair};
        marker.station_mm = 300;
        marker.from_caecum_mm = 1200;
        marker.fraction = 0.2;
        marker.part = ColonPart::sigmoid;
        if (size_mm > 0)
            marker.size = MarkerSize{.straight_mm = size_mm};
        store.saveMarker("c1", marker);
    }
};

}  // namespace vicon::test
