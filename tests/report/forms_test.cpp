#include "vicon/report/forms.h"

#include <fstream>

#include "pdf_fixture.h"
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

}  // namespace
}  // namespace vicon::report
