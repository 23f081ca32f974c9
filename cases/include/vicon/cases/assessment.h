#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/c_rads.h"
#include "vicon/core/colon_parts.h"

namespace vicon {

/// How good something is to read by.
enum class Grade { good, fair, inadequate };
std::string nameOf(Grade grade);
/// Throws Error{wrong_use}, here and below, for any other name.
Grade gradeFrom(const std::string& name);
std::vector<std::string> gradeNames();

enum class Distension { good, limited, collapsed };
std::string nameOf(Distension distension);
Distension distensionFrom(const std::string& name);
std::vector<std::string> distensionNames();

/// What the reader says of one part of the colon in one scan; it goes before what was measured.
struct PartDistension {
    std::string scan_id;
    ColonPart part = ColonPart::rectum;
    Distension distension = Distension::good;
};

struct ExtracolonicFinding {
    std::string organ;
    std::string text;
    ExtracolonicCategory category = ExtracolonicCategory::e1;
};

/// The category that the reader chose. One that is not the proposed one has a reason, which holds against the proposal
/// that the reader saw and no other.
template <class Category>
struct Chosen {
    Category category{};
    std::string why;
    std::optional<Category> proposed;  ///< then; nothing: none was
};

/// What the reader says of the whole study. Texts are UTF-8.
struct Assessment {
    std::string indication, technique, comparison, impression, recommendation;
    std::optional<Grade> preparation, tagging;
    std::vector<PartDistension> distension;
    bool inadequate = false;  ///< a lesion of 10 mm or more cannot be excluded
    bool priors_awaited = false;
    std::optional<double> dose_mgy_cm;  ///< dose length product
    std::optional<double> reading_minutes, coverage_percent;
    bool extracolonic_limited = false;
    std::vector<ExtracolonicFinding> extracolonic;
    std::optional<Chosen<ColonCategory>> colon_category;
    std::optional<Chosen<ExtracolonicCategory>> extracolonic_category;
};

/// As docs/dev/schemas/report.schema.json has it.
nlohmann::json toJson(const Assessment& assessment);
/// Throws Error{bad_input}.
Assessment assessmentFromJson(const nlohmann::json& json);

}  // namespace vicon
