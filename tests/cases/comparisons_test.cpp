// What a reader said of a finding and one of an earlier report is kept, audited and taken back.
#include "vicon/cases/comparisons.h"

#include <gmock/gmock.h>

#include "finding_fixture.h"
#include "this_person.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/core/error.h"

namespace vicon::test {
namespace {

using testing::HasSubstr;

PriorReport report()
{
    PriorReport r{
        .sop_uid = "1.9", .sop_class = "1.2.840.10008.5.1.4.1.1.88.34", .series_uid = "1.8", .maker = "VICON"};
    r.study.uid = "1.7";
    r.study.date = "20230504";
    r.scans = {{"1.6", "supine", "B30f", 1}};
    for (const char* uid : {"p1", "p2"}) {
        PriorFinding f{.uid = uid, .name = "Finding " + std::string(uid + 1), .kind = FindingKind::polyp};
        f.size_mm = 6.1;
        f.size_from = "surface";
        f.sights.push_back({.series_uid = "1.6", .part = ColonPart::sigmoid, .size_3d_mm = 6.1});
        r.findings.push_back(f);
    }
    return r;
}

class Comparisons : public MarkedCase, public testing::Test {
protected:
    Comparisons() { add({"m1", "m2"}), add({"m3"}); }

    Comparison of(const std::string& finding, const std::string& prior, bool confirmed = true)
    {
        Comparison c = comparisonWith(finding, report(), *report().finding(prior), {});
        c.confirmed = confirmed;
        return c;
    }
    std::optional<Comparison> say(const std::string& finding, const std::string& prior, bool confirmed = true)
    {
        return editComparison(store, "c1", findComparison(store, "c1", finding, "1.9", prior),
                              of(finding, prior, confirmed));
    }
    std::string refusal(const std::function<void()>& work)
    {
        try {
            work();
        } catch (const Error& e) {
            return e.what();
        }
        return "done";
    }
    std::vector<std::string> events()
    {
        std::vector<std::string> out;
        for (const AuditLine& line : auditTrail(store, "c1"))
            if (line.event.starts_with("comparison"))
                out.push_back(line.event);
        return out;
    }
};

TEST_F(Comparisons, HoldWhatTheEarlierReportSaid)
{
    const Comparison kept = *say("f1", "p1");
    EXPECT_EQ(kept.before.size_mm, 6.1);
    EXPECT_EQ(kept.before.kernel, "B30f");
    EXPECT_EQ(kept.before.slice_thickness_mm, 1);
    EXPECT_EQ(kept.before.date, "20230504");
    EXPECT_EQ(kept.prior_place, "sigmoid");
    EXPECT_FALSE(kept.person.empty());
    EXPECT_FALSE(kept.at.empty());
    ASSERT_EQ(comparisons(store, "c1").size(), 1u);
    EXPECT_EQ(toJson(comparisonFromJson(toJson(kept))), toJson(kept));
    const ReadCase read = readCase(store, "c1");
    ASSERT_EQ(read.comparisons.size(), 1u);
    EXPECT_EQ(read.comparisons[0].now.size_mm, 7.3);
    EXPECT_THAT(read.comparisons[0].growth.why_not, HasSubstr("slice thickness now is not known"));
    EXPECT_EQ(toJson(readCaseFromContent(reportContent(read)).comparisons.at(0).growth),
              toJson(read.comparisons[0].growth));
}

TEST_F(Comparisons, TakeFromTheStoresImagesWhatTheReportDoesNotSay)
{
    PriorReport silent = report();
    silent.scans.clear();
    const std::vector<PriorScan> known{{"1.6", "supine", "Br44", 1.25}};
    const Comparison c = comparisonWith("f1", silent, silent.findings[0], known);
    EXPECT_EQ(c.before.kernel, "Br44");
    EXPECT_EQ(c.before.slice_thickness_mm, 1.25);
    EXPECT_EQ(comparisonWith("f1", report(), report().findings[0], known).before.kernel, "B30f") << "the report's word";
}

TEST_F(Comparisons, AreAuditedAndTakenBack)
{
    say("f1", "p1");
    say("f1", "p1", false);
    editComparison(store, "c1", findComparison(store, "c1", "f1", "1.9", "p1"), std::nullopt);
    EXPECT_TRUE(comparisons(store, "c1").empty());
    EXPECT_EQ(events(),
              (std::vector<std::string>{"comparison confirmed", "comparison rejected", "comparison taken back"}));
}

TEST_F(Comparisons, JoinOneThingThenWithOneThingNow)
{
    say("f1", "p1");
    EXPECT_THAT(refusal([&] { say("f2", "p1"); }), HasSubstr("said to be finding f1"));
    EXPECT_THAT(refusal([&] { say("f1", "p2"); }), HasSubstr("said to be Finding 1"));
    say("f1", "p2", false);
    say("f2", "p2");
    EXPECT_EQ(comparisons(store, "c1").size(), 3u);
}

TEST_F(Comparisons, AreNotWrittenOverThoseOfAnotherReader)
{
    const Comparison first = *say("f1", "p1");
    EXPECT_THAT(refusal([&] { editComparison(store, "c1", std::nullopt, of("f1", "p1", false)); }),
                HasSubstr("another reader changed"));
    EXPECT_THAT(refusal([&] { say("f9", "p1"); }), HasSubstr("no finding"));
    EXPECT_EQ(toJson(comparisons(store, "c1").at(0)), toJson(first));
}

TEST_F(Comparisons, OfASignedReportStayAndComeBackWithACancelledAmendment)
{
    const SigningOptions options{.signers = {thisPerson()}};
    say("f1", "p1");
    choose();
    const VersionDraft draft = draftVersion(store, options, "c1", true, "0.1.0");
    keepVersion(store, "c1", draft, "pdf");
    EXPECT_THAT(refusal([&] { say("f1", "p1", false); }), HasSubstr("the report is signed"));
    beginAmendment(store, options, "c1", "size read again");
    say("f1", "p1", false);
    cancelAmendment(store, options, "c1");
    EXPECT_TRUE(comparisons(store, "c1").at(0).confirmed);
}

TEST_F(Comparisons, OfARemovedFindingAreNotTold)
{
    say("f1", "p1");
    editFindings(store, "c1", {{requireFinding(store, "c1", "f1"), std::nullopt}});
    EXPECT_TRUE(readCase(store, "c1").comparisons.empty());
}

}  // namespace
}  // namespace vicon::test
