#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vicon {

/// What the reader says that a finding is.
enum class FindingKind {
    polyp,
    mass,
    indeterminate,  ///< may be a polyp or not
    lipoma,
    stool,
    diverticulum,
    inverted_diverticulum,
    diverticular_stricture,  ///< thick or narrow wall, likely benign
    valve,                   ///< the ileocaecal one
    other,
};
/// "polyp", "inverted diverticulum", ...
std::string nameOf(FindingKind kind);
/// Throws Error{wrong_use}, here and below, for any other name.
FindingKind findingKindFrom(const std::string& name);
std::vector<std::string> findingKindNames();

enum class Morphology { sessile, pedunculated, flat, mass };
std::string nameOf(Morphology morphology);
Morphology morphologyFrom(const std::string& name);
std::vector<std::string> morphologyNames();

enum class Attenuation { soft_tissue, fat, mixed };
/// "soft tissue", "fat", "mixed".
std::string nameOf(Attenuation attenuation);
Attenuation attenuationFrom(const std::string& name);
std::vector<std::string> attenuationNames();

/// How sure the reader is that it is what they say.
enum class Confidence { low, medium, high };
std::string nameOf(Confidence confidence);
Confidence confidenceFrom(const std::string& name);
std::vector<std::string> confidenceNames();

/// One thing in the patient. It joins the markers that show it, in whatever scans; where it lies and how large it is
/// follows from them: see finding_facts.h.
struct Finding {
    std::string id;  ///< "f1", "f2", ... within the case; its number is what reports call it
    FindingKind kind = FindingKind::polyp;
    std::vector<std::string> markers;  ///< ids; one that was deleted counts again when its deletion is undone
    std::optional<Morphology> morphology;
    std::optional<Attenuation> attenuation;
    std::optional<Confidence> confidence;
    std::optional<double> read_size_mm;  ///< the reader's own; it counts where it is given
    std::optional<double> height_mm;     ///< of a flat one, above the wall
    std::optional<double> volume_ml;
    bool narrows_lumen = false;         ///< compromises it
    bool invades = false;               ///< reaches beyond the wall
    std::vector<std::string> pictures;  ///< of the markers, those whose pictures the reader chose; empty: all
    std::string note;                   ///< UTF-8
    std::string created, changed;       ///< UTC

    int number() const;  ///< of "f7": 7
};

/// As docs/dev/schemas/report.schema.json has it.
nlohmann::json toJson(const Finding& finding);
/// Throws Error{bad_input}.
Finding findingFromJson(const nlohmann::json& json);

}  // namespace vicon
