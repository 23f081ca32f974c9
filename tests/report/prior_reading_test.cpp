// Measurement reports read back: VICON's own say what the case said, other makers' what is in them.
#include "vicon/report/prior_reading.h"

#include <gmock/gmock.h>

#include <map>
#include <regex>

#include "dicom_writer.h"
#include "store_fixture.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/core/error.h"
#include "vicon/ingest/structured_report.h"
#include "vicon/report/report_objects.h"

namespace vicon::test {

namespace fs = std::filesystem;

namespace {

using nlohmann::json;
using testing::HasSubstr;

const ReportVersion kVersion{.version = 1,
                             .state = ReportState::final,
                             .person = "reader",
                             .at = "2026-11-23T20:15:30Z",
                             .software = "0.1.0",
                             .digest = "d"};

class PriorReading : public StoreFixture {
protected:
    std::string case_id_;

    void SetUp() override
    {
        import(writeSeries(folder / "in", {.patient_name = "Müller^Zoë=山田"}));
        case_id_ = store.cases().at(0).id;
    }
    Marker mark(Point3 at, double part_of_colon)
    {
        Marker marker{.scan_id = onlyScan().id, .position_mm = at};
        marker.station_mm = 1600 * part_of_colon + 1.0 / 3;
        marker.from_caecum_mm = 1600 - marker.station_mm;
        marker.fraction = part_of_colon;
        marker.part = ColonPart::sigmoid;
        marker.density = DensitySample{.centre_mm = at, .voxels = 40, .mean_hu = 41.125};
        MarkerSize size{.straight_mm = 7.3};
        size.plane = PlaneSize{.diameter_mm = 7.1};
        size.polyp =
            PolypSize{.diameter_mm = 7.3, .least_mm = 6.6, .most_mm = 8.1, .height_mm = 3.2, .volume_ml = 0.17};
        size.polyp->volume_least_ml = 0.15;
        size.polyp->volume_most_ml = 0.19;
        marker.size = size;
        return store.saveMarker(case_id_, marker);
    }
    void add(const Finding& finding) { editFindings(store, case_id_, {{std::nullopt, finding}}); }
    void assess()
    {
        Assessment said;
        said.indication = "Blut im Stuhl; \"größer\" als 2024";
        said.technique = "supine and prone\nno contrast";
        said.comparison = "CT of 2024";
        said.impression = "one polyp";
        said.recommendation = "colonoscopy";
        said.preparation = Grade::good;
        said.tagging = Grade::fair;
        said.priors_awaited = said.extracolonic_limited = true;
        said.dose_mgy_cm = 312.5;
        said.reading_minutes = 11.25;
        said.coverage_percent = 94.1;
        said.extracolonic = {{"kidney", "cyst", ExtracolonicCategory::e1}, {"", "node", ExtracolonicCategory::e3}};
        said.colon_category = {ColonCategory::c2a, "not awaited any more", ColonCategory::c0};
        said.extracolonic_category = {ExtracolonicCategory::e3, "", ExtracolonicCategory::e3};
        said.distension = {{onlyScan().id, ColonPart::sigmoid, Distension::limited}};
        saveAssessment(store, case_id_, assessmentOf(store, case_id_), said);
    }
    fs::path writeReport(const ReportVersion& version = kVersion)
    {
        const fs::path out = folder / ("out" + std::to_string(version.version));
        fs::create_directories(out);
        const ReadCase read = readCase(store, case_id_);
        report::ShownScans scans(store, read);
        report::writeReportObjects(scans, {read, version, std::nullopt, "pdf"}, out);
        return out / ("version-" + std::to_string(version.version) + "-sr.dcm");
    }
};

/// What is said, with the positions apart: the report has them as single-precision numbers.
json comparable(PriorReport report, std::vector<Point3>& positions)
{
    report.case_id.clear();
    for (PriorFinding& finding : report.findings)
        for (PriorSight& sight : finding.sights) {
            if (sight.position_mm)
                positions.push_back(*sight.position_mm);
            sight.position_mm.reset();
            sight.image_uid.clear();  // which slice shows it follows from the images
        }
    json out = toJson(report);
    out["patient"] = report.patient;
    return out;
}

TEST_F(PriorReading, LosesNothingOfACaseOnTheWayThroughAStructuredReport)
{
    const Marker a = mark({-10, -5, -12}, 0.25), b = mark({-2, -8.5, -4}, 0.27), c = mark({-11, -3, -16}, 0.75);
    add({.kind = FindingKind::polyp,
         .markers = {a.id, b.id},
         .morphology = Morphology::flat,
         .attenuation = Attenuation::fat,
         .confidence = Confidence::low,
         .height_mm = 2.125,
         .volume_ml = 0.1,
         .narrows_lumen = true,
         .note = "größer als 2024"});
    add({.kind = FindingKind::diverticular_stricture, .markers = {c.id}, .read_size_mm = 31.4, .invades = true});
    assess();
    const auto document = ingest::readStructuredReport(writeReport());
    EXPECT_TRUE(report::isMeasurementReport(document));
    const PriorReport back = report::priorFrom(document), own = report::priorFrom(readCase(store, case_id_), kVersion);
    std::vector<Point3> positions, expected;
    EXPECT_EQ(comparable(back, positions), comparable(own, expected));
    ASSERT_EQ(positions.size(), 3u);
    for (std::size_t n = 0; n < positions.size(); ++n)
        EXPECT_LT(distance(positions[n], expected[n]), 1e-4);
    EXPECT_EQ(back.findings.at(0).sights.at(0).image_uid, SeriesSpec{}.sopUid(4)) << "z = -12 is the fifth slice";
    EXPECT_TRUE(back.not_read.empty()) << back.not_read.front();
}

/// Name and value of every number of a report.
void addNumbers(const ContentItem& item, std::multimap<std::string, double>& numbers)
{
    if (item.number)
        numbers.emplace(item.name.meaning, *item.number);
    for (const ContentItem& child : item.children)
        addNumbers(child, numbers);
}

TEST_F(PriorReading, GivesTheNumbersThatDcmtkReads)
{
    const Marker a = mark({-10, -5, -12}, 1.0 / 7), b = mark({-2, -8.5, -4}, 0.27);
    add({.markers = {a.id, b.id}, .height_mm = 2.125, .volume_ml = 1.0 / 3});
    assess();
    const fs::path sr = writeReport();
    std::multimap<std::string, double> ours, theirs;
    addNumbers(ingest::readStructuredReport(sr).root, ours);
    const std::string dump = support::runCommand("dsrdump -Ph +Pl " + sr.string()).output;
    const std::regex number(R"re(NUM:\(,,"([^"]*)"\)="([^"]*)")re");
    for (std::sregex_iterator at(dump.begin(), dump.end(), number), end; at != end; ++at)
        theirs.emplace((*at)[1], std::stod((*at)[2]));
    ASSERT_EQ(ours.size(), theirs.size()) << dump;
    ASSERT_GE(ours.size(), 30u);
    for (const auto& [name, value] : ours) {
        const auto [from, to] = theirs.equal_range(name);
        EXPECT_TRUE(std::any_of(
            from, to,
            [&, value = value](const auto& one) { return std::abs(one.second - value) <= 1e-12 * std::abs(value); }))
            << name << " " << value;
    }
}

TEST_F(PriorReading, IsOfANormalStudyToo)
{
    assess();
    const PriorReport back = report::priorFrom(ingest::readStructuredReport(writeReport()));
    EXPECT_TRUE(back.findings.empty());
    EXPECT_EQ(back.said.colon_category->category, ColonCategory::c2a);
    EXPECT_THAT(inBrief(back), HasSubstr("no findings, C2a"));
}

TEST_F(PriorReading, KeepsAReportThatIsImportedForItsPatient)
{
    const Marker a = mark({-10, -5, -12}, 0.25);
    add({.markers = {a.id}});
    const fs::path sr = writeReport();
    CaseStore other(folder / "other");
    const auto import = [&](const fs::path& file) { return ingest::importPaths(other, {file}, options, quiet); };
    const auto first = import(sr), again = import(sr);
    EXPECT_TRUE(says(first, ingest::ImportLine::Kind::stored, "measurement report by VICON")) << lines(first);
    EXPECT_TRUE(says(again, ingest::ImportLine::Kind::unchanged, "measurement report")) << lines(again);
    EXPECT_TRUE(first.anythingStored() && again.anythingStored());
    ASSERT_EQ(keptReportsOf(other, "P1").size(), 1u);
    const KeptReport kept = keptReportsOf(other, "P1").front();
    EXPECT_EQ(readFile(keptReportsFolder(other) / kept.file), readFile(sr)) << "byte for byte";
    EXPECT_EQ(kept.patient.name, "Müller^Zoë=山田");
    EXPECT_TRUE(other.cases().empty());
    // Lost or damaged, it is mended when it comes again, also with another meta header.
    fs::remove(keptReportsFolder(other) / kept.file);
    ASSERT_EQ(support::runCommand("dcmconv +ti " + sr.string() + " " + sr.string()).exit_code, 0);
    EXPECT_TRUE(says(import(sr), ingest::ImportLine::Kind::stored, "measurement report"));
    EXPECT_EQ(readFile(keptReportsFolder(other) / kept.file), readFile(sr));
    ASSERT_EQ(keptReportsOf(other, "P1").size(), 1u);
    EXPECT_EQ(keptReportsOf(other, "P1").front().sha256, sha256OfFile(sr));
}

TEST_F(PriorReading, IsRefusedInOneLineWhereTheReportIsDamaged)
{
    const Marker a = mark({-10, -5, -12}, 0.25);
    add({.markers = {a.id}});
    assess();
    const std::string whole = readFile(writeReport());
    CaseStore other(folder / "other");
    const fs::path file = folder / "damaged.dcm";
    std::uint32_t random = 7;
    for (int n = 0; n < 40; ++n) {
        std::string bytes = whole;
        random = random * 1664525 + 1013904223;
        if (n % 3 == 0)
            bytes.resize(bytes.size() * (random >> 8) / 0xFFFFFF);  // breaks off
        for (int k = 0; k < 8 && n % 3 != 0; ++k) {                 // bits flip, behind what says that it is DICOM
            random = random * 1664525 + 1013904223;
            bytes[400 + (random >> 4) % (bytes.size() - 400)] ^= char(1 << (random % 8));
        }
        replaceFile(file, bytes);
        const auto report = ingest::importPaths(other, {file}, options, quiet);
        EXPECT_EQ(report.lines.size(), 1u) << n << "\n" << lines(report);
        for (const KeptReport& kept : keptReportsOf(other, "P1"))  // what was taken can be read
            EXPECT_NO_THROW(report::priorFrom(ingest::readStructuredReport(keptReportsFolder(other) / kept.file)));
    }
}

/// Reports that pydicom writes: what other makers do that VICON does not.
class ForeignReports : public StoreFixture {
protected:
    void SetUp() override
    {
        const auto made = support::runCommand("/usr/bin/python3 " VICON_MAKE_FOREIGN " " + (folder / "sr").string());
        ASSERT_EQ(made.exit_code, 0) << made.output;
    }
    PriorReport read(const std::string& name)
    {
        return report::priorFrom(ingest::readStructuredReport(folder / "sr" / (name + ".dcm")));
    }
};

TEST_F(ForeignReports, SayWhatIsThereAndWhatCouldNotBeRead)
{
    const PriorReport prior = read("other-maker");
    EXPECT_EQ(prior.patient.name, "Müller^Zoë") << "Latin-1";
    EXPECT_EQ(prior.maker, "Acme Workstation 5");
    EXPECT_EQ(prior.when(), "20230504");
    EXPECT_FALSE(prior.is_signed);
    ASSERT_EQ(prior.findings.size(), 3u);
    const PriorFinding& polyp = prior.findings[0];
    EXPECT_EQ(polyp.kind, FindingKind::polyp) << "by its words: " << polyp.what;
    EXPECT_EQ(polyp.lead()->part, ColonPart::sigmoid) << "by an older code's words";
    EXPECT_DOUBLE_EQ(*polyp.size_mm, 8.5) << "0.85 cm";
    EXPECT_EQ(polyp.size_from, "Long Axis");
    EXPECT_DOUBLE_EQ(*polyp.volume_ml, 0.25) << "250 mm3";
    EXPECT_EQ(polyp.lead()->series_uid, "1.2.3.4.1");
    ASSERT_TRUE(polyp.lead()->position_mm);
    EXPECT_NEAR(polyp.lead()->position_mm->x, 10, 1e-5) << "the middle of the outline";
    ASSERT_EQ(polyp.others.size(), 2u);
    EXPECT_EQ(polyp.others[1].name, "Short Axis");
    EXPECT_EQ(prior.findings[1].lead()->site, "Structure of left kidney");
    EXPECT_FALSE(prior.findings[1].lead()->part || prior.findings[1].kind);
    EXPECT_EQ(prior.findings[2].sights.size(), 2u) << "two groups of one tracking UID";
    EXPECT_THAT(prior.not_read, testing::Contains(HasSubstr("SCOORD")));
    EXPECT_THAT(prior.not_read, testing::Contains(HasSubstr("a number that is none")));
}

TEST_F(ForeignReports, OfWhatCannotBeSayNothingAndThatBriefly)
{
    const PriorReport prior = read("absurd");
    ASSERT_EQ(prior.findings.size(), 1u);
    const PriorFinding& finding = prior.findings[0];
    EXPECT_EQ(finding.name, "Lesion\\nC") << "a row of a table";
    EXPECT_FALSE(finding.size_mm || finding.height_mm || finding.volume_ml);
    EXPECT_FALSE(finding.lead()->station_mm || finding.lead()->fraction || finding.lead()->part_fraction);
    EXPECT_EQ(finding.others.size(), 5u) << "what a number is called still stands there";
    EXPECT_FALSE(prior.said.dose_mgy_cm);
    EXPECT_LE(prior.not_read.size(), 13u);
    EXPECT_THAT(prior.not_read, testing::Contains("and more"));
    EXPECT_EQ(labelOf(prior, finding), "earlier: ") << "that is no year";
    const auto report = import({folder / "sr" / "absurd.dcm"});
    ASSERT_EQ(report.lines.size(), 1u) << lines(report);
    EXPECT_LT(report.lines[0].text.size(), 1000u);
}

TEST_F(ForeignReports, OfOtherKindsAreSetAsideAndHostileOnesRefused)
{
    const struct {
        const char* name;
        ingest::ImportLine::Kind kind;
        const char* words;
    } cases[] = {{"other-maker", ingest::ImportLine::Kind::stored, "measurement report by Acme"},
                 {"narrative", ingest::ImportLine::Kind::set_aside, "no measurement report"},
                 {"too-many-items", ingest::ImportLine::Kind::refused, "more than 20000 items"},
                 {"too-deep", ingest::ImportLine::Kind::refused, "nested deeper than 64"},
                 {"without-study", ingest::ImportLine::Kind::refused, "does not say which it is"},
                 {"dose", ingest::ImportLine::Kind::set_aside, "no slice of CT or MR"}};
    for (const auto& c : cases) {
        const auto report = import({folder / "sr" / (std::string(c.name) + ".dcm")});
        EXPECT_EQ(report.lines.size(), 1u) << c.name << "\n" << lines(report);
        EXPECT_TRUE(says(report, c.kind, c.words)) << c.name << "\n" << lines(report);
    }
    const auto other = import({folder / "sr" / "same-uid-other-content.dcm"});
    EXPECT_TRUE(says(other, ingest::ImportLine::Kind::refused, "the first is kept")) << lines(other);
}

}  // namespace
}  // namespace vicon::test
