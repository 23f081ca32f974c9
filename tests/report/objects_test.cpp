// A report's DICOM objects, as dciodvfy and pydicom read them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>

#include "dicom_writer.h"
#include "store_fixture.h"
#include "vicon/cases/findings.h"
#include "vicon/ingest/import.h"
#include "vicon/report/report_objects.h"

namespace vicon::test {

namespace fs = std::filesystem;

namespace {

using report::ObjectKind;
using testing::HasSubstr;
using testing::Not;

/// A scan as a scanner in this position makes it.
SeriesSpec lying(const std::string& position)
{
    SeriesSpec spec;
    spec.patient_position = position;
    spec.pixel_mm = 0.7;
    spec.row_mm = 0.8;
    if (position == "HFP" || position == "FFP") {
        spec.row = {-1, 0, 0};
        spec.column = {0, -1, 0};
    } else if (position == "HFDL") {
        spec.row = {0, -1, 0};
        spec.column = {1, 0, 0};
    } else if (position == "HFDR") {
        spec.row = {0, 1, 0};
        spec.column = {-1, 0, 0};
    } else if (position == "FFDL") {
        spec.row = {0, 1, 0};
        spec.column = {1, 0, 0};
    } else if (position == "FFDR") {
        spec.row = {0, -1, 0};
        spec.column = {-1, 0, 0};
    } else if (position == "tilted") {
        spec.patient_position = "HFS";
        spec.column = {0, 0.9510565, 0.3090170};  // by 18 degrees
        spec.step_mm = {0, 0, 1.5};
    }
    if (position.starts_with("FF"))
        spec.step_mm = {0, 0, -2};
    return spec;
}

class ReportObjects : public StoreFixture {
protected:
    SeriesSpec spec_;
    std::string case_id_;
    nlohmann::json groups_ = nlohmann::json::array();
    ReportVersion version_{.version = 1,
                           .state = ReportState::final,
                           .person = "reader",
                           .at = "2026-11-23T20:15:30Z",
                           .software = "0.1.0",
                           .digest = "d"};
    const std::string pdf_ = "%PDF-1.4 of an odd length";

    ReportObjects() { setClock("UTC0"); }
    ~ReportObjects() override { setClock("UTC0"); }
    /// @param zone as POSIX writes it
    static void setClock(const char* zone)
    {
        setenv("TZ", zone, 1);
        tzset();
    }

    void importScan(const SeriesSpec& spec)
    {
        spec_ = spec;
        const auto report = import(writeSeries(folder / "in", spec));
        ASSERT_EQ(store.cases().size(), 1u) << lines(report);
        case_id_ = store.cases().at(0).id;
    }
    std::vector<report::ReportObject> writeFrom(const ReadCase& read, const report::ObjectContent& content,
                                                const fs::path& where)
    {
        report::ShownScans scans(store, read);
        return report::writeReportObjects(scans, content, where);
    }
    /// A marker in the middle of this voxel.
    Marker mark(int column, int row, int slice)
    {
        Marker marker{.scan_id = onlyScan().id};
        marker.position_mm =
            spec_.position(slice) + spec_.row * (column * spec_.pixel_mm) + spec_.column * (row * spec_.row_mm);
        marker.station_mm = 300.123456789 + column;
        marker.from_caecum_mm = 1200.5;
        marker.fraction = 1.0 / 3;
        marker.part = ColonPart::sigmoid;
        return store.saveMarker(case_id_, marker);
    }
    void expectGroup(const Marker& marker, int number, int column, int row, int slice)
    {
        groups_.push_back({{"tracking", "Finding " + std::to_string(number)},
                           {"voxel", {column, row}},
                           {"image", spec_.sopUid(slice)},
                           {"spacing_mm", 1.5},
                           {"numbers",
                            {{"Distance from anus", marker.station_mm},
                             {"Distance from caecum", marker.from_caecum_mm},
                             {"Fraction of the colon's length from the anus", marker.fraction}}},
                           {"codes", {{"Finding Site", "Sigmoid colon"}}}});
    }
    void add(const Finding& finding) { editFindings(store, case_id_, {{std::nullopt, finding}}); }
    std::vector<report::ReportObject> write(const fs::path& where)
    {
        fs::create_directories(where);
        const ReadCase read = readCase(store, case_id_);
        return writeFrom(read, {read, version_, std::nullopt, pdf_}, where);
    }
    /// What dciodvfy and pydicom find wrong.
    std::string faults(const fs::path& where)
    {
        std::string out;
        for (const auto& entry : fs::directory_iterator(where)) {
            const std::string said = support::runCommand("dciodvfy " + entry.path().string()).output;
            if (said.find("Error") != std::string::npos)
                out += entry.path().filename().string() + "\n" + said;
        }
        const ScanRecord scan = onlyScan();
        replaceFile(folder / "report.pdf", pdf_);
        replaceFile(folder / "expected.json",
                    nlohmann::json{{"dicom", (store.scanFolder(case_id_, scan.id) / "dicom").string()},
                                   {"pdf", (folder / "report.pdf").string()},
                                   {"study",
                                    {{"PatientName", spec_.patient_name},
                                     {"PatientID", spec_.patient_id},
                                     {"PatientBirthDate", spec_.birth_date},
                                     {"StudyInstanceUID", spec_.study_uid},
                                     {"ContentDate", "20261123"},
                                     {"ContentTime", "201530"}}},
                                   {"groups", groups_}}
                        .dump());
        const auto checked = support::runCommand("/usr/bin/python3 " VICON_CHECK_OBJECTS " " + where.string() + " " +
                                                 (folder / "expected.json").string());
        return checked.exit_code == 0 ? out : out + checked.output;
    }
};

class ReportObjectsOf : public ReportObjects, public testing::WithParamInterface<const char*> {};

TEST_P(ReportObjectsOf, APointLiesOnTheVoxelThatWasMarked)
{
    importScan(lying(GetParam()));
    const Marker near = mark(3, 11, 1), far = mark(14, 2, 10);
    add({.kind = FindingKind::other, .markers = {near.id}});
    add({.kind = FindingKind::other, .markers = {far.id}});
    expectGroup(near, 1, 3, 11, 1);
    expectGroup(far, 2, 14, 2, 10);
    const ReadCase read = readCase(store, case_id_);
    for (std::size_t n = 0; n < groups_.size(); ++n) {  // as the case has them, to the last digit
        const auto& e = *read.findings.at(n).facts.endoscope;
        groups_[n]["numbers"]["Estimated endoscope distance from anus"] = e.about_mm;
        groups_[n]["numbers"]["Estimated endoscope distance from anus, least"] = e.least_mm;
        groups_[n]["numbers"]["Estimated endoscope distance from anus, most"] = e.most_mm;
    }
    write(folder / "out");
    EXPECT_EQ(faults(folder / "out"), "");
}

INSTANTIATE_TEST_SUITE_P(Positions, ReportObjectsOf,
                         testing::Values("HFS", "HFP", "FFS", "FFP", "HFDL", "HFDR", "FFDL", "FFDR", "tilted"));

TEST_F(ReportObjects, HoldEveryMeasureOfAFinding)
{
    importScan({});
    const Marker first = mark(5, 9, 7), second = mark(4, 4, 3);
    add({.kind = FindingKind::polyp,
         .markers = {first.id, second.id},
         .morphology = Morphology::flat,
         .attenuation = Attenuation::fat,
         .confidence = Confidence::low,
         .read_size_mm = 7.3,
         .height_mm = 2.125,
         .volume_ml = 0.1,
         .note = "größer als 2024"});
    expectGroup(first, 1, 5, 9, 7);
    expectGroup(second, 1, 4, 4, 3);
    const FindingFacts facts = readCase(store, case_id_).findings.at(0).facts;
    auto& whole = groups_[std::size_t(*facts.leading)];
    whole["numbers"].update({{"Largest dimension", 7.3},
                             {"Height above the wall", 2.125},
                             {"Volume", 0.1},
                             {"Estimated endoscope distance from anus", facts.endoscope->about_mm},
                             {"Estimated endoscope distance from anus, least", facts.endoscope->least_mm},
                             {"Estimated endoscope distance from anus, most", facts.endoscope->most_mm}});
    whole["codes"].update({{"Finding", "Polyp of colon"},
                           {"Morphology", "Flat"},
                           {"Attenuation", "Fat"},
                           {"Confidence of the reader", "low"},
                           {"Largest dimension taken from", "reader"}});
    write(folder / "out");
    EXPECT_EQ(faults(folder / "out"), "");
    EXPECT_THAT(support::runCommand("dsrdump " + (folder / "out/version-1-sr.dcm").string()).output,
                HasSubstr("größer als 2024"));
}

TEST_F(ReportObjects, GiveTheirTimesByTheClockOnTheWallAsTheStudyBesideThem)
{
    importScan({});
    setClock("EST5EDT,M3.2.0,M11.1.0");
    version_.at = "2026-07-01T02:15:30Z";
    const auto objects = write(folder / "out");
    ASSERT_FALSE(objects.empty());
    for (const report::ReportObject& object : objects) {
        const std::string dump = support::runCommand("dcmdump " + object.file.string()).output;
        EXPECT_THAT(dump, HasSubstr("(0008,0023) DA [20260630]"));
        EXPECT_THAT(dump, HasSubstr("(0008,0033) TM [221530]"));
        EXPECT_THAT(dump, testing::Not(HasSubstr("(0008,0201)"))) << "it would be said of the study's time too";
        if (dump.find("(0040,a030)") != std::string::npos) {
            EXPECT_THAT(dump, HasSubstr("(0040,a030) DT [20260630221530]"));
        }
    }
}

TEST_F(ReportObjects, AreWrittenOfAStudyWhoseUidsAreNoneByAnAccountThatIsNoName)
{
    SeriesSpec spec;
    spec.study_uid = "1.2.840.STUDY7.1";
    spec.frame_of_reference_uid = "1.2.840.113619.FRAME.7";
    importScan(spec);
    const Marker marker = mark(5, 9, 7);
    add({.kind = FindingKind::polyp, .markers = {marker.id}});
    version_.person = "HOSP\\jdoe";
    const auto objects = write(folder / "out");
    EXPECT_TRUE(std::any_of(objects.begin(), objects.end(), [](const report::ReportObject& object) {
        return object.file.filename() == "version-1-sr.dcm";
    }));
    const std::string sr = support::runCommand("dsrdump " + (folder / "out/version-1-sr.dcm").string()).output;
    EXPECT_THAT(sr, HasSubstr("HOSP jdoe"));
    const std::string dump = support::runCommand("dcmdump " + (folder / "out/version-1-sr.dcm").string()).output;
    EXPECT_THAT(dump, HasSubstr("1.2.840.STUDY7.1")) << "it lies in the study all the same";
}

TEST_F(ReportObjects, AreTheSameForTheSameReportAndOthersForAnother)
{
    importScan({});
    const Marker marker = mark(5, 9, 7);
    add({.kind = FindingKind::polyp, .markers = {marker.id}});
    const auto one = write(folder / "one"), again = write(folder / "again");
    ASSERT_EQ(one.size(), 3u);
    for (std::size_t n = 0; n < one.size(); ++n) {
        EXPECT_EQ(readFile(one[n].file), readFile(again[n].file)) << one[n].file;
        EXPECT_EQ(one[n].sop_uid, report::objectUid(version_, one[n].kind));
    }
    version_.digest = "e";
    EXPECT_NE(write(folder / "other").at(0).sop_uid, one.at(0).sop_uid);
}

TEST_F(ReportObjects, AnAmendedReportNamesItsPredecessor)
{
    importScan({});
    const ReportVersion first = version_;
    version_ = {.version = 2,
                .state = ReportState::amended,
                .replaces = 1,
                .person = "reader",
                .at = "2026-11-24T08:00:00Z",
                .software = "0.1.0",
                .digest = "e"};
    const ReadCase read = readCase(store, case_id_);
    fs::create_directories(folder / "out");
    const auto objects = writeFrom(read, {read, version_, first, pdf_}, folder / "out");
    ASSERT_EQ(objects.size(), 2u) << "without findings there are no key images";
    const auto dump = support::runCommand("dcmdump +P PredecessorDocumentsSequence +P ReferencedSOPInstanceUID " +
                                          objects.at(1).file.string());
    EXPECT_THAT(dump.output, HasSubstr(report::objectUid(first, ObjectKind::measurements)));
    EXPECT_THAT(support::runCommand("dciodvfy " + objects.at(1).file.string()).output, Not(HasSubstr("Error")));
}

}  // namespace
}  // namespace vicon::test
