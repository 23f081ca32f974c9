// The proposed categories, case by case. Sources:
//   2005  Zalis et al., CT Colonography Reporting and Data System: A Consensus Proposal, Radiology 236:3
//   2023  Yee et al., C-RADS: Version 2023 Update, Radiology 310(1)
//   house what neither says: docs/dev/report.md
#include "vicon/cases/c_rads.h"

#include <gmock/gmock.h>

#include "vicon/core/error.h"

namespace vicon {
namespace {

using enum FindingKind;
using testing::HasSubstr;

constexpr double kNone = -1;

JudgedFinding thing(FindingKind kind, double size_mm = kNone, std::optional<Attenuation> attenuation = {})
{
    return {"f1", kind, size_mm < 0 ? std::nullopt : std::optional(size_mm), attenuation};
}

std::vector<JudgedFinding> polyps(std::vector<double> sizes_mm)
{
    std::vector<JudgedFinding> out;
    for (const double size_mm : sizes_mm) {
        out.push_back({"f", polyp, size_mm});
        out.back().id += std::to_string(out.size());
    }
    return out;
}

struct ColonCase {
    const char* what;
    const char* source;
    JudgedStudy study;
    const char* expected;  ///< empty: none can be proposed
    const char* reason;    ///< among the words
};

JudgedStudy of(std::vector<JudgedFinding> findings)
{
    return {.findings = std::move(findings)};
}

JudgedStudy collapsed(std::vector<std::string> parts, std::vector<JudgedFinding> findings = {})
{
    return {.findings = std::move(findings), .collapsed_parts = std::move(parts)};
}

JudgedStudy inadequate(std::vector<JudgedFinding> findings = {})
{
    return {.findings = std::move(findings), .inadequate = true};
}

JudgedFinding narrowing(FindingKind kind, double size_mm = kNone)
{
    JudgedFinding f = thing(kind, size_mm);
    f.narrows_lumen = true;
    return f;
}

JudgedFinding invading(FindingKind kind, double size_mm = kNone)
{
    JudgedFinding f = thing(kind, size_mm);
    f.invades = true;
    return f;
}

std::vector<ColonCase> casesOfC1()
{
    return {
        {"nothing", "2005, 2023", of({}), "C1", "no polyp of 6 mm or more"},
        {"a diminutive polyp", "2005, 2023", of(polyps({4})), "C1", "smaller: f1, polyp of 4.0 mm"},
        {"below the border", "2005, 2023", of(polyps({5.9})), "C1", "within 0.5 mm of the 6 mm border"},
        {"printed as 5.9", "house: as printed", of(polyps({5.94})), "C1", "polyp of 5.9 mm"},
        {"many diminutive polyps", "2005, 2023", of(polyps({5, 5, 5, 5, 5})), "C1", "no polyp of 6 mm"},
        {"a lipoma of 25 mm", "2005, 2023", of({thing(lipoma, 25, Attenuation::fat)}), "C1", "benign: f1, lipoma"},
        {"a diverticulum", "2005, 2023", of({thing(diverticulum, 8)}), "C1", "benign: f1, diverticulum"},
        {"an inverted diverticulum", "2005, 2023", of({thing(inverted_diverticulum, 12)}), "C1",
         "benign: f1, inverted diverticulum"},
        {"stool of 15 mm", "2005: no lesion", of({thing(stool, 15)}), "C1", "benign: f1, stool"},
        {"the ileocaecal valve", "2005: no lesion", of({thing(valve, 28)}), "C1", "benign: f1, valve"},
        {"something small and indeterminate", "2005: 6 mm", of({thing(indeterminate, 5)}), "C1", "smaller: f1"},
        {"something else", "house: the reader's to weigh", of({thing(other, 20)}), "C1",
         "not weighed, for the reader to judge: f1"},
        {"a marker of no finding",
         "house: nothing is denied",
         {.loose_markers = {"m3"}},
         "",
         "markers not assigned to a finding: m3"},
        {"a marker of no finding beside a large polyp",
         "house: nothing is denied",
         {.findings = polyps({12}), .loose_markers = {"m3"}},
         "C3",
         "12.0 mm"},
        {"distension not measured", "house: said", {.parts_known = false}, "C1", "distension was not measured"},
    };
}

std::vector<ColonCase> casesOfC2()
{
    return {
        {"on the border", "2005, 2023", of(polyps({6})), "C2a", "one polyp of 6 to 9 mm: f1, polyp of 6.0 mm"},
        {"printed as 6.0", "house: as printed", of(polyps({5.96})), "C2a", "polyp of 6.0 mm"},
        {"one of 7 mm", "2005, 2023", of(polyps({7})), "C2a", "one polyp"},
        {"two of 8 mm", "2005, 2023", of(polyps({8, 8})), "C2a", "two polyps"},
        {"below 10 mm", "2005, 2023", of(polyps({9.9})), "C2a", "within 0.5 mm of the 10 mm border"},
        {"9.94 mm", "house: as printed", of(polyps({9.94})), "C2a", "polyp of 9.9 mm"},
        {"two, and small ones", "2005, 2023", of(polyps({6, 9, 5.9, 5.9})), "C2a", "two polyps"},
        {"indeterminate, 6 mm or more", "2005, 2023", of({thing(indeterminate, 8)}), "C2a", "indeterminate: f1"},
        {"indeterminate and large", "2005, 2023", of({thing(indeterminate, 14)}), "C2a", "indeterminate: f1"},
        {"a polyp as light as fat", "house: as called, with a remark", of({thing(polyp, 8, Attenuation::fat)}), "C2a",
         "a lipoma?"},
        {"a polyp beside a stricture", "house: the polyp leads", of({thing(polyp, 7), thing(diverticular_stricture)}),
         "C2a", "also f1, diverticular stricture"},
        {"a polyp beside a lipoma", "2005, 2023", of({thing(polyp, 7), thing(lipoma, 20)}), "C2a", "one polyp"},
        {"a diverticular stricture", "2023", of({thing(diverticular_stricture)}), "C2b",
         "likely benign diverticular finding"},
        {"with a small polyp", "2023", of({thing(diverticular_stricture), thing(polyp, 4)}), "C2b", "diverticular"},
        {"narrow as strictures are", "2023", of({narrowing(diverticular_stricture)}), "C2b", "diverticular stricture"},
    };
}

std::vector<ColonCase> casesOfC3()
{
    return {
        {"on the border of 10 mm", "2005, 2023", of(polyps({10})), "C3", "f1, polyp of 10.0 mm"},
        {"printed as 10.0", "house: as printed", of(polyps({9.95})), "C3", "polyp of 10.0 mm"},
        {"three of 6 to 9 mm", "2005, 2023", of(polyps({6, 7, 9.9})), "C3", "3 polyps of 6 to 9 mm"},
        {"four of them", "2005, 2023", of(polyps({6, 7, 8, 9})), "C3", "4 polyps of 6 to 9 mm"},
        {"below a mass", "2005, 2023", of(polyps({29.9})), "C3", "within 0.5 mm of the 30 mm border"},
        {"large, with a stricture", "2023", of({thing(polyp, 12), thing(diverticular_stricture)}), "C3", "12.0 mm"},
        {"large, one without a size", "house", of({thing(polyp, 12), thing(polyp)}), "C3", "12.0 mm"},
    };
}

std::vector<ColonCase> casesOfC4()
{
    return {
        {"30 mm is a mass", "2023", of(polyps({30})), "C4", "polyp of 30.0 mm"},
        {"a mass", "2005, 2023", of({thing(mass, 45)}), "C4", "f1, mass of 45.0 mm"},
        {"a mass without a size", "2005", of({thing(mass)}), "C4", "f1, mass"},
        {"called a mass, 20 mm", "house: as called, with a remark", of({thing(mass, 20)}), "C4", "smaller than 30 mm"},
        {"a polyp that narrows the lumen", "2005, 2023", of({narrowing(polyp, 15)}), "C4", "compromises the lumen"},
        {"invasion", "2005, 2023", of({invading(polyp, 22)}), "C4", "reaches beyond the wall"},
        {"a stricture that invades", "2023", of({invading(diverticular_stricture)}), "C4", "reaches beyond the wall"},
    };
}

/// Incomplete ones, and those that no category is proposed for.
std::vector<ColonCase> casesWithoutAnAnswer()
{
    return {
        {"a part collapsed in both positions", "2005, 2023", collapsed({"sigmoid"}), "C0",
         "sigmoid collapsed in every position scanned"},
        {"two parts", "2005, 2023", collapsed({"sigmoid", "descending"}), "C0", "sigmoid, descending collapsed"},
        {"collapsed in one position only", "2005, 2023", collapsed({}), "C1", "no polyp"},
        {"bad preparation", "2005, 2023", inadequate(), "C0", "a lesion of 10 mm or more cannot be excluded"},
        {"priors awaited", "2005, 2023", {.priors_awaited = true}, "C0", "earlier studies are awaited"},
        {"nothing prepared", "2023", {.unprepared = true}, "C0", "no scan was prepared that shows a colon"},
        {"bad preparation, a polyp of 8 mm", "house: C0 before C2", inadequate(polyps({8})), "C0",
         "found nevertheless: f1, polyp of 8.0 mm"},
        {"collapsed, a polyp of 12 mm", "house: C3 before C0", collapsed({"sigmoid"}, polyps({12})), "C3",
         "the study is incomplete as well: sigmoid collapsed"},
        {"bad preparation, a mass", "house: C4 before C0", inadequate({thing(mass, 50)}), "C4",
         "the study is incomplete as well"},
        {"a polyp without a size", "house", of({thing(polyp)}), "", "no size was measured of f1"},
        {"indeterminate without a size", "house", of({thing(indeterminate)}), "", "no size was measured of f1"},
    };
}

std::vector<ColonCase> colonCases()
{
    std::vector<ColonCase> all;
    for (const auto& cases : {casesOfC1(), casesOfC2(), casesOfC3(), casesOfC4(), casesWithoutAnAnswer()})
        all.insert(all.end(), cases.begin(), cases.end());
    return all;
}

TEST(ColonCategory, IsProposedWithItsReason)
{
    ASSERT_GE(colonCases().size(), 40u);
    for (const ColonCase& c : colonCases()) {
        SCOPED_TRACE(std::string(c.what) + " (" + c.source + ")");
        const auto proposal = proposeColonCategory(c.study);
        EXPECT_EQ(proposal.category ? nameOf(*proposal.category) : "", c.expected) << proposal.reason;
        EXPECT_THAT(proposal.reason, HasSubstr(c.reason));
    }
}

TEST(ColonCategory, NeverFallsWhenAPolypGrows)
{
    for (const double others_mm : {0.0, 5.0, 7.0}) {
        int last = -1;
        for (int tenths = 10; tenths < 400; ++tenths) {
            const auto proposal = proposeColonCategory(of(polyps({tenths / 10.0, others_mm, others_mm})));
            ASSERT_TRUE(proposal.category);
            EXPECT_GE(int(*proposal.category), last) << tenths / 10.0;
            last = int(*proposal.category);
        }
        EXPECT_EQ(nameOf(ColonCategory(last)), "C4");
    }
}

TEST(ExtracolonicCategory, IsTheHighestOfItsFindings)
{
    using enum ExtracolonicCategory;
    const struct {
        std::vector<ExtracolonicCategory> findings;
        bool limited;
        const char* expected;
        const char* reason;
    } cases[] = {
        {{}, false, "E1/E2", "no finding outside the colon was stated"},
        {{e1, e1}, false, "E1/E2", "only unimportant"},
        {{e1, e3}, false, "E3", "1 finding outside the colon of category E3"},
        {{e3, e4, e4}, false, "E4", "2 findings"},
        {{}, true, "E0", "cannot be judged"},
        {{e1}, true, "E0", "cannot be judged"},
        {{e4}, true, "E4", "1 finding"},
        {{e0, e3}, false, "E3", "1 finding"},
    };
    for (const auto& c : cases) {
        const auto proposal =
            proposeExtracolonicCategory({.extracolonic = c.findings, .extracolonic_limited = c.limited});
        ASSERT_TRUE(proposal.category);
        EXPECT_EQ(nameOf(*proposal.category), c.expected);
        EXPECT_THAT(proposal.reason, HasSubstr(c.reason));
    }
}

TEST(Categories, HaveNamesThatAreReadBack)
{
    for (const char* name : {"C0", "C1", "C2a", "C2b", "C3", "C4"})
        EXPECT_EQ(nameOf(colonCategoryFrom(name)), name);
    EXPECT_EQ(nameOf(extracolonicCategoryFrom("E2")), "E1/E2");
    EXPECT_THROW(colonCategoryFrom("C2"), Error);
    EXPECT_THROW(extracolonicCategoryFrom("E5"), Error);
}

TEST(Categories, AdviseTheKindOfExaminationThatWasMade)
{
    EXPECT_EQ(adviceFor(ColonCategory::c2a, Quantity::density), "Repeat CT colonography in 3 years, or colonoscopy.");
    EXPECT_EQ(adviceFor(ColonCategory::c2a, Quantity::signal), "Repeat MR colonography in 3 years, or colonoscopy.");
    EXPECT_THAT(adviceFor(ColonCategory::c2b, Quantity::signal), HasSubstr("MR colonography in 5 years"));
}

}  // namespace
}  // namespace vicon
