#include "vicon/cases/report_content.h"

#include <algorithm>
#include <set>

#include "vicon/cases/placing.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

std::vector<PartState> measuredParts(const ScanRecord& scan, const StepResults& results)
{
    std::vector<PartState> out;
    if (!results.quality || !results.quality->quality)
        return out;
    for (const StretchQuality& part : results.quality->quality->parts)
        if (part.part)
            out.push_back({scan.id, *part.part, part.adequate ? Distension::good : Distension::collapsed, false});
    return out;
}

/// Of each scan, where its parts lie.
std::map<std::string, ColonPartRanges> partsOfScans(CaseStore& store, const std::string& case_id)
{
    std::map<std::string, ColonPartRanges> out;
    for (const ScanRecord& scan : store.scans(case_id))
        out[scan.id] = partsOf(store, scan);
    return out;
}

/// What the reader says goes before what was measured.
void takeReaders(std::vector<PartState>& parts, const std::vector<PartDistension>& said)
{
    for (const PartDistension& one : said) {
        auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const PartState& p) { return p.scan_id == one.scan_id && p.part == one.part; });
        if (found == parts.end())
            found = parts.insert(parts.end(), {one.scan_id, one.part});
        found->distension = one.distension;
        found->by_reader = true;
    }
}

/// Those of findings that are there.
std::vector<ComparedFinding> comparedFindings(CaseStore& store, const ReadCase& read)
{
    std::vector<ComparedFinding> out;
    for (Comparison& said : comparisons(store, read.record.id))
        for (const auto& [finding, facts] : read.findings)
            if (finding.id == said.finding_id) {
                const MeasuredSize now = measuredSizeOf(finding, facts, read.scans, read.record.study);
                const Growth growth = growthBetween(said.before, now);
                out.push_back({std::move(said), now, growth});
                break;
            }
    return out;
}

bool showsColon(const StepResults& results)
{
    return results.segment && results.segment->organ.isColon() && results.segment->verdict != Verdict::absent;
}

JudgedStudy judged(const ReadCase& read)
{
    JudgedStudy study;
    for (const auto& [finding, facts] : read.findings)
        study.findings.push_back(
            {finding.id, finding.kind, facts.size_mm, finding.attenuation, finding.narrows_lumen, finding.invades});
    study.loose_markers = read.loose_markers;
    study.collapsed_parts = collapsedEverywhere(read.parts);
    study.inadequate = read.assessment.inadequate || read.assessment.preparation == Grade::inadequate;
    study.priors_awaited = read.assessment.priors_awaited;
    study.parts_known = !read.parts.empty();
    for (const ExtracolonicFinding& e : read.assessment.extracolonic)
        study.extracolonic.push_back(e.category);
    study.extracolonic_limited = read.assessment.extracolonic_limited;
    return study;
}

/// A category that is not the proposed one, without a reason against this proposal.
template <class Category>
std::string unexplained(const Proposal<Category>& proposal, const std::optional<Chosen<Category>>& chosen)
{
    if (!chosen || proposal.category == chosen->category)
        return {};
    const bool explained = !chosen->why.empty();
    if (explained && chosen->proposed == proposal.category)
        return {};
    const std::string now = proposal.category ? nameOf(*proposal.category) + " is proposed" : "nothing can be proposed";
    return nameOf(chosen->category) + " was chosen where " + now + " (" + proposal.reason + "): say why" +
           (explained ? "; the reason given was not against this" : "");
}

}  // namespace

Quantity quantityOf(const ReadCase& read)
{
    const bool signal = std::any_of(read.scans.begin(), read.scans.end(),
                                    [](const ScanRecord& scan) { return quantityOf(scan.series) == Quantity::signal; });
    return signal ? Quantity::signal : Quantity::density;
}

ReadCase readCase(CaseStore& store, const std::string& case_id)
{
    const std::string id = store.requireCase(case_id).id;
    return readCaseWith(store, id, assessmentOf(store, id));
}

ReadCase readCaseWith(CaseStore& store, const std::string& case_id, const Assessment& assessment)
{
    ReadCase read;
    read.record = store.requireCase(case_id);
    const std::string& id = read.record.id;
    read.markers = store.markers(id);
    std::set<std::string> joined;
    const auto skeletons = skeletonsOf(store, id);
    const auto parts = partsOfScans(store, id);
    for (const Finding& finding : findings(store, id)) {
        read.findings.push_back({finding, factsOf(finding, read.markers, skeletons, parts)});
        joined.insert(finding.markers.begin(), finding.markers.end());
    }
    for (const Marker& marker : read.markers)
        if (!joined.contains(marker.id))
            read.loose_markers.push_back(marker.id);
    read.assessment = assessment;
    bool shows_colon = false;
    for (const ScanRecord& scan : store.scans(id)) {
        const bool marked = std::any_of(read.markers.begin(), read.markers.end(),
                                        [&](const Marker& m) { return m.scan_id == scan.id; });
        if (scan.role != ScanRole::scan && !marked)
            continue;
        read.scans.push_back(scan);
        const StepResults results = resultsOf(store.steps(scan.case_id, scan.id));
        shows_colon = shows_colon || showsColon(results);
        if (results.segment && results.segment->given)
            read.given_lumens.emplace(scan.id, *results.segment->given);
        for (const PartState& part : measuredParts(scan, results))
            read.parts.push_back(part);
    }
    takeReaders(read.parts, read.assessment.distension);
    read.comparisons = comparedFindings(store, read);
    JudgedStudy study = judged(read);
    study.unprepared = !shows_colon;
    read.colon_proposal = proposeColonCategory(study);
    read.extracolonic_proposal = proposeExtracolonicCategory(study);
    return read;
}

std::vector<std::string> collapsedEverywhere(const std::vector<PartState>& parts)
{
    std::set<ColonPart> open, collapsed;
    for (const PartState& part : parts)
        (part.distension == Distension::collapsed ? collapsed : open).insert(part.part);
    std::vector<std::string> out;
    for (const ColonPart part : collapsed)
        if (!open.contains(part))
            out.push_back(nameOf(part));
    return out;
}

std::vector<std::string> missingForSignature(const ReadCase& read)
{
    std::vector<std::string> out;
    for (const auto& [finding, facts] : read.findings)
        if (facts.sights.empty())
            out.push_back("finding " + finding.id + " has no marker");
    const Assessment& assessment = read.assessment;
    if (!assessment.colon_category)
        out.emplace_back("no C-RADS category of the colon was chosen");
    if (!assessment.extracolonic_category)
        out.emplace_back("no C-RADS category outside the colon was chosen");
    for (const std::string& line : {unexplained(read.colon_proposal, assessment.colon_category),
                                    unexplained(read.extracolonic_proposal, assessment.extracolonic_category)})
        if (!line.empty())
            out.push_back(line);
    return out;
}

void requireReasons(const ReadCase& read)
{
    for (const std::string& line : {unexplained(read.colon_proposal, read.assessment.colon_category),
                                    unexplained(read.extracolonic_proposal, read.assessment.extracolonic_category)})
        if (!line.empty())
            throw Error(ErrorCode::wrong_use, line, read.record.id);
}

}  // namespace vicon
