#include "vicon/report/finding_statements.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

void addWhereGiven(std::vector<Statement>& out, const char* label, const std::string& text)
{
    if (!text.empty())
        out.push_back({label, text});
}

std::string oneDigit(double value, const char* unit)
{
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.1f %s", value, unit);
    return text.data();
}

std::string volumeWords(double volume_ml)
{
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.*f ml", volumeDecimals(volume_ml), volume_ml);
    return text.data();
}

std::string noDigit(double value)
{
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.0f", value);
    return text.data();
}

/// Every size that there is, the one that counts first.
std::string allSizes(const FindingWithFacts& f)
{
    const FindingFacts& facts = f.facts;
    std::string out = sizeWords(facts);
    if (facts.size_mm)
        out += facts.size_source == SizeSource::reader  ? " (the reader's)"
               : facts.size_source == SizeSource::plane ? " (largest diameter in the best plane)"
               : facts.size_source == SizeSource::slice ? " (between two points of a slice)"
                                                        : " (between two points of the surface)";
    const auto other = [&](SizeSource source, std::optional<double> size_mm, const char* words) {
        if (size_mm && facts.size_source != source)
            out += ", " + std::string(words) + " " + oneDigit(*size_mm, "mm");
    };
    if (facts.size_in_slice)
        other(SizeSource::slice, facts.size_2d_mm, "slice");
    else
        other(SizeSource::plane, facts.size_2d_mm, "best plane");
    other(SizeSource::surface, facts.size_3d_mm, "surface");
    if (f.finding.height_mm)
        out += ", height " + oneDigit(*f.finding.height_mm, "mm");
    if (f.finding.volume_ml)
        out += ", volume " + volumeWords(*f.finding.volume_ml);
    return out;
}

std::string sightWords(const ReadCase& read, const FindingSight& sight)
{
    std::string out = scanLabel(read, sight.scan_id) + ", marker " + sight.marker_id + ": ";
    if (sight.part)
        out += nameOf(*sight.part) + ", ";
    if (sight.clock_hour)
        out += std::to_string(*sight.clock_hour) + " o'clock, ";
    out += millimetres(sight.station_mm) + " from the rectal end, " + millimetres(sight.from_caecum_mm) +
           " from the caecal end (" + percent(sight.fraction) + "); " + positionLetters(sight.position_mm);
    if (sight.size_2d_mm)
        out += (sight.size_in_slice ? "; slice " : "; best plane ") + oneDigit(*sight.size_2d_mm, "mm");
    if (sight.size_3d_mm)
        out += "; surface " + oneDigit(*sight.size_3d_mm, "mm");
    if (sight.mean_hu)
        out += "; " + noDigit(*sight.mean_hu) + " HU";
    return out;
}

template <class Category>
Statement categoryStatement(const char* label, const Proposal<Category>& proposal,
                            const std::optional<Chosen<Category>>& chosen)
{
    const std::string proposed = proposal.category ? nameOf(*proposal.category) : "none";
    if (!chosen)
        return {label, "not chosen; proposed: " + proposed + " (" + proposal.reason + ")"};
    std::string text = nameOf(chosen->category) + ": " + meaningOf(chosen->category);
    if (proposal.category != chosen->category)
        text += "\nproposed: " + proposed + " (" + proposal.reason + ")";
    if (!chosen->why.empty())
        text += "\nreason: " + chosen->why;
    return {label, text};
}

/// Whether no reader has marked, found or stated anything.
bool isUnread(const ReadCase& read)
{
    return read.markers.empty() && read.findings.empty() && toJson(read.assessment) == toJson(Assessment());
}

/// The parts that are not well distended, scan by scan.
std::string distensionWords(const ReadCase& read)
{
    if (read.parts.empty())
        return "not measured";
    const bool all_good = std::all_of(read.parts.begin(), read.parts.end(),
                                      [](const PartState& part) { return part.distension == Distension::good; });
    const bool all_known = std::all_of(read.scans.begin(), read.scans.end(), [&](const ScanRecord& scan) {
        return std::any_of(read.parts.begin(), read.parts.end(),
                           [&](const PartState& part) { return part.scan_id == scan.id; });
    });
    if (all_good && all_known)
        return "good in every segment and position";
    std::string out;
    for (const ScanRecord& scan : read.scans) {
        std::string poor;
        for (const PartState& part : read.parts)
            if (part.scan_id == scan.id && part.distension != Distension::good)
                poor += (poor.empty() ? "" : ", ") + nameOf(part.part) + " " + nameOf(part.distension) +
                        (part.by_reader ? " (reader)" : "");
        const bool known = std::any_of(read.parts.begin(), read.parts.end(),
                                       [&](const PartState& part) { return part.scan_id == scan.id; });
        out += (out.empty() ? "" : "\n") + scanLabel(read, scan.id) + ": " +
               (!known         ? "not measured"
                : poor.empty() ? "good"
                               : poor);
    }
    return out;
}

}  // namespace

std::string scanLabel(const ReadCase& read, const std::string& scan_id)
{
    for (const ScanRecord& scan : read.scans)
        if (scan.id == scan_id)
            return positionName(scan.series.patient_position) + " (series " + std::to_string(scan.series.number) + ")";
    return "scan " + scan_id + ", which is not there";
}

std::string kindWords(const Finding& finding)
{
    std::string out = nameOf(finding.kind);
    if (finding.morphology && nameOf(*finding.morphology) != nameOf(finding.kind))
        out += ", " + nameOf(*finding.morphology);
    if (finding.attenuation)
        out += ", " + nameOf(*finding.attenuation);
    return out;
}

std::string sizeWords(const FindingFacts& facts)
{
    return facts.size_mm ? oneDigit(*facts.size_mm, "mm") : "not measured";
}

std::string placeWords(const FindingFacts& facts)
{
    const FindingSight* lead = facts.lead();
    std::string out = lead && lead->part ? nameOf(*lead->part) : "";
    if (lead && lead->clock_hour)
        out += (out.empty() ? "" : ", ") + std::to_string(*lead->clock_hour) + " o'clock";
    return out;
}

std::string endoscopeWords(const FindingFacts& facts)
{
    if (!facts.endoscope)
        return {};
    const auto centimetres = [](double mm) { return noDigit(mm / 10); };
    return "about " + centimetres(facts.endoscope->about_mm) + " cm (" + centimetres(facts.endoscope->least_mm) +
           " to " + centimetres(facts.endoscope->most_mm) + " cm)";
}

std::string otherProgramsLumen(const LumenOrigin& origin)
{
    return "made by another program: " + textOf(origin);
}

std::vector<Statement> findingStatements(const ReadCase& read, const FindingWithFacts& f)
{
    std::vector<Statement> out{{"Size", allSizes(f)}};
    addWhereGiven(out, "Place", placeWords(f.facts));
    if (f.finding.confidence)
        out.push_back({"Confidence", nameOf(*f.finding.confidence)});
    if (f.facts.mean_hu)
        out.push_back({"Density", noDigit(*f.facts.mean_hu) + " HU, mean"});
    if (f.finding.narrows_lumen)
        out.push_back({"Lumen", "compromised"});
    if (f.finding.invades)
        out.push_back({"Wall", "reaches beyond it"});
    for (const FindingSight& sight : f.facts.sights)
        out.push_back({"Seen in", sightWords(read, sight)});
    if (f.facts.sights.empty())
        out.push_back({"Seen in", "no marker shows it"});
    if (f.facts.endoscope)
        out.push_back({"By endoscope", "estimated: " + endoscopeWords(f.facts)});
    addWhereGiven(out, "Note", f.finding.note);
    return out;
}

std::string unassignedMarkersSentence(const std::vector<std::string>& ids)
{
    if (ids.empty())
        return {};
    std::string said =
        ids.size() == 1 ? "One marker is not assigned to a finding: " : "Markers not assigned to a finding: ";
    for (const std::string& id : ids)
        said += (id == ids.front() ? "" : ", ") + id;
    return said + ". What they show is told under \"Markers not assigned to a finding\".";
}

std::vector<Statement> categoryStatements(const ReadCase& read)
{
    // What nobody has looked at is not normal: without a word of a reader no category stands on paper.
    if (isUnread(read))
        return {{"C-RADS colon", "not chosen; this case was not read yet"},
                {"C-RADS outside", "not chosen; this case was not read yet"}};
    return {categoryStatement("C-RADS colon", read.colon_proposal, read.assessment.colon_category),
            categoryStatement("C-RADS outside", read.extracolonic_proposal, read.assessment.extracolonic_category)};
}

std::vector<Statement> occasionStatements(const ReadCase& read)
{
    std::vector<Statement> out;
    addWhereGiven(out, "Indication", read.assessment.indication);
    addWhereGiven(out, "Comparison", read.assessment.comparison);
    return out;
}

std::vector<Statement> reliabilityStatements(const ReadCase& read)
{
    const Assessment& said = read.assessment;
    std::vector<Statement> out;
    if (said.preparation)
        out.push_back({"Preparation", nameOf(*said.preparation)});
    if (said.tagging)
        out.push_back({"Tagging", nameOf(*said.tagging)});
    out.push_back({"Distension", distensionWords(read)});
    if (said.inadequate)
        out.push_back({"Adequacy", "a lesion of 10 mm or more cannot be excluded"});
    if (said.priors_awaited)
        out.push_back({"Priors", "earlier studies are awaited"});
    return out;
}

std::vector<Statement> techniqueStatements(const ReadCase& read)
{
    const Assessment& said = read.assessment;
    std::vector<Statement> out;
    addWhereGiven(out, "Technique", said.technique);
    if (said.dose_mgy_cm)
        out.push_back({"Dose", oneDigit(*said.dose_mgy_cm, "mGy cm") + " (dose length product)"});
    if (said.coverage_percent)
        out.push_back({"Wall reviewed", oneDigit(*said.coverage_percent, "%")});
    if (said.reading_minutes)
        out.push_back({"Reading time", oneDigit(*said.reading_minutes, "min")});
    return out;
}

std::vector<Statement> lumenStatements(const ReadCase& read)
{
    std::vector<Statement> out;
    for (const auto& [scan_id, origin] : read.given_lumens)
        out.push_back({"Lumen", scanLabel(read, scan_id) + ": " + otherProgramsLumen(origin)});
    return out;
}

std::vector<Statement> assessmentStatements(const ReadCase& read)
{
    std::vector<Statement> out = occasionStatements(read);
    for (const auto& some : {reliabilityStatements(read), techniqueStatements(read), lumenStatements(read)})
        out.insert(out.end(), some.begin(), some.end());
    return out;
}

std::vector<Statement> extracolonicStatements(const ReadCase& read)
{
    std::vector<Statement> out;
    for (const ExtracolonicFinding& e : read.assessment.extracolonic)
        out.push_back({nameOf(e.category), e.organ.empty() ? e.text : e.organ + ": " + e.text});
    if (read.assessment.extracolonic_limited)
        out.push_back({"E0", "what lies outside the colon cannot be judged"});
    if (out.empty())
        out.push_back({"None", "no finding outside the colon was stated"});
    return out;
}

std::string stateWords(const std::optional<ReportVersion>& version)
{
    if (!version)
        return "Draft, not signed";
    const std::string who =
        version->person + ", " + utcWords(version->at) + ", version " + std::to_string(version->version);
    return version->isSigned() ? "Signed by " + who : "Preliminary, not signed; made by " + who;
}

std::string amendmentWords(const std::optional<ReportVersion>& version)
{
    if (!version || version->replaces == 0)
        return {};
    return "Amends version " + std::to_string(version->replaces) + ", which stays: " + version->reason;
}

}  // namespace vicon::report
