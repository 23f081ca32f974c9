#include "fhir_resources.h"
#include "vicon/report/comparison_statements.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/forms.h"

namespace vicon::report {
namespace {

using nlohmann::json;

/// As DiagnosticReport and Observation call it.
std::string statusOf(const std::optional<ReportVersion>& version, const char* of_draft)
{
    if (!version)
        return of_draft;
    return version->state == ReportState::amended ? "amended" : version->isSigned() ? "final" : "preliminary";
}

std::string asXhtml(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

class Bundle {
public:
    Bundle(const ReadCase& read, const std::optional<ReportVersion>& version)
        : read_(read),
          version_(version),
          subject_{fhir::urlOf(read, "patient"), fhir::urlOf(read, "study"), statusOf(version, "preliminary"),
                   fhir::dateFrom(read.record.study.date)}
    {
    }

    json make()
    {
        add("patient", fhir::patient(read_.record.patient));
        add("study", fhir::imagingStudy(read_));
        for (const FindingWithFacts& finding : read_.findings)
            addFinding(finding);
        addStudyFacts();
        addParts();
        addExtracolonic();
        add("report", diagnosticReport());
        json bundle{{"resourceType", "Bundle"}, {"type", "collection"}, {"entry", entries_}};
        if (version_)
            bundle["timestamp"] = version_->at;
        return bundle;
    }

private:
    const ReadCase& read_;
    const std::optional<ReportVersion>& version_;
    fhir::Subject subject_;
    json entries_ = json::array(), results_ = json::array();

    std::string add(const std::string& name, const json& resource)
    {
        std::string url = fhir::urlOf(read_, name);
        entries_.push_back({{"fullUrl", url}, {"resource", resource}});
        return url;
    }
    void addResult(const std::string& name, const json& resource)
    {
        results_.push_back(fhir::reference(add(name, resource)));
    }
    json observed(const Code& code, const CodedFacts& facts) { return fhir::observation(subject_, code, facts); }
    /// What is measured along a lumen that another program made says so.
    void putLumen(json& measured, const std::string& scan_id) const
    {
        if (const auto given = read_.given_lumens.find(scan_id); given != read_.given_lumens.end()) {
            measured["method"] = fhir::codeable(otherLumenConcept());
            measured["method"]["text"] = "in a lumen " + otherProgramsLumen(given->second);
        }
    }

    void addFinding(const FindingWithFacts& one)
    {
        const Finding& finding = one.finding;
        json whole = observed(dcm("121071", "Finding"), factsOfWhole(one));
        whole["valueCodeableConcept"] = fhir::codeable(codeOf(finding.kind));
        whole["identifier"] = {{{"system", "urn:ietf:rfc:3986"}, {"value", "urn:oid:" + trackingUid(read_, finding)}},
                               {{"value", trackingName(finding)}}};
        if (const FindingSight* lead = one.facts.lead(); lead && lead->part)
            whole["bodySite"] = fhir::codeable(codeOf(*lead->part));
        for (const FindingSight& sight : one.facts.sights)
            whole["hasMember"].push_back(fhir::reference(addSight(finding, sight)));
        int number = 0;
        for (const ComparedFinding& compared : confirmedComparisons(read_, finding))
            whole["hasMember"].push_back(fhir::reference(addComparison(finding, compared, ++number)));
        addResult(finding.id, whole);
    }
    std::string addSight(const Finding& finding, const FindingSight& sight)
    {
        json seen = observed(dcm("125007", "Measurement Group"), factsOfSight(sight));
        seen["identifier"] = {{{"value", trackingName(finding) + ", marker " + sight.marker_id}}};
        if (sight.part)
            seen["bodySite"] = fhir::codeable(codeOf(*sight.part));
        putLumen(seen, sight.scan_id);
        return add(finding.id + " " + sight.marker_id, seen);
    }
    std::string addComparison(const Finding& finding, const ComparedFinding& compared, int number)
    {
        const Comparison& said = compared.said;
        json then = observed(comparisonConcept(), factsOfComparison(compared));
        if (!said.prior_uid.empty())
            then["identifier"] = {{{"system", "urn:ietf:rfc:3986"}, {"value", "urn:oid:" + said.prior_uid}}};
        then["note"] = {{{"text", priorWords(said)}}};
        then["derivedFrom"].push_back(fhir::otherStudy(said.study_uid, "earlier examination"));
        return add(finding.id + " prior " + std::to_string(number), then);
    }
    void addStudyFacts()
    {
        const CodedFacts facts = factsOfStudy(read_.assessment);
        if (!facts.numbers.empty() || !facts.words.empty() || !facts.texts.empty())
            addResult("assessment", observed(procedureReported(quantityOf(read_)), facts));
    }
    void addParts()
    {
        for (const PartState& state : read_.parts) {
            json part = observed(privateCode("DISTENSION", "Distension"), {});
            part["valueCodeableConcept"] = fhir::codeable(codeOf(state.distension));
            part["bodySite"] = fhir::codeable(codeOf(state.part));
            part["note"] = {{{"text", scanLabel(read_, state.scan_id)}}};
            if (!state.by_reader)
                putLumen(part, state.scan_id);
            addResult("distension " + state.scan_id + " " + nameOf(state.part), part);
        }
    }
    void addExtracolonic()
    {
        int number = 0;
        for (const ExtracolonicFinding& said : read_.assessment.extracolonic) {
            json finding = observed(extracolonicConcept(), {});
            finding["valueCodeableConcept"] = fhir::codeable(codeOf(said.category));
            const std::string words =
                said.organ.empty() || said.text.empty() ? said.organ + said.text : said.organ + ": " + said.text;
            if (!words.empty())
                finding["note"] = {{{"text", words}}};
            addResult("extracolonic " + std::to_string(++number), finding);
        }
    }
    json diagnosticReport() const
    {
        json report{{"resourceType", "DiagnosticReport"},
                    {"status", statusOf(version_, "partial")},
                    {"identifier", {{{"system", "urn:ietf:rfc:3986"}, {"value", fhir::urlOf(read_, "report")}}}},
                    {"category",
                     {{{"coding", {{{"system", "http://terminology.hl7.org/CodeSystem/v2-0074"}, {"code", "RAD"}}}}}}},
                    {"code", fhir::codeable(procedureReported(quantityOf(read_)))},
                    {"subject", fhir::reference(subject_.patient_url)},
                    {"imagingStudy", json::array({fhir::reference(subject_.study_url)})}};
        fhir::putWhereGiven(report, "effectiveDateTime", subject_.date);
        fhir::putWhereGiven(report, "conclusion", impressionText(read_));
        report["text"] = {{"status", "generated"},
                          {"div", "<div xmlns=\"http://www.w3.org/1999/xhtml\"><pre>" +
                                      asXhtml(asText(read_, version_)) + "</pre></div>"}};
        if (const auto& category = read_.assessment.colon_category)
            report["conclusionCode"].push_back(fhir::codeable(codeOf(category->category)));
        if (!results_.empty())
            report["result"] = results_;
        if (version_) {
            report["issued"] = version_->at;
            report["resultsInterpreter"] = {{{"display", version_->person}}};
        }
        return report;
    }
};

}  // namespace

json asFhir(const ReadCase& read, const std::optional<ReportVersion>& version)
{
    return Bundle(read, version).make();
}

}  // namespace vicon::report
