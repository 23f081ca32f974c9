// What the report says first: what was found, and what to do.
#include <algorithm>

#include "vicon/report/finding_statements.h"

namespace vicon::report {
namespace {

/// What is no cause for anything further.
bool isBenign(FindingKind kind)
{
    switch (kind) {
        case FindingKind::lipoma:
        case FindingKind::stool:
        case FindingKind::diverticulum:
        case FindingKind::inverted_diverticulum:
        case FindingKind::valve:
            return true;
        default:
            return false;
    }
}

/// What was found outside the colon and may need something to be done, a line each.
std::string importantOutside(const Assessment& said)
{
    std::string out;
    for (const ExtracolonicFinding& one : said.extracolonic)
        if (one.category == ExtracolonicCategory::e3 || one.category == ExtracolonicCategory::e4)
            out += (out.empty() ? "" : "\n") + ("Outside the colon, " + one.organ + ": " + one.text) + ".";
    return out;
}

/// "Finding 3: polyp, sessile, 7.3 mm, sigmoid, 4 o'clock."
std::string findingInBrief(const FindingWithFacts& f)
{
    const std::string place = placeWords(f.facts);
    return "Finding " + std::to_string(f.finding.number()) + ": " + kindWords(f.finding) + ", " + sizeWords(f.facts) +
           (place.empty() ? "" : ", " + place) + ".";
}

/// What must be acted upon comes first.
bool isGraver(const FindingWithFacts* a, const FindingWithFacts* b)
{
    const bool mass_a = a->finding.kind == FindingKind::mass, mass_b = b->finding.kind == FindingKind::mass;
    return mass_a != mass_b ? mass_a : a->facts.size_mm.value_or(0) > b->facts.size_mm.value_or(0);
}

/// Why the study does not answer the question, a line each; empty where it does.
std::string incompleteInBrief(const ReadCase& read)
{
    const auto& chosen = read.assessment.colon_category;
    if (!chosen || chosen->category != ColonCategory::c0)
        return {};
    std::string collapsed, out;
    for (const std::string& part : collapsedEverywhere(read.parts))
        collapsed += (collapsed.empty() ? "" : ", ") + part;
    const auto add = [&](const std::string& line) { out += (out.empty() ? "" : "\n") + line; };
    if (read.assessment.inadequate)
        add("The study is inadequate: a lesion of 10 mm or more cannot be excluded.");
    if (!collapsed.empty())
        add("Collapsed in every position scanned: " + collapsed + ".");
    if (read.assessment.priors_awaited)
        add("Earlier studies are awaited.");
    return out.empty() ? "The study is inadequate." : out;
}

/// What is not benign, a line each, the gravest first; of many how many there are, and the largest.
std::string findingsInBrief(const ReadCase& read)
{
    constexpr std::size_t kMostLines = 5, kLargest = 3;
    std::vector<const FindingWithFacts*> told;
    for (const FindingWithFacts& f : read.findings)
        if (!isBenign(f.finding.kind))
            told.push_back(&f);
    std::stable_sort(told.begin(), told.end(), isGraver);
    std::string out;
    if (told.size() > kMostLines) {
        out = std::to_string(told.size()) + " findings, of which the largest are:";
        told.resize(kLargest);
    }
    for (const FindingWithFacts* f : told)
        out += (out.empty() ? "" : "\n") + findingInBrief(*f);
    return out;
}

}  // namespace

std::string impressionText(const ReadCase& read)
{
    if (!read.assessment.impression.empty())
        return read.assessment.impression;
    std::string out = findingsInBrief(read);
    if (const std::string incomplete = incompleteInBrief(read); !incomplete.empty())
        out += (out.empty() ? "" : "\n") + incomplete;
    const auto& chosen = read.assessment.colon_category;
    if (out.empty() && chosen && chosen->category == ColonCategory::c1)
        out = "No polyp of 6 mm or more was found.";
    if (const std::string outside = importantOutside(read.assessment); !outside.empty())
        out += (out.empty() ? "" : "\n") + outside;
    return out.empty() ? "No impression was given." : out;
}

std::string recommendationText(const ReadCase& read)
{
    if (!read.assessment.recommendation.empty())
        return read.assessment.recommendation;
    return read.assessment.colon_category ? adviceFor(read.assessment.colon_category->category, quantityOf(read))
                                          : "not given";
}

}  // namespace vicon::report
