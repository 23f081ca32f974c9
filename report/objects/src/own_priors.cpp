// A version that this store holds, as its structured report would be read back elsewhere.
#include <algorithm>

#include "object_writing.h"
#include "vicon/report/coded_findings.h"
#include "vicon/report/prior_reading.h"

namespace vicon::report {
namespace {

PriorSight sightFrom(const FindingSight& sight, const ReadCase& read)
{
    PriorSight out{.marker = sight.marker_id,
                   .position_mm = sight.position_mm,
                   .part = sight.part,
                   .site = sight.part ? codeOf(*sight.part).meaning : "",
                   .station_mm = sight.station_mm,
                   .from_caecum_mm = sight.from_caecum_mm,
                   .fraction = sight.fraction,
                   .part_fraction = sight.part_fraction,
                   .clock_hour = sight.clock_hour,
                   .size_2d_mm = sight.size_2d_mm,
                   .size_3d_mm = sight.size_3d_mm,
                   .size_least_mm = sight.size_least_mm,
                   .size_most_mm = sight.size_most_mm,
                   .height_mm = sight.height_mm,
                   .volume_ml = sight.volume_ml,
                   .volume_least_ml = sight.volume_least_ml,
                   .volume_most_ml = sight.volume_most_ml,
                   .mean_hu = sight.mean_hu};
    for (const ScanRecord& scan : read.scans)
        if (scan.id == sight.scan_id) {
            out.series_uid = scan.series.uid;
            out.frame_of_reference_uid = scan.series.frame_of_reference_uid;
        }
    if (out.frame_of_reference_uid.empty())
        out.position_mm.reset();
    return out;
}

PriorFinding findingFrom(const FindingWithFacts& one, const ReadCase& read)
{
    const auto& [finding, facts] = one;
    PriorFinding out{.uid = trackingUid(read, finding),
                     .name = trackingName(finding),
                     .what = codeOf(finding.kind).meaning,
                     .kind = finding.kind,
                     .morphology = finding.morphology,
                     .attenuation = finding.attenuation,
                     .confidence = finding.confidence,
                     .size_mm = facts.size_mm,
                     .size_from = facts.size_mm ? nameOf(facts.size_source) : "",
                     .height_mm = finding.height_mm,
                     .volume_ml = finding.volume_ml,
                     .endoscope = facts.endoscope,
                     .narrows_lumen = finding.narrows_lumen,
                     .invades = finding.invades,
                     .note = finding.note,
                     .leading = facts.leading.value_or(0)};
    for (const FindingSight& sight : facts.sights)
        out.sights.push_back(sightFrom(sight, read));
    return out;
}

}  // namespace

PriorReport priorFrom(const ReadCase& read, const ReportVersion& version)
{
    PriorReport report{.sop_uid = objectUid(version, ObjectKind::measurements),
                       .sop_class = UID_Comprehensive3DSRStorage,
                       .series_uid = seriesUid(version, ObjectKind::measurements),
                       .case_id = read.record.id,
                       .patient = read.record.patient,
                       .study = read.record.study,
                       .maker = "VICON",
                       .person = version.person,
                       .date = timeOf(version).date,
                       .is_signed = version.isSigned(),
                       .said = read.assessment};
    report.said.distension.clear();  // `parts` say it
    if (auto& chosen = report.said.colon_category)
        chosen->proposed.reset();
    if (auto& chosen = report.said.extracolonic_category)
        chosen->proposed.reset();
    for (const ScanRecord& scan : read.scans)
        report.scans.push_back({scan.series.uid, positionName(scan.series.patient_position), scan.series.kernel,
                                scan.series.slice_thickness_mm});
    for (const FindingWithFacts& one : read.findings)
        report.findings.push_back(findingFrom(one, read));
    for (const PartState& state : read.parts)
        for (const ScanRecord& scan : read.scans)
            if (scan.id == state.scan_id)
                report.parts.push_back({scan.series.uid, state.part, state.distension});
    return report;
}

}  // namespace vicon::report
