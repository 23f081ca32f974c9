#pragma once

#include <string>

#include "vicon/cases/assessment.h"
#include "vicon/cases/finding.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/quantity.h"

namespace vicon::report {

/// Of concepts that no standard has a code for.
inline constexpr const char* kPrivateScheme = "99VICON";

/// A concept by DICOM's coding: "68496003", "SCT", "Polyp of colon".
struct Code {
    std::string value, scheme, meaning;
};

// PS3.16 and SNOMED CT, where they have a code; else our own.
Code codeOf(FindingKind kind);
Code codeOf(Morphology morphology);
Code codeOf(Attenuation attenuation);
Code codeOf(Confidence confidence);
Code codeOf(ColonPart part);
Code codeOf(ColonCategory category);
Code codeOf(ExtracolonicCategory category);
Code codeOf(Distension distension);
Code codeOf(Grade grade);

// Of whole reports.
Code procedureReported(Quantity quantity);  ///< CT of colon and rectum, or MR colonography
Code extracolonicConcept();                 ///< C-RADS outside the colon
Code findingSiteConcept();
Code seriesConcept();  ///< Series Instance UID
// Of the images of a scan.
Code patientPositionConcept();
Code sliceThicknessConcept();
Code kernelConcept();
Code otherLumenConcept();  ///< that another program made the lumen

Code dcm(const char* value, const char* meaning);
Code sct(const char* value, const char* meaning);
Code loinc(const char* value, const char* meaning);
Code privateCode(const std::string& value, const std::string& meaning);
Code ucum(const char* unit, const char* meaning);

}  // namespace vicon::report
