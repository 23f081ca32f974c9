// After HL7 version 2.5.1, chapters 2 (encoding), 3 (PID) and 7 (ORU^R01).
#include <array>
#include <cstdio>
#include <map>
#include <sstream>

#include "split.h"
#include "vicon/core/uid.h"
#include "vicon/report/coded_findings.h"
#include "vicon/report/comparison_statements.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/forms.h"

namespace vicon::report {
namespace {

/// A text within a field: delimiters escaped, lines broken as formatted text has it.
std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text)
        switch (c) {
            case '|':
                out += "\\F\\";
                break;
            case '^':
                out += "\\S\\";
                break;
            case '&':
                out += "\\T\\";
                break;
            case '~':
                out += "\\R\\";
                break;
            case '\\':
                out += "\\E\\";
                break;
            case '\n':
                out += "\\.br\\";
                break;
            case '\r':
                break;
            default:  // control characters are none of a message's, and some end it on its way (MLLP)
                out += c >= 0 && c < ' ' ? ' ' : c;
        }
    return out;
}

/// "Family^Given^Middle^Prefix^Suffix=...=..." as XPN: one repetition for each way that it is written.
std::string nameFrom(const std::string& dicom_name)
{
    std::string out;
    const std::string kinds = "AIP";  // alphabetic, ideographic, phonetic
    const auto groups = split(dicom_name, '=');
    for (std::size_t n = 0; n < std::min(groups.size(), kinds.size()); ++n) {
        auto parts = split(groups[n], '^');
        parts.resize(5);
        if (groups[n].empty())
            continue;
        out += out.empty() ? "" : "~";
        for (const std::size_t part : {0, 1, 2, 4, 3})
            out += escaped(parts[part]) + "^";
        out += "^L^" + kinds.substr(n, 1);
    }
    return out;
}

/// The same name, as it is written in letters, as XCN without an identifier.
std::string providerFrom(const std::string& dicom_name)
{
    const std::string letters = dicom_name.substr(0, dicom_name.find('='));
    if (letters.empty())
        return "";
    auto parts = split(letters, '^');
    parts.resize(5);
    std::string out;
    for (const std::size_t part : {0, 1, 2, 4, 3})
        out += "^" + escaped(parts[part]);
    return out + "^^^^L^^^^^A";  // name type and representation are components 10 and 15
}

std::string codeField(const Code& code)
{
    return escaped(code.value) + "^" + escaped(code.meaning) + "^" +
           (code.scheme == kPrivateScheme ? "L" : code.scheme);
}

/// "2026-11-23T20:15:30Z" as "20261123201530+0000".
std::string timeFrom(const std::string& utc)
{
    std::string digits;
    for (const char c : utc)
        if (c >= '0' && c <= '9')
            digits += c;
    return digits.empty() ? "" : digits + "+0000";
}

/// Type NM has 16 characters at most.
std::string numberFrom(double value)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", value);
    return text.data();
}

/// Result status, of OBR-25 and OBX-11.
std::string statusOf(const std::optional<ReportVersion>& version)
{
    if (!version)
        return "R";  // not verified
    return version->state == ReportState::amended ? "C" : version->isSigned() ? "F" : "P";
}

class Message {
public:
    Message(const ReadCase& read, const std::optional<ReportVersion>& version)
        : read_(read), version_(version), status_(statusOf(version))
    {
    }

    std::string make()
    {
        addHeader();
        addPatient();
        addOrder();
        addText(loinc("18782-3", "Radiology Study observation (narrative)"), asText(read_, version_));
        addText(loinc("19005-8", "Radiology Imaging study [Impression] (narrative)"), impressionText(read_));
        addFacts(factsOfStudy(read_.assessment), "");
        for (const Statement& lumen : lumenStatements(read_))
            observe("ST", otherLumenConcept(), "", escaped(lumen.text));
        for (const FindingWithFacts& finding : read_.findings)
            addFinding(finding);
        return out_;
    }

private:
    const ReadCase& read_;
    const std::optional<ReportVersion>& version_;
    const std::string status_;
    std::string out_;
    int observations_ = 0;

    /// @param fields from the first one; numbered as the standard does
    void add(const std::string& segment, const std::map<int, std::string>& fields)
    {
        out_ += segment;
        for (int n = 1; n <= fields.rbegin()->first; ++n)
            out_ += "|" + (fields.contains(n) ? fields.at(n) : "");
        out_ += "\r";
    }
    void addHeader()
    {
        const std::string at = version_ ? timeFrom(version_->at) : timeFrom(read_.record.created);
        const std::string id = uidFor("vicon hl7\n" + read_.record.study.uid + "\n" +
                                      (version_ ? version_->digest : "draft\n" + asText(read_, version_)));
        out_ = "MSH|^~\\&|VICON|" + escaped(read_.record.study.institution) + "|||" + at + "||ORU^R01^ORU_R01|" +
               id.substr(id.size() - 20) + "|P|2.5.1||||||UNICODE UTF-8\r";
    }
    void addPatient()
    {
        const Patient& patient = read_.record.patient;
        add("PID", {{1, "1"},
                    {3, escaped(patient.id)},
                    {5, nameFrom(patient.name)},
                    {7, escaped(patient.birth_date)},
                    {8, patient.sex.empty() ? "U" : escaped(patient.sex)}});
    }
    void addOrder()
    {
        const Study& study = read_.record.study;
        add("OBR", {{1, "1"},
                    {3, escaped(study.accession_number)},
                    {4, codeField(procedureReported(quantityOf(read_)))},
                    {7, escaped(study.date + study.time.substr(0, study.time.find('.')))},
                    {16, providerFrom(study.referring_physician)},
                    {22, version_ ? timeFrom(version_->at) : ""},
                    {24, "RAD"},
                    {25, status_},
                    {32, version_ ? escaped(version_->person) : ""}});
    }
    void observe(const std::string& type, const Code& what, const std::string& about, const std::string& value,
                 const Code* unit = nullptr)
    {
        add("OBX", {{1, std::to_string(++observations_)},
                    {2, type},
                    {3, codeField(what)},
                    {4, about},
                    {5, value},
                    {6, unit ? escaped(unit->value) + "^" + escaped(unit->meaning) + "^UCUM" : ""},
                    {11, status_}});
    }
    void addText(const Code& what, const std::string& text)
    {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            observe("TX", what, "", escaped(line));
    }
    void addFacts(const CodedFacts& facts, const std::string& about)
    {
        for (const auto& [name, value, unit] : facts.numbers)
            observe("NM", name, about, numberFrom(value), &unit);
        for (const auto& [name, value] : facts.words)
            observe("CWE", name, about, codeField(value));
        for (const auto& [name, text] : facts.texts)
            observe("ST", name, about, escaped(text));
    }
    void addFinding(const FindingWithFacts& one)
    {
        const std::string about = std::to_string(one.finding.number());
        observe("CWE", dcm("121071", "Finding"), about, codeField(codeOf(one.finding.kind)));
        addFacts(factsOfWhole(one), about);
        for (std::size_t n = 0; n < one.facts.sights.size(); ++n) {
            const FindingSight& sight = one.facts.sights[n];
            const std::string of_sight = about + "." + std::to_string(n + 1);
            observe("ST", privateCode("MARKER", "Marker"), of_sight, escaped(sight.marker_id));
            if (sight.part)
                observe("CWE", findingSiteConcept(), of_sight, codeField(codeOf(*sight.part)));
            addFacts(factsOfSight(sight), of_sight);
        }
        std::size_t below = one.facts.sights.size();
        for (const ComparedFinding& compared : confirmedComparisons(read_, one.finding)) {
            const std::string of_prior = about + "." + std::to_string(++below);
            observe("ST", comparisonConcept(), of_prior, escaped(priorWords(compared.said)));
            addFacts(factsOfComparison(compared), of_prior);
        }
    }
};

}  // namespace

std::string asHl7(const ReadCase& read, const std::optional<ReportVersion>& version)
{
    return Message(read, version).make();
}

}  // namespace vicon::report
