#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/finding.h"
#include "vicon/core/quantity.h"

namespace vicon {

// C-RADS, the CT Colonography Reporting and Data System, update of 2023. VICON proposes; the reader chooses.

enum class ColonCategory { c0, c1, c2a, c2b, c3, c4 };
/// "C0", "C1", "C2a", "C2b", "C3", "C4".
std::string nameOf(ColonCategory category);
/// Throws Error{wrong_use} for any other name.
ColonCategory colonCategoryFrom(const std::string& name);
/// What it means, in the words of a report.
std::string meaningOf(ColonCategory category);
/// What is usually advised, the same kind of examination where it is to be repeated; the reader's recommendation
/// replaces it.
std::string adviceFor(ColonCategory category, Quantity quantity);

enum class ExtracolonicCategory { e0, e1, e3, e4 };
/// "E0", "E1/E2", "E3", "E4". E1 and E2 are one since 2023.
std::string nameOf(ExtracolonicCategory category);
/// Takes "E1" and "E2" as well. Throws Error{wrong_use} for any other name.
ExtracolonicCategory extracolonicCategoryFrom(const std::string& name);
std::string meaningOf(ExtracolonicCategory category);

/// A finding as the rules see it.
struct JudgedFinding {
    std::string id;
    FindingKind kind = FindingKind::polyp;
    std::optional<double> size_mm;
    std::optional<Attenuation> attenuation;
    bool narrows_lumen = false, invades = false;
};

/// All that the rules see of a study.
struct JudgedStudy {
    std::vector<JudgedFinding> findings;
    std::vector<std::string> loose_markers;    ///< set by a reader, of no finding: what they show is not known
    std::vector<std::string> collapsed_parts;  ///< in every position that was scanned
    bool inadequate = false;                   ///< the reader: a lesion of 10 mm or more cannot be excluded
    bool priors_awaited = false;
    bool unprepared = false;                         ///< no scan was prepared in which a colon was found or given
    bool parts_known = true;                         ///< distension was measured or stated for at least one scan
    std::vector<ExtracolonicCategory> extracolonic;  ///< of each finding outside the colon
    bool extracolonic_limited = false;               ///< the reader: what lies outside cannot be judged
};

template <class Category>
struct Proposal {
    std::optional<Category> category;  ///< nothing where something needed is missing; the reason says what
    std::string reason;                ///< in words
};

/// Sizes are compared as they are printed, in tenths of a mm; they are not rounded to whole ones.
/// A finding that leads to colonoscopy anyway (C4, C3) goes before an incomplete study (C0), which goes before C2 and
/// C1. Nothing else is proposed while there are markers of no finding.
Proposal<ColonCategory> proposeColonCategory(const JudgedStudy& study);
/// The highest of its findings; E3 and E4 go before E0.
Proposal<ExtracolonicCategory> proposeExtracolonicCategory(const JudgedStudy& study);

}  // namespace vicon
