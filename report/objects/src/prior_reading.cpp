#include "vicon/report/prior_reading.h"

#include <algorithm>

#include "code_reading.h"
#include "group_reading.h"
#include "vicon/core/uid.h"
#include "vicon/report/codes.h"

namespace vicon::report {
namespace {

/// Of the first item below that has this name, wherever it lies.
const ContentItem* findBelow(const ContentItem& item, const char* concept_value)
{
    for (const ContentItem& child : item.children) {
        if (child.name.value == concept_value)
            return &child;
        if (const ContentItem* found = findBelow(child, concept_value))
            return found;
    }
    return nullptr;
}

template <class Visit>
void visitContainers(const ContentItem& item, const char* concept_value, Visit visit)
{
    for (const ContentItem& child : item.children)
        if (child.type == "CONTAINER" && child.name.value == concept_value)
            visit(child);
        else
            visitContainers(child, concept_value, visit);
}

std::string childText(const ContentItem& item, const char* concept_value)
{
    for (const ContentItem& child : item.children)
        if (child.name.value == concept_value)
            return child.text;
    return {};
}

bool saysNothing(const PriorFinding& finding, const PriorSight& sight)
{
    return finding.what.empty() && !finding.size_mm && !finding.volume_ml && finding.others.empty() &&
           !sight.position_mm && sight.site.empty();
}

/// Centrelines are measured in groups of their own; they are no findings.
bool isCentreline(const ContentItem& group)
{
    return findBelow(group, "130490") != nullptr;
}

void addGroup(const ContentItem& group, const ContentDocument& document, PriorReport& report)
{
    if (isCentreline(group))
        return;
    const std::string uid = childText(group, "112040");
    const auto known = std::find_if(report.findings.begin(), report.findings.end(),
                                    [&](const PriorFinding& f) { return !uid.empty() && f.uid == uid; });
    const bool is_new = known == report.findings.end();
    PriorFinding finding = is_new ? PriorFinding{} : std::move(*known);  // it may have thousands of sights
    const bool sized = finding.size_mm.has_value();
    PriorSight sight;
    readGroup(group, document, finding, sight);
    if (saysNothing(finding, sight)) {
        const std::string why = "a measurement group that says nothing of a finding";
        if (std::find(report.not_read.begin(), report.not_read.end(), why) == report.not_read.end())
            report.not_read.push_back(why);
        if (!is_new)
            *known = std::move(finding);
        return;
    }
    if (finding.size_mm && !sized)  // with it stands what belongs to the whole
        finding.leading = finding.sights.size();
    finding.sights.push_back(std::move(sight));
    finding.uid =
        !uid.empty() ? uid : uidFor("vicon prior\n" + document.sop_uid + "\n" + std::to_string(report.findings.size()));
    if (finding.name.empty())
        finding.name = "Finding " + std::to_string(report.findings.size() + 1);
    if (is_new)
        report.findings.push_back(std::move(finding));
    else
        *known = std::move(finding);
}

void readLibrary(const ContentItem& group, PriorReport& report)
{
    PriorScan scan{.series_uid = childText(group, seriesConcept().value.c_str()),
                   .position = {},
                   .kernel = childText(group, kernelConcept().value.c_str())};
    if (const std::string position = childText(group, patientPositionConcept().value.c_str()); !position.empty())
        scan.position = positionName(position);
    for (const ContentItem& child : group.children)
        if (child.name.value == sliceThicknessConcept().value)
            scan.slice_thickness_mm = inMillimetres(child).value_or(0);
    if (!scan.series_uid.empty())
        report.scans.push_back(std::move(scan));
}

void readPart(const ContentItem& item, PriorReport& report)
{
    PriorPart part{.series_uid = childText(item, seriesConcept().value.c_str())};
    std::optional<ColonPart> which;
    std::optional<Distension> distension;
    for (const ContentItem& child : item.children) {
        if (isSite(child.name))
            which = colonPartOf(child.code);
        if (child.name.value == "DISTENSION")
            distension = distensionOf(child.code);
    }
    if (!which || !distension)
        return;
    part.part = *which;
    part.distension = *distension;
    report.parts.push_back(part);
}

}  // namespace

bool isMeasurementReport(const ContentDocument& document)
{
    return document.root.name.value == "126000";
}

PriorReport priorFrom(const ContentDocument& document)
{
    PriorReport report{.sop_uid = document.sop_uid,
                       .sop_class = document.sop_class,
                       .series_uid = document.series_uid,
                       .case_id = {},
                       .patient = document.patient,
                       .study = document.study,
                       .maker = document.maker,
                       .person = document.person,
                       .date = document.date,
                       .is_signed = document.verified,
                       .replaces = document.replaces,
                       .not_read = document.not_read};
    visitContainers(document.root, "125007", [&](const ContentItem& group) { addGroup(group, document, report); });
    visitContainers(document.root, "126200", [&](const ContentItem& group) { readLibrary(group, report); });
    visitContainers(document.root, "PART", [&](const ContentItem& part) { readPart(part, report); });
    report.said = assessmentFrom(document.root);
    return report;
}

}  // namespace vicon::report
