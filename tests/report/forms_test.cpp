#include "vicon/report/forms.h"

#include <fstream>
#include <regex>
#include <sstream>

#include "pdf_fixture.h"
#include "vicon/core/file.h"
#include "vicon/report/statements.h"

namespace vicon::report {
namespace {

using testing::HasSubstr;

class Forms : public PdfWriter {
protected:
    Forms()
    {
        addMarkers(3);
        samples::addFinding(content_, 1);
        content_.read.findings[0].finding.note = "says \"why\", then\na line; größer";
        for (const MarkerEntry& entry : content_.markers)
            content_.read.markers.push_back(entry.marker);
    }
    const ReadCase& read() const { return content_.read; }
    /// Another program made the scan's lumen.
    void giveLumen()
    {
        content_.read.given_lumens["s1"] = {.form = "NRRD",
                                            .sha256 = std::string(64, 'b'),
                                            .label = 3,
                                            .gas_or_fluid = 0.98,
                                            .by = "anna",
                                            .at = "2026-11-25T12:00:00Z"};
    }
    /// The finding with one of an earlier report, as the reader confirmed; and with another that it is not.
    void compare()
    {
        ComparedFinding grown;
        grown.said = {.finding_id = "f1",
                      .report_uid = "1.2.3.71",
                      .report_class = "1.2.840.10008.5.1.4.1.1.88.34",
                      .study_uid = "1.2.3.70",
                      .prior_uid = "1.2.3.77",
                      .prior_name = "Finding 2",
                      .prior_what = "polyp",
                      .prior_place = "sigmoid"};
        grown.said.before = {.size_mm = 5.1, .from = "best plane", .date = "20240501"};
        grown.growth = {.years = 2.25,
                        .diameter_mm = Change{1.6, 0.4, 2.8},
                        .percent_a_year = Change{45, 12, 80},
                        .verdict = GrowthVerdict::grew};
        ComparedFinding other = grown;
        other.said.confirmed = false;
        content_.read.comparisons = {grown, other};
    }
};

TEST_F(Forms, AsTextSayWhatTheReportSaysInLinesOfEightyCharacters)
{
    content_.read.assessment.impression =
        "A polyp in the sigmoid, which stands on a fold and was seen in both positions.";
    const std::string text = asText(read(), {});
    for (const char* what : {"Draft, not signed", kDraftLine, "Adams, John Robert", "PID-4711", "1961-04-12",
                             "A polyp in the sigmoid", "Finding 1:      polyp, sessile", "6.7 mm (largest diameter",
                             "Marker m3:      green, belongs to no finding: note of m3", "größer"})
        EXPECT_THAT(text, HasSubstr(what));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 82u) << line;  // two bytes for an umlaut
        EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
    }
    const ReportVersion amended{.version = 2,
                                .state = ReportState::amended,
                                .replaces = 1,
                                .reason = "again",
                                .person = "anna",
                                .at = "2026-11-21T08:15:30Z"};
    EXPECT_THAT(asText(read(), amended), testing::AllOf(HasSubstr("Signed by anna"), HasSubstr("Amends version 1"),
                                                        testing::Not(HasSubstr("DRAFT"))));
}

TEST_F(Forms, AsCsvAreReadBackEqualByAnotherProgram)
{
    const auto file = folder_ / "findings.csv";
    std::ofstream(file) << asCsv(read());
    const std::string script =
        "import csv,sys,json; print(json.dumps(list(csv.DictReader(open(sys.argv[1], newline='', encoding='utf-8')))))";
    const auto result = support::runCommand("python3 -c \"" + script + "\" " + file.string());
    ASSERT_EQ(result.exit_code, 0) << result.output;
    const auto rows = nlohmann::json::parse(result.output);
    const FindingWithFacts& f = read().findings[0];
    ASSERT_EQ(rows.size(), 2u);
    for (std::size_t n = 0; n < 2; ++n) {
        const auto number = [&](const char* key) { return std::stod(rows[n].at(key).get<std::string>()); };
        const FindingSight& sight = f.facts.sights[n];
        EXPECT_EQ(rows[n]["finding"], "f1");
        EXPECT_EQ(rows[n]["marker"], sight.marker_id);
        EXPECT_EQ(rows[n]["note"], f.finding.note);
        EXPECT_EQ(number("size_mm"), *f.facts.size_mm);
        EXPECT_EQ(number("size_2d_mm"), *f.facts.size_2d_mm);
        EXPECT_EQ(number("sight_3d_mm"), *sight.size_3d_mm);
        EXPECT_EQ(number("station_mm"), sight.station_mm);
        EXPECT_EQ(number("fraction"), sight.fraction);
        EXPECT_EQ(number("x_mm"), sight.position_mm.x);
        EXPECT_EQ(number("z_mm"), sight.position_mm.z);
        EXPECT_EQ(number("clock_hour"), *sight.clock_hour);
        EXPECT_EQ(number("endoscope_least_mm"), f.facts.endoscope->least_mm);
        EXPECT_FALSE(rows[n].contains("null")) << "as many fields as headings";
    }
}

TEST_F(Forms, AsCsvListAFindingThatNoMarkerShows)
{
    content_.read.findings[0].facts = {};
    const std::string csv = asCsv(read());
    EXPECT_EQ(std::count(csv.begin(), csv.begin() + long(csv.find("\r\n", csv.find("\r\n") + 2)), ','), 2 * 31 + 1)
        << "the note holds one more";
}

/// What the forms say of a lumen that another program made.
constexpr const char* kOtherLumen =
    "made by another program: NRRD, label 3, SHA-256 bbbbbbbbbbbb..., given by anna on 2026-11-25T12:00:00Z";

TEST_F(Forms, AsTextNameALumenThatAnotherProgramMade)
{
    EXPECT_THAT(asText(read(), {}), testing::Not(HasSubstr("Lumen:")));
    giveLumen();
    std::string text = asText(read(), {});
    text = std::regex_replace(text, std::regex("\\s+"), " ");
    EXPECT_THAT(text, HasSubstr(std::string("Lumen: prone (series 3): ") + kOtherLumen));
}

ReportVersion signedVersion(ReportState state)
{
    return {.version = 1, .state = state, .person = "anna", .at = "2026-11-21T08:15:30Z", .digest = "d"};
}

/// What another program's parser makes of a message: its segments, fields and components.
nlohmann::json parsedHl7(const std::filesystem::path& file)
{
    const auto result = support::runCommand("/usr/bin/python3 " VICON_READ_HL7 " " + file.string());
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return nlohmann::json::parse(result.output);
}

class Fhir : public Forms {
protected:
    std::string faults(const nlohmann::json& bundle)
    {
        replaceFile(folder_ / "bundle.json", bundle.dump());
        return support::runCommand("/usr/bin/python3 " VICON_CHECK_FHIR " < " + (folder_ / "bundle.json").string())
            .output;
    }
    static const nlohmann::json& only(const nlohmann::json& bundle, const std::string& type)
    {
        for (const auto& entry : bundle["entry"])
            if (entry["resource"]["resourceType"] == type)
                return entry["resource"];
        throw std::runtime_error("no " + type);
    }
};

TEST_F(Fhir, ACaseIsAValidBundleWithEveryNumber)
{
    samples::makeNormal(content_);
    content_.read.record.study.uid = "1.2.3";
    content_.read.scans.at(0).series.uid = "1.2.3.4";
    content_.read.assessment.extracolonic = {{"liver", "cyst, < 10 mm & simple", ExtracolonicCategory::e3}};
    const auto bundle = asFhir(read(), signedVersion(ReportState::final));
    EXPECT_EQ(faults(bundle), "");
    const auto& report = only(bundle, "DiagnosticReport");
    EXPECT_EQ(report["status"], "final");
    EXPECT_EQ(report["issued"], "2026-11-21T08:15:30Z");
    EXPECT_EQ(only(bundle, "Patient")["name"][0]["given"], nlohmann::json({"John Robert"}));
    EXPECT_EQ(only(bundle, "Patient")["birthDate"], "1961-04-12");
    EXPECT_EQ(only(bundle, "ImagingStudy")["identifier"][0]["value"], "urn:oid:1.2.3");
    const std::string text = bundle.dump();
    for (const FindingSight& sight : read().findings[0].facts.sights)
        for (const double value : {sight.station_mm, sight.from_caecum_mm, sight.fraction, *sight.size_3d_mm})
            EXPECT_THAT(text, HasSubstr("\"value\":" + nlohmann::json(value).dump())) << sight.marker_id;
    EXPECT_THAT(text, testing::AllOf(HasSubstr("größer"), HasSubstr("liver: cyst, < 10 mm & simple")));
}

TEST_F(Fhir, ACheckAgainstThePublishedSchemaFindsFaults)
{
    auto bundle = asFhir(read(), signedVersion(ReportState::final));
    for (auto& entry : bundle["entry"]) {
        auto& resource = entry["resource"];
        if (resource["resourceType"] == "ImagingStudy")
            resource["status"] = "gone";
        if (resource["resourceType"] == "DiagnosticReport")
            resource.erase("status");
        if (resource["resourceType"] == "Patient")
            resource["height"] = 1.8;
    }
    EXPECT_THAT(faults(bundle), testing::AllOf(HasSubstr("'gone' is not one of"), HasSubstr("lacks status"),
                                               HasSubstr("'height' was unexpected")));
}

TEST_F(Fhir, AConfirmedPriorFindingAndItsGrowthAreMembersOfTheFinding)
{
    compare();
    content_.read.scans.at(0).series.uid = "1.2.3.4";
    const auto bundle = asFhir(read(), signedVersion(ReportState::final));
    EXPECT_EQ(faults(bundle), "");
    int told = 0;
    for (const auto& entry : bundle["entry"]) {
        const auto& then = entry["resource"];
        if (then["resourceType"] != "Observation" || then["code"]["coding"][0]["code"] != "COMPARISON")
            continue;
        ++told;
        EXPECT_EQ(then["identifier"][0]["value"], "urn:oid:1.2.3.77");
        EXPECT_EQ(then["derivedFrom"][1]["identifier"]["value"], "urn:oid:1.2.3.70");
        EXPECT_THAT(then["note"][0]["text"].get<std::string>(), HasSubstr("polyp of 5.1 mm in the sigmoid on 2024-05"));
        for (const char* number : {"\"value\":5.1}", "\"value\":1.6}", "\"value\":2.25}"})
            EXPECT_THAT(then["component"].dump(), HasSubstr(number));
        EXPECT_THAT(then["component"].dump(), HasSubstr("grew"));
        EXPECT_THAT(bundle.dump(), HasSubstr("{\"reference\":" + entry["fullUrl"].dump() + "}"));
    }
    EXPECT_EQ(told, 1) << "the one that was confirmed";
}

TEST_F(Fhir, WhatIsMeasuredInALumenThatAnotherProgramMadeSaysSo)
{
    samples::makeNormal(content_);
    content_.read.record.study.uid = "1.2.3";
    content_.read.scans.at(0).series.uid = "1.2.3.4";
    content_.read.parts.at(0).by_reader = true;
    const auto methods = [](const nlohmann::json& bundle) {
        std::map<std::string, int> told;
        for (const auto& entry : bundle["entry"])
            if (const auto& one = entry["resource"]; one.contains("method")) {
                EXPECT_EQ(one["method"]["coding"][0]["code"], "OTHER_LUMEN");
                EXPECT_EQ(one["method"]["text"], std::string("in a lumen ") + kOtherLumen);
                ++told[one["code"]["text"].get<std::string>()];
            }
        return told;
    };
    EXPECT_THAT(methods(asFhir(read(), {})), testing::IsEmpty());
    giveLumen();
    const auto bundle = asFhir(read(), signedVersion(ReportState::final));
    EXPECT_EQ(faults(bundle), "");
    EXPECT_EQ(only(bundle, "ImagingStudy")["note"][0]["text"],
              std::string("Lumen of prone (series 3): ") + kOtherLumen);
    auto told = methods(bundle);
    EXPECT_EQ(told["Measurement Group"], 2);
    EXPECT_EQ(told["Distension"], 7) << "but for the one that the reader told";
}

TEST_F(Fhir, ACaseOfWhichLittleIsKnownIsValid)
{
    ReadCase bare;
    bare.record.study.uid = "1.2.3";
    const auto bundle = asFhir(bare, {});
    EXPECT_EQ(faults(bundle), "");
    EXPECT_EQ(only(bundle, "DiagnosticReport")["status"], "partial");
}

TEST_F(Fhir, AResourceKeepsItsUrlWhenTheReportIsAmended)
{
    const auto first = asFhir(read(), signedVersion(ReportState::final));
    const auto then = asFhir(read(), signedVersion(ReportState::amended));
    EXPECT_EQ(only(then, "DiagnosticReport")["status"], "amended");
    for (std::size_t n = 0; n < first["entry"].size(); ++n)
        EXPECT_EQ(first["entry"][n]["fullUrl"], then["entry"][n]["fullUrl"]);
}

TEST_F(Forms, AsHl7AreReadBackByAnotherProgram)
{
    content_.read.record.patient.name = "Yamada^Tarou^^Dr=山田^太郎";
    content_.read.record.study.referring_physician = "Weiss^Anna^^Dr=x";
    content_.read.assessment.impression = "one | two ^ three & four ~ five \\ six\nseven";
    replaceFile(folder_ / "m.hl7", asHl7(read(), signedVersion(ReportState::amended)));
    const auto message = parsedHl7(folder_ / "m.hl7");
    EXPECT_EQ(message["PID"][0][5], "Yamada^Tarou^^^Dr^^L^A~山田^太郎^^^^^L^I");
    EXPECT_EQ(message["PID"][0][7], "19610412");
    EXPECT_EQ(message["MSH"][0][18], "UNICODE UTF-8");
    EXPECT_EQ(message["OBR"][0][25], "C");
    EXPECT_EQ(message["OBR"][0][16], "^Weiss^Anna^^^Dr^^^^L^^^^^A") << "name type and representation of XCN";
    std::map<std::string, std::string> said;
    for (const auto& observation : message["OBX"]) {
        const std::string code = observation[3], name = code.substr(0, code.find('^'));
        said[name + "/" + std::string(observation[4])] += std::string(observation[5]) + "\n";
        EXPECT_EQ(observation[11], "C");
    }
    EXPECT_EQ(said["19005-8/"], "one | two ^ three & four ~ five \\ six\nseven\n");
    EXPECT_EQ(said["18782-3/"], asText(read(), signedVersion(ReportState::amended)));
    const FindingFacts& facts = read().findings[0].facts;
    EXPECT_EQ(std::stod(said["373197004/1"]), *facts.size_mm);
    EXPECT_NEAR(std::stod(said["112233/1.2"]), facts.sights[1].station_mm, 1e-5);
}

TEST_F(Forms, AsHl7HoldNothingThatEndsAMessageAndAreToldApartByTheirId)
{
    const auto idOf = [&](const std::string& message) {
        std::istringstream fields(message);
        std::string field;
        for (int n = 0; n < 10; ++n)
            std::getline(fields, field, '|');
        return field;
    };
    const std::string first = asHl7(read(), std::nullopt);
    content_.read.assessment.impression = "a block ends:\x1c\r and begins:\x0b";
    const std::string then = asHl7(read(), std::nullopt);
    EXPECT_EQ(then.find_first_of("\x0b\x1c"), std::string::npos);
    EXPECT_NE(idOf(first), idOf(then)) << "else the second draft is dropped as the first one again";
    EXPECT_EQ(idOf(then), idOf(asHl7(read(), std::nullopt)));
    EXPECT_EQ(idOf(then).size(), 20U);
}

TEST_F(Forms, AsHl7NameALumenThatAnotherProgramMadeAsAnObservationOfItsOwn)
{
    const auto told = [&] {
        replaceFile(folder_ / "m.hl7", asHl7(read(), signedVersion(ReportState::final)));
        std::vector<std::string> values;
        const auto message = parsedHl7(folder_ / "m.hl7");
        for (const auto& observation : message["OBX"])
            if (observation[3] == "OTHER_LUMEN^Lumen made by another program^L") {
                EXPECT_EQ(observation[2], "ST");
                values.push_back(observation[5]);
            }
        return values;
    };
    EXPECT_THAT(told(), testing::IsEmpty());
    giveLumen();
    EXPECT_THAT(told(), testing::ElementsAre(std::string("prone (series 3): ") + kOtherLumen));
}

TEST_F(Forms, AsHl7TellWhatAFindingWasInAnEarlierReport)
{
    compare();
    replaceFile(folder_ / "m.hl7", asHl7(read(), signedVersion(ReportState::final)));
    std::map<std::string, std::string> said;
    const auto message = parsedHl7(folder_ / "m.hl7");
    for (const auto& observation : message["OBX"]) {
        const std::string code = observation[3];
        said[code.substr(0, code.find('^')) + "/" + std::string(observation[4])] += std::string(observation[5]) + "\n";
    }
    EXPECT_THAT(said["COMPARISON/1.3"], HasSubstr("polyp of 5.1 mm in the sigmoid")) << "after its two sights";
    EXPECT_EQ(said["PRIOR_SIZE/1.3"], "5.1\n");
    EXPECT_EQ(said["DIAMETER_CHANGE/1.3"], "1.6\n");
    EXPECT_EQ(said["VOLUME_A_YEAR_MOST/1.3"], "80\n");
    EXPECT_THAT(said["GROWTH/1.3"], HasSubstr("grew"));
    EXPECT_FALSE(said.contains("COMPARISON/1.4")) << "what was rejected";
}

}  // namespace
}  // namespace vicon::report
