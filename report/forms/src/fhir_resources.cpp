// After HL7 FHIR R4 (4.0.1), https://hl7.org/fhir/R4/.
#include "fhir_resources.h"

#include "split.h"
#include "vicon/cases/printed.h"
#include "vicon/core/uid.h"
#include "vicon/report/finding_statements.h"

namespace vicon::report::fhir {
namespace {

std::string systemOf(const std::string& scheme)
{
    if (scheme == "SCT")
        return "http://snomed.info/sct";
    if (scheme == "LN")
        return "http://loinc.org";
    if (scheme == "DCM")
        return "http://dicom.nema.org/resources/ontology/DCM";
    return "urn:oid:" + uidFor("codes of " + scheme);
}

/// The parts of one group of a DICOM person name: family, given, middle, prefix, suffix.
std::vector<std::string> partsOf(const std::string& dicom_name)
{
    auto parts = split(dicom_name.substr(0, dicom_name.find('=')), '^');
    parts.resize(5);
    return parts;
}

json humanName(const std::string& dicom_name)
{
    json name;
    putWhereGiven(name, "text", printedName(dicom_name));
    const auto parts = partsOf(dicom_name);
    putWhereGiven(name, "family", parts[0]);
    for (const std::size_t given : {1, 2})
        if (!parts[given].empty())
            name["given"].push_back(parts[given]);
    if (!parts[3].empty())
        name["prefix"] = json::array({parts[3]});
    if (!parts[4].empty())
        name["suffix"] = json::array({parts[4]});
    return name;
}

json quantity(double value, const Code& unit)
{
    return {{"value", value},
            {"unit", unit.value == "1" ? unit.meaning : unit.value},
            {"system", "http://unitsofmeasure.org"},
            {"code", unit.value}};
}

std::string genderFrom(const std::string& dicom_sex)
{
    return dicom_sex == "M" ? "male" : dicom_sex == "F" ? "female" : dicom_sex == "O" ? "other" : "unknown";
}

json studyIdentifier(const std::string& study_uid)
{
    return {{"system", "urn:dicom:uid"}, {"value", "urn:oid:" + study_uid}};
}

json seriesOf(const ScanRecord& scan)
{
    json series{{"uid", scan.series.uid},
                {"number", scan.series.number},
                {"modality",
                 {{"system", "http://dicom.nema.org/resources/ontology/DCM"},
                  {"code", quantityOf(scan.series) == Quantity::signal ? "MR" : "CT"}}}};
    if (scan.series.number < 0)
        series.erase("number");
    putWhereGiven(series, "description", scan.series.description);
    return series;
}

}  // namespace

void putWhereGiven(json& resource, const char* key, const std::string& text)
{
    if (!text.empty())
        resource[key] = text;
}

json codeable(const Code& code)
{
    return {{"coding", {{{"system", systemOf(code.scheme)}, {"code", code.value}, {"display", code.meaning}}}},
            {"text", code.meaning}};
}

std::string urlOf(const ReadCase& read, const std::string& resource)
{
    return "urn:oid:" + uidFor("vicon fhir\n" + read.record.study.uid + "\n" + resource);
}

json reference(const std::string& url)
{
    return {{"reference", url}};
}

json otherStudy(const std::string& study_uid, const std::string& what)
{
    return {{"type", "ImagingStudy"}, {"identifier", studyIdentifier(study_uid)}, {"display", what}};
}

std::string dateFrom(const std::string& dicom_date)
{
    const std::string date = printedDate(dicom_date);
    return date == dicom_date ? "" : date;
}

json patient(const Patient& from)
{
    json out{{"resourceType", "Patient"}, {"gender", genderFrom(from.sex)}};
    if (!from.id.empty())
        out["identifier"] = {{{"value", from.id}}};
    if (const json name = humanName(from.name); !name.empty())
        out["name"] = json::array({name});
    putWhereGiven(out, "birthDate", dateFrom(from.birth_date));
    return out;
}

json imagingStudy(const ReadCase& read)
{
    const Study& study = read.record.study;
    json out{{"resourceType", "ImagingStudy"},
             {"status", "available"},
             {"identifier", json::array({studyIdentifier(study.uid)})},
             {"subject", reference(urlOf(read, "patient"))},
             {"procedureCode", json::array({codeable(procedureReported(quantityOf(read)))})}};
    if (!study.accession_number.empty())
        out["identifier"].push_back(
            {{"type", {{"coding", {{{"system", "http://terminology.hl7.org/CodeSystem/v2-0203"}, {"code", "ACSN"}}}}}},
             {"value", study.accession_number}});
    putWhereGiven(out, "started", dateFrom(study.date));
    putWhereGiven(out, "description", study.description);
    if (const std::string referrer = printedName(study.referring_physician); !referrer.empty())
        out["referrer"] = {{"display", referrer}};
    for (const ScanRecord& scan : read.scans)
        out["series"].push_back(seriesOf(scan));
    for (const Statement& lumen : lumenStatements(read))
        out["note"].push_back({{"text", "Lumen of " + lumen.text}});
    return out;
}

json observation(const Subject& subject, const Code& code, const CodedFacts& facts)
{
    json out{{"resourceType", "Observation"},
             {"status", subject.status},
             {"category",
              {{{"coding",
                 {{{"system", "http://terminology.hl7.org/CodeSystem/observation-category"}, {"code", "imaging"}}}}}}},
             {"code", codeable(code)},
             {"subject", reference(subject.patient_url)},
             {"derivedFrom", json::array({reference(subject.study_url)})}};
    putWhereGiven(out, "effectiveDateTime", subject.date);
    json components = json::array();
    for (const auto& [name, value, unit] : facts.numbers)
        components.push_back({{"code", codeable(name)}, {"valueQuantity", quantity(value, unit)}});
    for (const auto& [name, value] : facts.words)
        components.push_back({{"code", codeable(name)}, {"valueCodeableConcept", codeable(value)}});
    for (const auto& [name, text] : facts.texts)
        components.push_back({{"code", codeable(name)}, {"valueString", text}});
    if (!components.empty())
        out["component"] = components;
    return out;
}

}  // namespace vicon::report::fhir
