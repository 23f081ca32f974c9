#include "vicon/cases/c_rads.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "vicon/cases/finding_facts.h"
#include "vicon/core/enum_names.h"

namespace vicon {
namespace {

// Borders of C-RADS, mm. A polyp of 30 mm is a mass.
constexpr double kPolyp_mm = 6, kLarge_mm = 10, kMass_mm = 30;
constexpr std::size_t kManyPolyps = 3;
/// Nearer than this to a border a size does not settle the category: readers differ by as much and more.
constexpr double kNearBorder_mm = 0.5;

constexpr EnumNames<ColonCategory, 6> kColonNames = {{{ColonCategory::c0, "C0"},
                                                      {ColonCategory::c1, "C1"},
                                                      {ColonCategory::c2a, "C2a"},
                                                      {ColonCategory::c2b, "C2b"},
                                                      {ColonCategory::c3, "C3"},
                                                      {ColonCategory::c4, "C4"}}};
constexpr EnumNames<ExtracolonicCategory, 6> kExtracolonicNames = {{{ExtracolonicCategory::e0, "E0"},
                                                                    {ExtracolonicCategory::e1, "E1/E2"},
                                                                    {ExtracolonicCategory::e1, "E1"},
                                                                    {ExtracolonicCategory::e1, "E2"},
                                                                    {ExtracolonicCategory::e3, "E3"},
                                                                    {ExtracolonicCategory::e4, "E4"}}};

std::string sizeText(double size_mm)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f mm", size_mm);
    return text.data();
}

std::string listed(const std::vector<std::string>& parts, const char* between = ", ")
{
    std::string out;
    for (const std::string& part : parts)
        out += (out.empty() ? "" : between) + part;
    return out;
}

/// What the findings come to, each group with the words that name its findings.
struct Weighed {
    std::vector<std::string> masses, large, medium, small, indeterminate, strictures, benign, unsized, unweighed;
    std::vector<std::string> remarks;
};

std::string nearBorder(double size_mm)
{
    for (const double border : {kPolyp_mm, kLarge_mm, kMass_mm})
        if (std::abs(size_mm - border) < kNearBorder_mm)
            return " (within " + sizeText(kNearBorder_mm) + " of the " + std::to_string(int(border)) + " mm border)";
    return {};
}

void weighPolyp(const JudgedFinding& f, Weighed& out)
{
    if (f.attenuation == Attenuation::fat)
        out.remarks.push_back(f.id + " has the attenuation of fat: a lipoma?");
    if (!f.size_mm) {
        out.unsized.push_back(f.id);
        return;
    }
    const double size_mm = roundedSize_mm(*f.size_mm);
    const std::string words = f.id + ", polyp of " + sizeText(size_mm) + nearBorder(size_mm);
    auto& group = size_mm >= kMass_mm    ? out.masses
                  : size_mm >= kLarge_mm ? out.large
                  : size_mm >= kPolyp_mm ? out.medium
                                         : out.small;
    group.push_back(words);
}

/// Looks malignant wherever it compromises the lumen or invades. A diverticular stricture is narrow by its nature, and
/// what the reader calls benign stays so.
bool isGrave(const JudgedFinding& f)
{
    switch (f.kind) {
        case FindingKind::polyp:
        case FindingKind::mass:
        case FindingKind::indeterminate:
        case FindingKind::other:
            return f.narrows_lumen || f.invades;
        case FindingKind::diverticular_stricture:
            return f.invades;
        default:
            return false;
    }
}

void weigh(const JudgedFinding& f, Weighed& out)
{
    const std::string words = f.id + ", " + nameOf(f.kind);
    if (isGrave(f)) {
        out.masses.push_back(words + (f.narrows_lumen ? " that compromises the lumen" : "") +
                             (f.invades ? " that reaches beyond the wall" : ""));
        return;
    }
    switch (f.kind) {
        case FindingKind::polyp:
            weighPolyp(f, out);
            break;
        case FindingKind::mass:
            out.masses.push_back(words + (f.size_mm ? " of " + sizeText(*f.size_mm) : ""));
            if (f.size_mm && roundedSize_mm(*f.size_mm) < kMass_mm)
                out.remarks.push_back(f.id + " is called a mass but is smaller than 30 mm");
            break;
        case FindingKind::indeterminate:
            if (!f.size_mm)
                out.unsized.push_back(f.id);
            else if (roundedSize_mm(*f.size_mm) >= kPolyp_mm)
                out.indeterminate.push_back(words + " of " + sizeText(*f.size_mm) + nearBorder(*f.size_mm));
            else
                out.small.push_back(words + " of " + sizeText(*f.size_mm) + nearBorder(*f.size_mm));
            break;
        case FindingKind::diverticular_stricture:
            out.strictures.push_back(words);
            break;
        case FindingKind::other:
            out.unweighed.push_back(f.id);
            break;
        default:
            out.benign.push_back(words);
    }
}

/// Why the study does not answer the question; empty where it does.
std::string incompleteness(const JudgedStudy& study)
{
    std::vector<std::string> why;
    if (study.inadequate)
        why.emplace_back("a lesion of 10 mm or more cannot be excluded");
    if (!study.collapsed_parts.empty())
        why.push_back(listed(study.collapsed_parts) + " collapsed in every position scanned");
    if (study.priors_awaited)
        why.emplace_back("earlier studies are awaited");
    if (study.unprepared)
        why.emplace_back("no scan was prepared that shows a colon");
    return listed(why, "; ");
}

std::string remarksOf(const Weighed& weighed)
{
    std::string out;
    for (const std::string& remark : weighed.remarks)
        out += "; " + remark;
    if (!weighed.unweighed.empty())
        out += "; not weighed, for the reader to judge: " + listed(weighed.unweighed);
    return out;
}

Proposal<ColonCategory> ofWeighed(const Weighed& w, const JudgedStudy& study)
{
    using enum ColonCategory;
    const std::string incomplete = incompleteness(study);
    const std::string but = incomplete.empty() ? "" : "; the study is incomplete as well: " + incomplete;
    if (!w.masses.empty())
        return {c4, listed(w.masses, "; ") + but};
    if (!w.large.empty())
        return {c3, listed(w.large, "; ") + ": " + std::to_string(int(kLarge_mm)) + " mm or more" + but};
    if (w.medium.size() >= kManyPolyps)
        return {c3, std::to_string(w.medium.size()) + " polyps of 6 to 9 mm: " + listed(w.medium, "; ") + but};
    if (!study.loose_markers.empty())
        return {{}, "markers not assigned to a finding: " + listed(study.loose_markers)};
    if (!incomplete.empty())
        return {c0, incomplete + (w.medium.empty() ? "" : "; found nevertheless: " + listed(w.medium, "; "))};
    if (!w.unsized.empty())
        return {{}, "no size was measured of " + listed(w.unsized)};
    if (!w.medium.empty())
        return {c2a, (w.medium.size() == 1 ? "one polyp" : "two polyps") +
                         (" of 6 to 9 mm: " + listed(w.medium, "; ")) +
                         (w.strictures.empty() ? "" : "; also " + listed(w.strictures, "; "))};
    if (!w.indeterminate.empty())
        return {c2a, "indeterminate: " + listed(w.indeterminate, "; ")};
    if (!w.strictures.empty())
        return {c2b, "likely benign diverticular finding: " + listed(w.strictures, "; ")};
    std::string reason = "no polyp of 6 mm or more";
    if (!w.small.empty())
        reason += "; smaller: " + listed(w.small, "; ");
    if (!w.benign.empty())
        reason += "; benign: " + listed(w.benign, "; ");
    return {c1, reason};
}

}  // namespace

std::string nameOf(ColonCategory category)
{
    return nameIn(kColonNames, category);
}

ColonCategory colonCategoryFrom(const std::string& name)
{
    return valueIn(kColonNames, name, "a colon's C-RADS category");
}

std::string meaningOf(ColonCategory category)
{
    switch (category) {
        case ColonCategory::c0:
            return "inadequate study, or awaiting earlier studies";
        case ColonCategory::c1:
            return "normal colon or benign lesion";
        case ColonCategory::c2a:
            return "intermediate polyp or indeterminate finding";
        case ColonCategory::c2b:
            return "likely benign diverticular finding";
        case ColonCategory::c3:
            return "polyp, possibly advanced adenoma";
        case ColonCategory::c4:
            return "colonic mass, likely malignant";
    }
    return {};
}

std::string adviceFor(ColonCategory category, Quantity quantity)
{
    const std::string again = std::string("Repeat ") + examinationOf(quantity);
    switch (category) {
        case ColonCategory::c0:
            return "Repeat the examination, use another test, or compare with the earlier studies.";
        case ColonCategory::c1:
            return "Continue routine screening.";
        case ColonCategory::c2a:
            return again + " in 3 years, or colonoscopy.";
        case ColonCategory::c2b:
            return again + " in 5 years; within 3 years where it is not surely benign.";
        case ColonCategory::c3:
            return "Colonoscopy.";
        case ColonCategory::c4:
            return "Surgical or oncological consultation; colonoscopy.";
    }
    return {};
}

std::string nameOf(ExtracolonicCategory category)
{
    return nameIn(kExtracolonicNames, category);
}

ExtracolonicCategory extracolonicCategoryFrom(const std::string& name)
{
    return valueIn(kExtracolonicNames, name, "a C-RADS category outside the colon");
}

std::string meaningOf(ExtracolonicCategory category)
{
    switch (category) {
        case ExtracolonicCategory::e0:
            return "limited examination";
        case ExtracolonicCategory::e1:
            return "normal, or an unimportant finding";
        case ExtracolonicCategory::e3:
            return "likely unimportant finding, may need work-up";
        case ExtracolonicCategory::e4:
            return "potentially important finding";
    }
    return {};
}

Proposal<ColonCategory> proposeColonCategory(const JudgedStudy& study)
{
    Weighed weighed;
    for (const JudgedFinding& finding : study.findings)
        weigh(finding, weighed);
    Proposal<ColonCategory> proposal = ofWeighed(weighed, study);
    proposal.reason += remarksOf(weighed);
    if (!study.parts_known && proposal.category && *proposal.category <= ColonCategory::c1)
        proposal.reason += "; distension was not measured";
    return proposal;
}

Proposal<ExtracolonicCategory> proposeExtracolonicCategory(const JudgedStudy& study)
{
    using enum ExtracolonicCategory;
    const auto count = [&](ExtracolonicCategory category) {
        return std::count(study.extracolonic.begin(), study.extracolonic.end(), category);
    };
    for (const ExtracolonicCategory category : {e4, e3})
        if (const auto found = count(category); found > 0)
            return {category, std::to_string(found) + (found == 1 ? " finding" : " findings") +
                                  " outside the colon of category " + nameOf(category)};
    if (study.extracolonic_limited || count(e0) > 0)
        return {e0, "what lies outside the colon cannot be judged"};
    if (study.extracolonic.empty())
        return {e1, "no finding outside the colon was stated"};
    return {e1, "only unimportant findings outside the colon"};
}

}  // namespace vicon
