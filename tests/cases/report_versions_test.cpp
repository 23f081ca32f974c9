#include "vicon/cases/report_versions.h"

#include <gmock/gmock.h>
#include <soci/soci.h>

#include <atomic>
#include <thread>

#include "finding_fixture.h"
#include "this_person.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/reader_input.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

using testing::HasSubstr;

class ReportVersions : public testing::Test {
protected:
    test::MarkedCase case_;
    CaseStore& store_ = case_.store;
    SigningOptions options_{{"somebody", thisPerson()}};
    Finding finding_ = case_.add({"m1", "m2"});

    VersionDraft draft(bool sign = true) { return draftVersion(store_, options_, "c1", sign, "0.1.0"); }
    ReportVersion sign(const std::string& pdf = "a PDF") { return keepVersion(store_, "c1", draft(), pdf); }
    static std::string messageOf(const std::function<void()>& action)
    {
        try {
            action();
        } catch (const Error& e) {
            return e.what();
        }
        return "nothing was thrown";
    }
    void changeNote(const std::string& note)
    {
        const Finding before = requireFinding(store_, "c1", "f1");
        Finding after = before;
        after.note = note;
        editFindings(store_, "c1", {{before, after}});
    }
};

TEST_F(ReportVersions, AreSignedByThoseWhoMay)
{
    case_.choose();
    options_.signers = {"somebody"};
    EXPECT_THAT(messageOf([&] { sign(); }), HasSubstr("may not sign"));
    options_.signers.clear();
    EXPECT_THAT(messageOf([&] { sign(); }), HasSubstr("[roles] sign"));
    EXPECT_NO_THROW(draft(false)) << "a preliminary report bears no signature";
    options_.signers = {thisPerson()};
    EXPECT_EQ(sign().version, 1);
}

TEST_F(ReportVersions, AreSignedWhenNothingIsMissing)
{
    EXPECT_THAT(messageOf([&] { sign(); }), testing::AllOf(HasSubstr("no C-RADS category of the colon"),
                                                           HasSubstr("no C-RADS category outside the colon")));
    Assessment other;
    other.colon_category = {ColonCategory::c1, ""};
    other.extracolonic_category = {ExtracolonicCategory::e1, ""};
    saveAssessment(store_, "c1", {}, other);
    EXPECT_THAT(messageOf([&] { sign(); }),
                HasSubstr("nothing can be proposed (markers not assigned to a finding: m3)"));
    store_.removeMarker("c1", "m3");
    EXPECT_THAT(messageOf([&] { sign(); }), HasSubstr("C1 was chosen where C2a is proposed"));
    EXPECT_THROW(requireReasons(readCase(store_, "c1")), Error);
    Assessment explained = other;
    explained.colon_category = {ColonCategory::c1, "it was removed yesterday", ColonCategory::c2a};
    saveAssessment(store_, "c1", other, explained);
    EXPECT_NO_THROW(requireReasons(readCase(store_, "c1")));
    store_.removeMarker("c1", "m1");
    store_.removeMarker("c1", "m2");
    EXPECT_THAT(messageOf([&] { sign(); }), HasSubstr("finding f1 has no marker"));
}

TEST_F(ReportVersions, AreNotSignedWithAReasonThatWasGivenAgainstAnotherProposal)
{
    store_.removeMarker("c1", "m3");
    Assessment said;
    said.colon_category = {ColonCategory::c1, "it was removed yesterday", ColonCategory::c2a};
    said.extracolonic_category = {ExtracolonicCategory::e1, "", ExtracolonicCategory::e1};
    saveAssessment(store_, "c1", {}, said);
    EXPECT_NO_THROW(draft());
    Finding larger = finding_;
    larger.read_size_mm = 12;
    editFindings(store_, "c1", {{finding_, larger}});
    EXPECT_THAT(messageOf([&] { draft(); }), testing::AllOf(HasSubstr("C1 was chosen where C3 is proposed"),
                                                            HasSubstr("the reason given was not against this")));
}

TEST_F(ReportVersions, HoldWhatWasSignedByWhomAndWhen)
{
    case_.choose();
    const ReportVersion kept = sign("the PDF");
    const auto versions = reportVersions(store_, "c1");
    ASSERT_EQ(versions.size(), 1u);
    EXPECT_EQ(toJson(versions[0]), toJson(kept));
    EXPECT_EQ(versions[0].state, ReportState::final);
    EXPECT_EQ(versions[0].person, thisPerson());
    EXPECT_EQ(versions[0].software, "0.1.0");
    EXPECT_EQ(readFile(versions[0].file), "the PDF");
    // As anybody can compute it with sha256sum.
    EXPECT_EQ(versions[0].digest, sha256(versions[0].content + "\n" + sha256("the PDF")));
    EXPECT_EQ(nlohmann::json::parse(versions[0].content), reportContent(readCase(store_, "c1")));
    EXPECT_EQ(faultOf(versions[0]), "");
    EXPECT_EQ(textOf(reportStatus(store_, "c1")), "signed, version 1");
    EXPECT_TRUE(hasReaderInput(store_, case_.scan));
    const AuditLine line = auditTrail(store_, "c1").back();
    EXPECT_EQ(line.event, "report signed");
    EXPECT_EQ(line.after["digest"], kept.digest);
}

TEST_F(ReportVersions, NeverChangeOnceSigned)
{
    case_.choose();
    sign();
    EXPECT_THAT(messageOf([&] { changeNote("later"); }), HasSubstr("vicon amend c1"));
    EXPECT_THAT(messageOf([&] { case_.choose(); }), HasSubstr("the report is signed"));
    EXPECT_THAT(messageOf([&] { sign(); }), HasSubstr("signed already"));
    for (const char* statement : {"DELETE FROM report_versions", "UPDATE report_versions SET person = 'nobody'"})
        EXPECT_THAT(messageOf([&] { store_.database().write([&](soci::session& sql) { sql << statement; }); }),
                    HasSubstr("never changes"));
    Marker moved = store_.requireMarker("c1", "m1");
    moved.station_mm = 999;
    store_.saveMarker("c1", moved);
    const ReportVersion version = reportVersions(store_, "c1").at(0);
    EXPECT_EQ(faultOf(version), "");
    EXPECT_EQ(readCaseFromContent(nlohmann::json::parse(version.content)).findings[0].facts.sights[0].station_mm, 300);
}

TEST_F(ReportVersions, AreAmendedAndTheEarlierOneStays)
{
    case_.choose();
    const auto amend = [&](const std::string& reason) { beginAmendment(store_, options_, "c1", reason); };
    EXPECT_THAT(messageOf([&] { amend("why"); }), HasSubstr("not signed"));
    sign("first");
    EXPECT_THAT(messageOf([&] { amend(""); }), HasSubstr("needs a reason"));
    amend("size read again");
    EXPECT_THAT(messageOf([&] { amend("again"); }), HasSubstr("begun already: size read again"));
    EXPECT_EQ(textOf(reportStatus(store_, "c1")), "amendment of version 1 begun: size read again");
    changeNote("6 mm");
    EXPECT_THAT(messageOf([&] { draft(false); }), HasSubstr("not made preliminary"));
    const ReportVersion second = sign("second");
    EXPECT_EQ(second.state, ReportState::amended);
    EXPECT_EQ(second.replaces, 1);
    EXPECT_EQ(second.reason, "size read again");
    const auto versions = reportVersions(store_, "c1");
    ASSERT_EQ(versions.size(), 2u);
    EXPECT_EQ(readFile(versions[0].file), "first");
    EXPECT_EQ(readFile(versions[1].file), "second");
    EXPECT_THROW(changeNote("locked again"), Error);
}

TEST_F(ReportVersions, AreWhatTheyWereWhenAnAmendmentIsCancelled)
{
    case_.choose();
    sign();
    const auto before = reportContent(readCase(store_, "c1"));
    EXPECT_THROW(cancelAmendment(store_, options_, "c1"), Error);
    beginAmendment(store_, options_, "c1", "perhaps");
    changeNote("other");
    case_.add({"m3"}, FindingKind::stool);
    cancelAmendment(store_, options_, "c1");
    EXPECT_EQ(reportContent(readCase(store_, "c1")), before);
    EXPECT_EQ(textOf(reportStatus(store_, "c1")), "signed, version 1");
    EXPECT_EQ(auditTrail(store_, "c1").back().before["findings"].size(), 2u);
}

TEST_F(ReportVersions, AreAmendedByThoseWhoMaySign)
{
    case_.choose();
    sign();
    const SigningOptions others{{"somebody"}};
    EXPECT_THAT(messageOf([&] { beginAmendment(store_, others, "c1", "mine"); }), HasSubstr("may not sign"));
    EXPECT_EQ(textOf(reportStatus(store_, "c1")), "signed, version 1");
    beginAmendment(store_, options_, "c1", "a second look");
    EXPECT_THAT(messageOf([&] { cancelAmendment(store_, others, "c1"); }), HasSubstr("may not sign"));
    EXPECT_TRUE(reportStatus(store_, "c1").amending);
}

TEST_F(ReportVersions, MayBePreliminaryFirst)
{
    const ReportVersion first = keepVersion(store_, "c1", draft(false), "preliminary");
    EXPECT_EQ(first.state, ReportState::preliminary);
    EXPECT_FALSE(first.isSigned());
    changeNote("open still");
    case_.choose();
    const ReportVersion second = sign();
    EXPECT_EQ(second.state, ReportState::final);
    EXPECT_EQ(second.replaces, 0);
    EXPECT_EQ(reportVersions(store_, "c1").size(), 2u);
}

TEST_F(ReportVersions, OfTwoWhoSignAtOnceOneWinsAndTheOtherIsTold)
{
    case_.choose();
    constexpr int kReaders = 4;
    const StorePlace place = store_.place();
    std::atomic<int> ready = 0, signed_by = 0, told = 0;
    const auto read = [&] {
        CaseStore store(place);
        const VersionDraft mine = draftVersion(store, options_, "c1", true, "0.1.0");
        ++ready;
        while (ready < kReaders)
            std::this_thread::yield();
        try {
            keepVersion(store, "c1", mine, "a PDF");
            ++signed_by;
        } catch (const Error& e) {
            EXPECT_THAT(e.what(), HasSubstr("made signed by " + thisPerson()));
            ++told;
        }
    };
    std::vector<std::thread> readers;
    for (int n = 0; n < kReaders; ++n)
        readers.emplace_back(read);
    for (std::thread& reader : readers)
        reader.join();
    EXPECT_EQ(signed_by, 1);
    EXPECT_EQ(told, kReaders - 1);
    EXPECT_EQ(reportVersions(store_, "c1").size(), 1u);
}

TEST_F(ReportVersions, AreNotKeptOfACaseThatChangedWhileTheyWereDrawn)
{
    case_.choose();
    const VersionDraft mine = draft();
    changeNote("by another reader");
    EXPECT_THAT(messageOf([&] { keepVersion(store_, "c1", mine, "a PDF"); }), HasSubstr("changed while"));
    EXPECT_TRUE(reportVersions(store_, "c1").empty());
    EXPECT_FALSE(fs::exists(reportFolder(store_, "c1") / versionName(1)));
}

TEST_F(ReportVersions, AreNotKeptWhereTheFileCannotBeWritten)
{
    case_.choose();
    const VersionDraft mine = draft();
    fs::create_directories(reportFolder(store_, "c1") / versionName(1) / "in the way");
    EXPECT_THROW(keepVersion(store_, "c1", mine, "a PDF"), Error);
    EXPECT_EQ(reportStatus(store_, "c1").state, ReportState::draft);
    fs::remove_all(reportFolder(store_, "c1") / versionName(1));
    EXPECT_EQ(keepVersion(store_, "c1", mine, "a PDF").version, 1);
}

TEST_F(ReportVersions, SqliteAreNotKeptOnAFullDisk)
{
    changeNote(std::string(200'000, 'n'));
    case_.choose();
    const VersionDraft mine = draft();
    store_.database().session() << "PRAGMA max_page_count = 1";  // SQLite's own answer to it
    EXPECT_THROW(keepVersion(store_, "c1", mine, "a PDF"), Error);
    store_.database().session() << "PRAGMA max_page_count = 1000000";
    EXPECT_TRUE(reportVersions(store_, "c1").empty());
    EXPECT_EQ(keepVersion(store_, "c1", mine, "a PDF").version, 1);
}

TEST_F(ReportVersions, LeaveNoFileThatNoneOfThemNames)
{
    case_.choose();
    makePrivateFolder(reportFolder(store_, "c1"));
    const fs::path orphan = reportFolder(store_, "c1") / versionName(1);
    replaceFile(orphan, "written, and killed before the commit");
    EXPECT_TRUE(reportVersions(store_, "c1").empty());
    EXPECT_FALSE(fs::exists(orphan));
}

TEST_F(ReportVersions, HaveNoObjectThatAKillLeftOfAnotherTry)
{
    case_.choose();
    const support::TemporaryFolder elsewhere;
    const fs::path folder = reportFolder(store_, "c1"), made = elsewhere / "version-1-sr.dcm";
    fs::create_directories(folder);
    for (const char* left : {"version-1-sr.dcm", "version-1-picture-m9.dcm", "version-2-sr.dcm"})
        replaceFile(folder / left, "left");
    replaceFile(made, "made");
    keepVersion(store_, "c1", draft(), "a PDF", {.files = {made}});
    EXPECT_THAT(versionObjects(store_, "c1", 1), testing::ElementsAre(folder / "version-1-sr.dcm"));
    EXPECT_EQ(readFile(folder / "version-1-sr.dcm"), "made");
    EXPECT_TRUE(fs::exists(folder / "version-2-sr.dcm")) << "of no concern of this one";
}

TEST_F(ReportVersions, SayWhatIsNoLongerAsItWasSigned)
{
    case_.choose();
    sign("first");
    const fs::path file = reportVersions(store_, "c1").at(0).file;
    replaceFile(file, "forged");
    EXPECT_EQ(faultOf(reportVersions(store_, "c1").at(0)), "its file is not what was kept");
    fs::remove(file);
    EXPECT_EQ(faultOf(reportVersions(store_, "c1").at(0)), "its file is missing");
    ReportVersion other = reportVersions(store_, "c1").at(0);
    other.content += " ";
    EXPECT_EQ(faultOf(other), "its content is not what was kept");
}

TEST_F(ReportVersions, SayWhichOfTheirObjectsAreNoLongerAsTheyWereSigned)
{
    case_.choose();
    const support::TemporaryFolder elsewhere;
    std::vector<fs::path> made;
    for (const char* kind : {"lumen-s1", "pdf", "sr"})
        replaceFile(made.emplace_back(elsewhere / (std::string("version-1-") + kind + ".dcm")), kind);
    keepVersion(store_, "c1", draft(), "a PDF", {.files = made});
    const auto version = [&] { return reportVersions(store_, "c1").at(0); };
    const fs::path folder = reportFolder(store_, "c1");
    EXPECT_EQ(faultOf(version()), "");
    EXPECT_EQ(requireObjects(version()), versionObjects(store_, "c1", 1));
    replaceFile(folder / "version-1-key.dcm", "of somebody else");
    EXPECT_EQ(requireObjects(version()).size(), made.size()) << "what was not signed is none of them";
    replaceFile(folder / "version-1-lumen-s1.dcm", "altered");
    fs::remove(folder / "version-1-sr.dcm");
    const std::string fault = "version-1-lumen-s1.dcm is not what was kept; version-1-sr.dcm is missing";
    EXPECT_EQ(faultOf(version()), fault);
    EXPECT_THAT(messageOf([&] { requireObjects(version()); }), HasSubstr(fault));
    EXPECT_EQ(nlohmann::json::parse(store_.database().read([](soci::session& sql) {
                  std::string said;
                  sql << "SELECT new_value FROM audit WHERE event = 'report signed'", soci::into(said);
                  return said;
              }))["objects"]["version-1-pdf.dcm"],
              sha256("pdf"));
}

}  // namespace
}  // namespace vicon
