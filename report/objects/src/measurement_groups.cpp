#include "measurement_groups.h"

#include <algorithm>

#include "vicon/core/uid.h"
#include "vicon/dicom/proper_values.h"

namespace vicon::report {
namespace {

void addSight(SrTree& tree, const ReadCase& read, const FindingSight& sight, const MarkerImages& images)
{
    const auto scan =
        std::find_if(read.scans.begin(), read.scans.end(), [&](const ScanRecord& s) { return s.id == sight.scan_id; });
    tree.text(kContains, privateCode("MARKER", "Marker"), sight.marker_id);
    if (scan != read.scans.end() && !scan->series.frame_of_reference_uid.empty())
        tree.point(dcm("111010", "Center"), sight.position_mm, scan->series.frame_of_reference_uid);
    if (const auto image = images.find(sight.marker_id); image != images.end()) {
        const Code source = dcm("121112", "Source of Measurement");
        tree.image(&source, image->second);
    }
    tree.facts(factsOfSight(sight));
}

/// What it was in an earlier report, as the reader confirmed.
void addComparison(SrTree& tree, const ComparedFinding& compared)
{
    const Comparison& said = compared.said;
    tree.container(kContains, comparisonConcept(), nullptr, [&] {
        if (isUid(said.report_class) && isUid(said.report_uid))
            tree.object(privateCode("PRIOR_REPORT", "Earlier report"), said.report_class, said.report_uid);
        tree.uid(kContains, privateCode("PRIOR_TRACKING", "Tracking Unique Identifier there"), said.prior_uid);
        tree.facts(factsOfComparison(compared));
    });
}

void addGroup(SrTree& tree, const ReadCase& read, const FindingWithFacts& one, const FindingSight* sight,
              const MarkerImages& images)
{
    const Finding& finding = one.finding;
    tree.container(kContains, dcm("125007", "Measurement Group"), "1501", [&] {
        tree.text(DSRTypes::RT_hasObsContext, dcm("112039", "Tracking Identifier"), trackingName(finding));
        tree.uid(DSRTypes::RT_hasObsContext, dcm("112040", "Tracking Unique Identifier"), trackingUid(read, finding));
        tree.code(kContains, dcm("121071", "Finding"), codeOf(finding.kind));
        const auto part = sight ? sight->part : std::nullopt;
        if (part)
            tree.code(DSRTypes::RT_hasConceptMod, findingSiteConcept(), codeOf(*part));
        if (sight)
            addSight(tree, read, *sight, images);
        if (sight && sight != one.facts.lead())
            return;
        tree.facts(factsOfWhole(one));
        for (const ComparedFinding& compared : confirmedComparisons(read, finding))
            addComparison(tree, compared);
    });
}

}  // namespace

void addFindings(SrTree& tree, const ReadCase& read, const MarkerImages& images)
{
    for (const FindingWithFacts& one : read.findings) {
        for (const FindingSight& sight : one.facts.sights)
            addGroup(tree, read, one, &sight, images);
        if (one.facts.sights.empty())
            addGroup(tree, read, one, nullptr, images);
    }
}

void addCentrelines(SrTree& tree, const std::vector<Centreline>& centrelines)
{
    for (const Centreline& line : centrelines)
        tree.container(kContains, dcm("125007", "Measurement Group"), "1501", [&] {
            tree.text(DSRTypes::RT_hasObsContext, dcm("112039", "Tracking Identifier"),
                      "Centerline of " + line.scan.id);
            tree.uid(DSRTypes::RT_hasObsContext, dcm("112040", "Tracking Unique Identifier"),
                     uidFor("vicon centreline\n" + line.scan.series.uid));
            tree.code(kContains, dcm("121071", "Finding"), sct("71854001", "Colon"));
            tree.line(dcm("130490", "Centerline"), line.points_mm, line.scan.series.frame_of_reference_uid);
            tree.number(dcm("121211", "Path length"), line.length_mm, ucum("mm", "millimeter"));
        });
}

}  // namespace vicon::report
