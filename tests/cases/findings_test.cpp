#include "vicon/cases/findings.h"

#include <gmock/gmock.h>
#include <soci/soci.h>

#include "finding_fixture.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Findings : public testing::Test {
protected:
    test::MarkedCase case_;
    CaseStore& store_ = case_.store;

    std::vector<std::string> all()
    {
        std::vector<std::string> out;
        for (const Finding& f : findings(store_, "c1"))
            out.push_back(f.id + " " + nameOf(f.kind) + " " + f.note);
        return out;
    }
    static Finding with(Finding finding, const std::string& note)
    {
        finding.note = note;
        return finding;
    }
    static std::string messageOf(const std::function<void()>& action)
    {
        try {
            action();
        } catch (const Error& e) {
            return e.what();
        }
        return "nothing was thrown";
    }
};

TEST_F(Findings, AreKeptWithEverything)
{
    const Finding given{.kind = FindingKind::inverted_diverticulum,
                        .markers = {"m1", "m2"},
                        .morphology = Morphology::flat,
                        .attenuation = Attenuation::soft_tissue,
                        .confidence = Confidence::medium,
                        .read_size_mm = 8.25,
                        .height_mm = 2.5,
                        .volume_ml = 0.25,
                        .narrows_lumen = true,
                        .invades = true,
                        .pictures = {"m2"},
                        .note = "größer"};
    const nlohmann::json written = toJson(given);
    for (const auto& [key, value] : {std::pair{"kind", "inverted diverticulum"},
                                     {"morphology", "flat"},
                                     {"attenuation", "soft tissue"},
                                     {"confidence", "medium"},
                                     {"note", "größer"}})
        EXPECT_EQ(written.value(key, ""), value) << key;
    const Finding saved = *editFindings(store_, "c1", {{std::nullopt, given}}).at(0).after;
    EXPECT_EQ(saved.id, "f1");
    EXPECT_EQ(saved.number(), 1);
    const Finding stored = requireFinding(store_, "c1", "1");
    EXPECT_EQ(toJson(stored), toJson(saved));
    Finding same = stored;
    same.id = same.created = same.changed = "";
    EXPECT_EQ(toJson(same), toJson(given));
    EXPECT_FALSE(stored.created.empty());
}

TEST_F(Findings, AreChangedOnlyWhileTheyAreWhatTheReaderSaw)
{
    const Finding seen = case_.add({"m1"});
    editFindings(store_, "c1", {{seen, with(seen, "theirs")}});
    EXPECT_THAT(messageOf([&] { editFindings(store_, "c1", {{seen, with(seen, "ours")}}); }), HasSubstr("meanwhile"));
    EXPECT_THROW(editFindings(store_, "c1", {{seen, std::nullopt}}), Error);
    EXPECT_THROW(editFindings(store_, "c1", {{std::nullopt, seen}}), Error) << "it is there already";
    EXPECT_THAT(all(), ElementsAre("f1 polyp theirs"));
}

TEST_F(Findings, OfOneStepAreAllChangedOrNone)
{
    const Finding a = case_.add({"m1"});
    EXPECT_THROW(editFindings(store_, "c1", {{a, with(a, "half")}, {std::nullopt, Finding{.markers = {"m9"}}}}), Error);
    EXPECT_THAT(all(), ElementsAre("f1 polyp "));
    EXPECT_EQ(case_.add({"m3"}).id, "f2") << "what was rolled back took no number";
}

TEST_F(Findings, ComeBackUnderTheirOwnNumberWhenARemovalIsUndone)
{
    const Finding a = case_.add({"m1"}), b = case_.add({"m3"});
    editFindings(store_, "c1", {{a, std::nullopt}});
    EXPECT_THAT(all(), ElementsAre("f2 polyp "));
    EXPECT_EQ(case_.add({"m2"}).id, "f3") << "a number is not given twice";
    editFindings(store_, "c1", {{std::nullopt, a}});
    EXPECT_THAT(all(), ElementsAre("f1 polyp ", "f2 polyp ", "f3 polyp "));
}

TEST_F(Findings, ShareNoMarkerAndNameOnlyThoseThatAreThere)
{
    case_.add({"m1", "m2"});
    EXPECT_THAT(messageOf([&] { case_.add({"m3", "m2"}); }), HasSubstr("belongs to finding f1 already"));
    EXPECT_THAT(messageOf([&] { case_.add({"m9"}); }), HasSubstr("no marker 'm9'"));
    EXPECT_THAT(withPartners(store_, "c1", {"m1"}), ElementsAre("m1", "m2"));
    EXPECT_THAT(withPartners(store_, "c1", {"m2", "m3"}), ElementsAre("m2", "m1", "m3"));
}

TEST_F(Findings, KeepAMarkerThatWasDeletedUntilItComesBack)
{
    const Finding f = case_.add({"m1", "m2"});
    const Marker deleted = store_.requireMarker("c1", "m1");
    store_.editMarkers("c1", {{deleted, std::nullopt}});
    EXPECT_EQ(readCase(store_, "c1").findings[0].facts.sights.size(), 1u);
    EXPECT_NO_THROW(editFindings(store_, "c1", {{f, with(f, "still")}}));
    store_.editMarkers("c1", {{std::nullopt, deleted}});
    EXPECT_EQ(readCase(store_, "c1").findings[0].facts.sights.size(), 2u);
}

TEST_F(Findings, LeaveALineOfWhatWasAndWhatIsForEveryChange)
{
    const Finding added = case_.add({"m1"});
    const Finding changed = with(added, "new");
    editFindings(store_, "c1", {{added, changed}});
    editFindings(store_, "c1", {{changed, std::nullopt}});
    std::vector<AuditLine> lines = auditTrail(store_, "c1");
    std::erase_if(lines, [](const AuditLine& l) { return !l.event.starts_with("finding"); });
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].event, "finding added");
    EXPECT_TRUE(lines[0].before.is_null());
    EXPECT_EQ(lines[0].after["markers"][0], "m1");
    EXPECT_EQ(lines[1].event, "finding changed");
    EXPECT_EQ(lines[1].before["note"], "");
    EXPECT_EQ(lines[1].after["note"], "new");
    EXPECT_EQ(lines[2].event, "finding removed");
    EXPECT_EQ(lines[2].before["note"], "new");
    EXPECT_TRUE(lines[2].after.is_null());
    for (const AuditLine& line : lines) {
        EXPECT_FALSE(line.person.empty());
        EXPECT_EQ(line.detail, "f1");
    }
}

TEST_F(Findings, LeaveLinesThatNobodyRewrites)
{
    case_.add({"m1"});
    const std::size_t lines = auditTrail(store_, "c1").size();
    for (const char* statement : {"DELETE FROM audit", "UPDATE audit SET person = 'nobody'"})
        EXPECT_THAT(messageOf([&] { store_.database().write([&](soci::session& sql) { sql << statement; }); }),
                    HasSubstr("only appended to"));
    EXPECT_EQ(auditTrail(store_, "c1").size(), lines);
}

TEST_F(Findings, OfADeletedCaseAreRefused)
{
    EXPECT_THROW(editFindings(store_, "c9", {{std::nullopt, Finding{}}}), Error);
    EXPECT_THAT(findings(store_, "c9"), IsEmpty());
    EXPECT_THROW(requireFinding(store_, "c1", "f7"), Error);
}

Assessment fullAssessment()
{
    Assessment a;
    a.indication = "screening";
    a.technique = "1 mm";
    a.comparison = "none";
    a.impression = "a polyp";
    a.recommendation = "colonoscopy";
    a.preparation = Grade::fair;
    a.tagging = Grade::good;
    a.distension = {{"s1", ColonPart::splenic_flexure, Distension::limited}};
    a.inadequate = a.priors_awaited = a.extracolonic_limited = true;
    a.dose_mgy_cm = 312.5;
    a.reading_minutes = 9;
    a.coverage_percent = 97.5;
    a.extracolonic = {{"liver", "a cyst", ExtracolonicCategory::e1}, {"aorta", "48 mm", ExtracolonicCategory::e4}};
    a.colon_category = {ColonCategory::c3, "as the patient asks", ColonCategory::c2a};
    a.extracolonic_category = {ExtracolonicCategory::e4, ""};
    return a;
}

TEST_F(Findings, HaveAnAssessmentThatIsKeptWithEverything)
{
    EXPECT_EQ(toJson(assessmentOf(store_, "c1")), toJson(Assessment{}));
    saveAssessment(store_, "c1", {}, fullAssessment());
    EXPECT_EQ(toJson(assessmentOf(store_, "c1")), toJson(fullAssessment()));
    EXPECT_EQ(assessmentOf(store_, "c1").preparation, Grade::fair);
    EXPECT_EQ(assessmentOf(store_, "c1").tagging, Grade::good);
    EXPECT_EQ(assessmentOf(store_, "c1").dose_mgy_cm, 312.5);
    EXPECT_THAT(messageOf([&] { saveAssessment(store_, "c1", {}, {}); }), HasSubstr("meanwhile"));
    const AuditLine line = auditTrail(store_, "c1").back();
    EXPECT_EQ(line.event, "assessment changed");
    EXPECT_EQ(line.after["extracolonic"][1]["category"], "E4");
}

TEST_F(Findings, HaveNothingSaidWhereTheAssessmentIsSilent)
{
    const nlohmann::json silent = toJson(assessmentFromJson(nlohmann::json::object()));
    EXPECT_EQ(silent, toJson(Assessment{}));
    for (const auto& [key, value] : silent.items())
        EXPECT_NE(value, true) << key;
}

TEST_F(Findings, AreJudgedWithoutQualityWhereNoneWasMeasured)
{
    case_.record("quality", toJson(QualityFound{.not_measured = "segments and quality are those of a colon"}));
    EXPECT_TRUE(readCase(store_, "c1").parts.empty());
}

TEST_F(Findings, AreReadWithEveryScanThatBearsAMarker)
{
    ScanRecord late = case_.scan;
    late.id = "s2";
    late.series.uid = "1.2.3.9";
    late.role = ScanRole::refused;
    makePrivateFolder(store_.scanFolder("c1", "s2"));
    store_.addScan(store_.requireCase("c1"), late, {}, false);
    EXPECT_EQ(readCase(store_, "c1").scans.size(), 1U) << "nothing is marked in it";
    store_.saveMarker("c1", Marker{.scan_id = "s2"});
    EXPECT_EQ(readCase(store_, "c1").scans.size(), 2U);
}

TEST_F(Findings, AreNotReadFromWhatIsNone)
{
    for (const char* wrong : {"{}", R"({"kind": "spot"})", R"({"kind": 7})", R"({"kind": "polyp", "markers": 7})"})
        EXPECT_THROW(findingFromJson(nlohmann::json::parse(wrong)), Error) << wrong;
    for (const char* wrong : {R"({"preparation": "so so"})", R"({"colon_category": {"category": "C9"}})"})
        EXPECT_THROW(assessmentFromJson(nlohmann::json::parse(wrong)), Error) << wrong;
}

ScanQuality quality(bool sigmoid, bool caecum)
{
    ScanQuality out;
    for (const auto& [part, adequate] : {std::pair{ColonPart::sigmoid, sigmoid}, {ColonPart::caecum, caecum}}) {
        out.parts.emplace_back();
        out.parts.back().part = part;
        out.parts.back().adequate = adequate;
    }
    return out;
}

TEST_F(Findings, AreThoseOfAnIncompleteStudyWhereNoScanShowsAColon)
{
    for (const char* marker : {"m1", "m2", "m3"})
        store_.removeMarker("c1", marker);
    EXPECT_EQ(nameOf(*readCase(store_, "c1").colon_proposal.category), "C1");
    case_.record("segment", {{"verdict", "no colon"}, {"reason", "a head"}});
    const ReadCase read = readCase(store_, "c1");
    EXPECT_EQ(nameOf(*read.colon_proposal.category), "C0");
    EXPECT_THAT(read.colon_proposal.reason, HasSubstr("no scan was prepared that shows a colon"));
    test::StoreOfOneScan waiting;
    EXPECT_EQ(nameOf(*readCase(waiting.store, "c1").colon_proposal.category), "C0");
}

TEST_F(Findings, AreJudgedWithWhatWasMeasuredOfThePartsAndWhatTheReaderSays)
{
    case_.add({"m1"});
    ReadCase read = readCase(store_, "c1");
    EXPECT_THAT(read.loose_markers, ElementsAre("m2", "m3"));
    EXPECT_FALSE(read.colon_proposal.category) << "what m2 and m3 show is not known";
    for (const char* marker : {"m2", "m3"})
        store_.removeMarker("c1", marker);
    EXPECT_EQ(nameOf(*readCase(store_, "c1").colon_proposal.category), "C2a") << "7.3 mm";
    ColonPartRanges ranges{{ColonPart::sigmoid, 0, 500}, {ColonPart::caecum, 500, 900}};
    case_.record("quality", toJson(QualityFound{.parts = ranges, .quality = quality(false, true)}));
    read = readCase(store_, "c1");
    EXPECT_EQ(nameOf(*read.colon_proposal.category), "C0");
    EXPECT_THAT(read.colon_proposal.reason, HasSubstr("sigmoid collapsed"));
    Assessment after;
    after.distension = {{"s1", ColonPart::sigmoid, Distension::limited}};
    saveAssessment(store_, "c1", {}, after);
    read = readCase(store_, "c1");
    EXPECT_EQ(nameOf(*read.colon_proposal.category), "C2a");
    EXPECT_TRUE(read.parts[0].by_reader);
}

TEST(CollapsedParts, AreThoseThatNoPositionShows)
{
    using enum ColonPart;
    using enum Distension;
    EXPECT_THAT(collapsedEverywhere({{"s1", sigmoid, collapsed}, {"s2", sigmoid, good}}), IsEmpty());
    EXPECT_THAT(collapsedEverywhere({{"s1", sigmoid, collapsed}, {"s2", sigmoid, limited}}), IsEmpty());
    EXPECT_THAT(collapsedEverywhere({{"s1", sigmoid, collapsed}, {"s2", sigmoid, collapsed}}), ElementsAre("sigmoid"));
    EXPECT_THAT(collapsedEverywhere({{"s1", sigmoid, collapsed}, {"s2", caecum, good}}), ElementsAre("sigmoid"))
        << "the other scan does not show it";
}

TEST_F(Findings, AreReadBackFromAReportsContent)
{
    case_.add({"m1", "m2"});
    saveAssessment(store_, "c1", {}, fullAssessment());
    ReadCase read = readCase(store_, "c1");
    read.given_lumens["s1"] = {"NIfTI", "0123", 7, 0.97, "anna", "2026-11-25T12:00:00Z"};
    const auto content = reportContent(read);
    EXPECT_EQ(content["scans"][0]["given_lumen"]["label"], 7);
    EXPECT_EQ(reportContent(readCaseFromContent(content)), content);
}

TEST(FindingsOfAnEarlierVicon, LiveBesideWhatItHadWritten)
{
    constexpr int kBeforeFindings = 1;
    const support::TemporaryFolder folder;
    const std::string marker = toJson(Marker{.id = "m1", .scan_id = "s1"}).dump();
    CaseStore migrated(support::storeOfVersion(
        kBeforeFindings, folder / "store",
        {"INSERT INTO cases (id, study_uid, patient_id, patient_name, birth_date, sex, study, flags, created)"
         " VALUES ('c1', '1.2', 'P1', '', '', '', '{}', '[]', '2026-01-02T03')",
         "INSERT INTO markers (case_id, id, scan_id, content) VALUES ('c1', 'm1', 's1', '" + marker + "')",
         "INSERT INTO audit (at, event, case_id, scan_id, detail)"
         " VALUES ('2026-01-02T03', 'imported', 'c1', 's1', '7 objects')"}));
    EXPECT_EQ(auditTrail(migrated, "c1").at(0).person, "");
    EXPECT_EQ(auditTrail(migrated, "c1").at(0).detail, "7 objects");
    editFindings(migrated, "c1", {{std::nullopt, Finding{.markers = {"m1"}}}});
    EXPECT_EQ(findings(migrated, "c1").size(), 1u);
    EXPECT_EQ(migrated.markers("c1").size(), 1u);
}

}  // namespace
}  // namespace vicon
