#pragma once

#include <optional>
#include <string>

#include "vicon/cases/assessment.h"
#include "vicon/cases/content_tree.h"
#include "vicon/cases/finding.h"
#include "vicon/core/colon_parts.h"

namespace vicon::report {

// What a code means to VICON: the ones it writes itself, and of other makers what their English words say.

bool isSite(const CodedConcept& name);
std::optional<FindingKind> findingKindOf(const CodedConcept& code);
std::optional<ColonPart> colonPartOf(const CodedConcept& code);
std::optional<Morphology> morphologyOf(const CodedConcept& code);
std::optional<Attenuation> attenuationOf(const CodedConcept& code);
std::optional<Confidence> confidenceOf(const CodedConcept& code);
std::optional<Distension> distensionOf(const CodedConcept& code);
/// "7 o'clock".
std::optional<int> hourFrom(const std::string& text);

/// What is said of the whole study.
Assessment assessmentFrom(const ContentItem& root);

}  // namespace vicon::report
