#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/report/coded_findings.h"

namespace vicon::report::fhir {

using nlohmann::json;

/// FHIR knows no empty string: adds only what is given.
void putWhereGiven(json& resource, const char* key, const std::string& text);

/// A CodeableConcept. A code of ours has a system of ours.
json codeable(const Code& code);
/// The URL of a case's resource, the same in every version of the report: "urn:oid:2.25...".
std::string urlOf(const ReadCase& read, const std::string& resource);
json reference(const std::string& url);
/// A reference to a study that is not in the bundle.
json otherStudy(const std::string& study_uid, const std::string& what);

/// A DICOM date ("19610412") as FHIR writes it; empty for what is no date.
std::string dateFrom(const std::string& dicom_date);

json patient(const Patient& patient);
json imagingStudy(const ReadCase& read);

/// Who and what an Observation is about.
struct Subject {
    std::string patient_url, study_url, status, date;
};
/// With its facts as components.
json observation(const Subject& subject, const Code& code, const CodedFacts& facts);

}  // namespace vicon::report::fhir
