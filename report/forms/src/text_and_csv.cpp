#include "vicon/report/forms.h"

#include <array>
#include <charconv>
#include <sstream>

#include "vicon/report/comparison_statements.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/statements.h"

namespace vicon::report {
namespace {

constexpr std::size_t kTextWidth = 80, kTextIndent = 16;

/// Characters of a UTF-8 text; continuation bytes do not count.
std::size_t charactersOf(const std::string& text)
{
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// "Label:          text", broken between words; further lines are indented.
void addEntry(std::string& out, const std::string& label, const std::string& text)
{
    std::string head = label + ":";
    head.append(head.size() < kTextIndent ? kTextIndent - head.size() : 1, ' ');
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string current = head;
        bool empty = true;
        for (std::string word; words >> word;) {
            if (!empty && charactersOf(current) + 1 + charactersOf(word) > kTextWidth) {
                out += current + "\n";
                current = std::string(kTextIndent, ' ');
                empty = true;
            }
            current += (empty ? "" : " ") + word;
            empty = false;
        }
        out += current.substr(0, current.find_last_not_of(' ') + 1) + "\n";
        head = std::string(kTextIndent, ' ');
    }
}

void addEntries(std::string& out, const std::vector<Statement>& statements)
{
    for (const Statement& s : statements)
        addEntry(out, s.label, s.text);
}

/// The shortest text that is read back as the same number.
std::string figure(std::optional<double> value)
{
    if (!value)
        return {};
    std::array<char, 32> text{};
    const auto [end, problem] = std::to_chars(text.data(), text.data() + text.size(), *value);
    return {text.data(), problem == std::errc() ? end : text.data()};
}

template <class Enum>
std::string nameWhereGiven(const std::optional<Enum>& value)
{
    return value ? nameOf(*value) : "";
}

std::string csvField(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

std::string csvLine(const std::vector<std::string>& fields)
{
    std::string out;
    for (const std::string& field : fields)
        out += (&field == fields.data() ? "" : ",") + csvField(field);
    return out + "\r\n";
}

const std::vector<std::string> kCsvHeading = {"case",
                                              "finding",
                                              "kind",
                                              "morphology",
                                              "attenuation",
                                              "confidence",
                                              "size_mm",
                                              "size_from",
                                              "size_2d_mm",
                                              "size_3d_mm",
                                              "height_mm",
                                              "volume_ml",
                                              "narrows_lumen",
                                              "invades",
                                              "endoscope_about_mm",
                                              "endoscope_least_mm",
                                              "endoscope_most_mm",
                                              "marker",
                                              "scan",
                                              "position",
                                              "part",
                                              "clock_hour",
                                              "station_mm",
                                              "from_caecum_mm",
                                              "fraction",
                                              "x_mm",
                                              "y_mm",
                                              "z_mm",
                                              "sight_2d_mm",
                                              "sight_3d_mm",
                                              "mean_hu",
                                              "note"};

std::vector<std::string> findingFields(const ReadCase& read, const FindingWithFacts& f)
{
    const auto& [finding, facts] = f;
    const auto endoscope = [&facts = f.facts](double EndoscopeDistance::*which) {
        return facts.endoscope ? figure((*facts.endoscope).*which) : "";
    };
    return {read.record.id,
            finding.id,
            nameOf(finding.kind),
            nameWhereGiven(finding.morphology),
            nameWhereGiven(finding.attenuation),
            nameWhereGiven(finding.confidence),
            figure(facts.size_mm),
            facts.size_mm ? nameOf(facts.size_source) : "",
            figure(facts.size_2d_mm),
            figure(facts.size_3d_mm),
            figure(finding.height_mm),
            figure(finding.volume_ml),
            finding.narrows_lumen ? "yes" : "no",
            finding.invades ? "yes" : "no",
            endoscope(&EndoscopeDistance::about_mm),
            endoscope(&EndoscopeDistance::least_mm),
            endoscope(&EndoscopeDistance::most_mm)};
}

std::vector<std::string> sightFields(const ReadCase& read, const FindingSight& s)
{
    return {s.marker_id,
            s.scan_id,
            scanLabel(read, s.scan_id),
            nameWhereGiven(s.part),
            s.clock_hour ? std::to_string(*s.clock_hour) : "",
            figure(s.station_mm),
            figure(s.from_caecum_mm),
            figure(s.fraction),
            figure(s.position_mm.x),
            figure(s.position_mm.y),
            figure(s.position_mm.z),
            figure(s.size_2d_mm),
            figure(s.size_3d_mm),
            figure(s.mean_hu)};
}

}  // namespace

std::string asText(const ReadCase& read, const std::optional<ReportVersion>& version)
{
    std::string out = quantityOf(read) == Quantity::signal ? "MR COLONOGRAPHY REPORT\n" : "CT COLONOGRAPHY REPORT\n";
    out += stateWords(version) + "\n";
    if (const std::string amends = amendmentWords(version); !amends.empty())
        out += amends + "\n";
    if (!version || !version->isSigned())
        out += std::string(kDraftLine) + "\n";
    out += "\n";
    addEntries(out, patientStatements(read.record));
    addEntries(out, studyStatements(read.record));
    out += "\nIMPRESSION\n";
    addEntry(out, "Impression", impressionText(read));
    addEntries(out, categoryStatements(read));
    addEntry(out, "Recommended", recommendationText(read));
    out += "\nFINDINGS IN THE COLON\n";
    if (read.findings.empty())
        out += "none\n";
    for (const FindingWithFacts& f : read.findings) {
        addEntry(out, "Finding " + std::to_string(f.finding.number()), kindWords(f.finding));
        addEntries(out, findingStatements(read, f));
    }
    for (const Marker& marker : read.markers)
        if (std::find(read.loose_markers.begin(), read.loose_markers.end(), marker.id) != read.loose_markers.end())
            addEntry(
                out, "Marker " + marker.id,
                nameOf(marker.color) + ", belongs to no finding" + (marker.note.empty() ? "" : ": " + marker.note));
    if (const auto compared = comparisonStatements(read); !compared.empty()) {
        out += "\nCOMPARED WITH EARLIER REPORTS\n";
        addEntries(out, compared);
    }
    out += "\nOUTSIDE THE COLON\n";
    addEntries(out, extracolonicStatements(read));
    out += "\nSTUDY\n";
    addEntries(out, assessmentStatements(read));
    return out;
}

std::string asCsv(const ReadCase& read)
{
    std::string out = csvLine(kCsvHeading);
    for (const FindingWithFacts& f : read.findings) {
        const std::vector<std::string> of_finding = findingFields(read, f);
        std::vector<FindingSight> sights = f.facts.sights;
        const std::size_t of_sight = kCsvHeading.size() - of_finding.size() - 1;
        for (std::size_t n = 0; n < std::max<std::size_t>(sights.size(), 1); ++n) {
            std::vector<std::string> fields = of_finding;
            const auto more = n < sights.size() ? sightFields(read, sights[n]) : std::vector<std::string>(of_sight);
            fields.insert(fields.end(), more.begin(), more.end());
            fields.push_back(f.finding.note);
            out += csvLine(fields);
        }
    }
    return out;
}

}  // namespace vicon::report
