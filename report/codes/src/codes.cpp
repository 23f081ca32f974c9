#include "vicon/report/codes.h"

#include <algorithm>

namespace vicon::report {
namespace {

/// "inverted diverticulum" as a code of our own: "INVERTED_DIVERTICULUM".
std::string valueFrom(std::string words)
{
    for (char& c : words)
        c = c == ' ' || c == '/' ? '_' : (c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c);
    return words;
}

Code oursFor(const std::string& name)
{
    return privateCode(valueFrom(name), name);
}

}  // namespace

Code procedureReported(Quantity quantity)
{
    if (quantity == Quantity::signal)  // LOINC has none for MR of the colon
        return privateCode("MR_COLONOGRAPHY", "MR colonography");
    return loinc("60515-4", "CT Colon and Rectum W air contrast PR");
}

Code extracolonicConcept()
{
    return privateCode("EXTRACOLONIC", "Extracolonic category (C-RADS)");
}

Code findingSiteConcept()
{
    return sct("363698007", "Finding Site");
}

Code seriesConcept()
{
    return dcm("112002", "Series Instance UID");
}

Code patientPositionConcept()
{
    return privateCode("PATIENT_POSITION", "Patient Position");
}

Code sliceThicknessConcept()
{
    return dcm("112225", "Slice Thickness");
}

Code kernelConcept()
{
    return privateCode("KERNEL", "Convolution Kernel");
}

Code otherLumenConcept()
{
    return privateCode("OTHER_LUMEN", "Lumen made by another program");
}

Code dcm(const char* value, const char* meaning)
{
    return {value, "DCM", meaning};
}

Code sct(const char* value, const char* meaning)
{
    return {value, "SCT", meaning};
}

Code loinc(const char* value, const char* meaning)
{
    return {value, "LN", meaning};
}

Code privateCode(const std::string& value, const std::string& meaning)
{
    return {value, kPrivateScheme, meaning};
}

Code ucum(const char* unit, const char* meaning)
{
    return {unit, "UCUM", meaning};
}

Code codeOf(FindingKind kind)
{
    switch (kind) {
        case FindingKind::polyp:
            return sct("68496003", "Polyp of colon");
        case FindingKind::mass:
            return sct("126838000", "Tumor of colon");
        case FindingKind::lipoma:
            return sct("134328007", "Lipoma");
        case FindingKind::stool:
            return sct("39477002", "Feces");
        case FindingKind::diverticulum:
            return sct("31113003", "Diverticulum");
        case FindingKind::inverted_diverticulum:
            return sct("441901008", "Inverted diverticulum");
        case FindingKind::valve:
            return sct("23153004", "Ileocecal valve");
        case FindingKind::indeterminate:
        case FindingKind::diverticular_stricture:
        case FindingKind::other:
            break;
    }
    return oursFor(nameOf(kind));
}

Code codeOf(Morphology morphology)
{
    switch (morphology) {
        case Morphology::sessile:
            return sct("5712003", "Sessile");
        case Morphology::pedunculated:
            return sct("25126001", "Pedunculated");
        case Morphology::flat:
            return sct("6041008", "Flat");
        case Morphology::mass:
            break;
    }
    return oursFor(nameOf(morphology));
}

Code codeOf(Attenuation attenuation)
{
    switch (attenuation) {
        case Attenuation::soft_tissue:
            return sct("87784001", "Soft tissue");
        case Attenuation::fat:
            return sct("256674009", "Fat");
        case Attenuation::mixed:
            break;
    }
    return oursFor(nameOf(attenuation));
}

Code codeOf(Confidence confidence)
{
    return oursFor(nameOf(confidence));
}

Code codeOf(ColonPart part)
{
    switch (part) {
        case ColonPart::rectum:
            return sct("34402009", "Rectum");
        case ColonPart::sigmoid:
            return sct("60184004", "Sigmoid colon");
        case ColonPart::descending:
            return sct("32622004", "Descending colon");
        case ColonPart::splenic_flexure:
            return sct("72592005", "Splenic flexure of colon");
        case ColonPart::transverse:
            return sct("485005", "Transverse colon");
        case ColonPart::hepatic_flexure:
            return sct("48338005", "Hepatic flexure of colon");
        case ColonPart::ascending:
            return sct("9040008", "Ascending colon");
        case ColonPart::caecum:
            return sct("32713005", "Cecum");
    }
    return oursFor(nameOf(part));
}

Code codeOf(ColonCategory category)
{
    switch (category) {
        case ColonCategory::c0:
            return dcm("112240", "C0 - Inadequate Study/Awaiting Prior Comparisons");
        case ColonCategory::c1:
            return dcm("112241", "C1 - Normal Colon or Benign Lesion");
        case ColonCategory::c3:
            return dcm("112243", "C3 - Polyp, Possibly Advanced Adenoma");
        case ColonCategory::c4:
            return dcm("112244", "C4 - Colonic Mass, Likely Malignant");
        case ColonCategory::c2a:  // of 2023; the standard knows one C2
        case ColonCategory::c2b:
            break;
    }
    return privateCode(nameOf(category), nameOf(category));
}

Code codeOf(ExtracolonicCategory category)
{
    return privateCode(valueFrom(nameOf(category)), nameOf(category));
}

Code codeOf(Distension distension)
{
    return oursFor(nameOf(distension));
}

Code codeOf(Grade grade)
{
    return oursFor(nameOf(grade));
}

}  // namespace vicon::report
