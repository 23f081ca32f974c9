// What the PDF says of findings, and how it says that it is signed.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "pdf_fixture.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/statements.h"

namespace vicon::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class PdfOfFindings : public PdfWriter {
protected:
    void addFindings(int count)
    {
        addMarkers(2 * count);
        for (int n = 1; n <= count; ++n)
            samples::addFinding(content_, 2 * n - 1);
    }
    void expectWellMade(const PdfResult& result)
    {
        EXPECT_THAT(result.warnings, IsEmpty());
        expectSound(pdf_);
        expectTidy(pdf_);
    }
    static ReportVersion version(int number, ReportState state)
    {
        return {.version = number, .state = state, .person = "anna", .at = "2026-11-21T08:15:30Z"};
    }
};

TEST_F(PdfOfFindings, SaysOnPageOneWhatAReferringPhysicianNeeds)
{
    addFindings(1);
    content_.read.assessment.colon_category = {ColonCategory::c3, "growing"};
    content_.read.colon_proposal = {ColonCategory::c2a, "one polyp of 6 to 9 mm"};
    content_.read.assessment.extracolonic = {{"kidney", "a cyst", ExtracolonicCategory::e1}};
    expectWellMade(write());
    const std::string first = samples::pageTexts(pdf_).at(0);
    for (const char* what : {"Finding 1: polyp, sessile, 6.7 mm, sigmoid, 3 o'clock.", "C3: polyp, possibly advanced",
                             "proposed: C2a (one polyp of 6 to 9 mm)", "reason: growing", "Colonoscopy.",
                             "Findings in the colon", "polyp, sessile", "6.7 mm"})
        EXPECT_THAT(first, HasSubstr(what));
    EXPECT_LT(first.find("C3: polyp"), first.find("Findings in the colon"));
}

TEST_F(PdfOfFindings, ProposesNoCategoryOfACaseThatNobodyRead)
{
    content_.read.markers.clear();
    content_.read.assessment = {};
    content_.read.colon_proposal = {ColonCategory::c1, "no polyp of 6 mm or more"};
    expectWellMade(write());
    EXPECT_THAT(samples::pageTexts(pdf_).at(0), HasSubstr("this case was not read yet"));
    EXPECT_THAT(samples::pageTexts(pdf_).at(0), testing::Not(HasSubstr("C1")));
    content_.read.assessment.impression = "Normal colon.";
    expectWellMade(write());
    EXPECT_THAT(samples::pageTexts(pdf_).at(0), HasSubstr("proposed: C1 (no polyp of 6 mm or more)"));
}

TEST_F(PdfOfFindings, ImpressionTellsOfTheGravestFirstAndWhyAStudyIsNoAnswer)
{
    addFindings(3);
    auto& all = content_.read.findings;
    for (std::size_t n = 0; n < all.size(); ++n)
        all[n].facts.size_mm = 6.0 + 2.0 * double(n);
    all[1].finding.kind = FindingKind::mass;
    all[1].facts.size_mm.reset();
    const std::string said = impressionText(content_.read);
    EXPECT_LT(said.find("Finding 3: mass"), said.find("Finding 5: polyp"));
    EXPECT_LT(said.find("Finding 5: polyp"), said.find("Finding 1: polyp"));
    for (auto& one : all) {
        one.finding.kind = FindingKind::polyp;
        one.facts.size_mm = 7;
    }
    const std::string alike = impressionText(content_.read);
    EXPECT_LT(alike.find("Finding 1: polyp"), alike.find("Finding 3: polyp")) << "in their order";
    EXPECT_LT(alike.find("Finding 3: polyp"), alike.find("Finding 5: polyp"));
    all.clear();
    content_.read.assessment.inadequate = content_.read.assessment.priors_awaited = true;
    content_.read.assessment.colon_category = {ColonCategory::c0, ""};
    content_.read.parts = {{"s1", ColonPart::sigmoid, Distension::collapsed, false}};
    EXPECT_EQ(impressionText(content_.read),
              "The study is inadequate: a lesion of 10 mm or more cannot be excluded.\n"
              "Collapsed in every position scanned: sigmoid.\nEarlier studies are awaited.");
}

TEST_F(PdfOfFindings, HeadsEachFindingWithItsSizeAndLeadsToItByABookmark)
{
    addFindings(2);
    expectWellMade(write());
    int heads = 0;
    for (const std::vector<samples::Word>& words : samples::wordsByPage(pdf_))
        for (std::size_t n = 0; n + 1 < words.size(); ++n) {
            if (words[n].text != "Finding" || words[n + 1].text.back() != ':' || words[n].left > 70)
                continue;
            const bool sized = std::any_of(words.begin(), words.end(), [&](const samples::Word& w) {
                return w.text == "mm" && w.left > 400 && std::abs(w.top - words[n].top) < 6;
            });
            heads += sized ? 1 : 0;
        }
    EXPECT_EQ(heads, 2);
    const auto qpdf = support::runCommand("qpdf --json --json-key=outlines " + pdf_.string());
    const auto outlines = nlohmann::json::parse(qpdf.output).at("outlines");
    ASSERT_FALSE(outlines.empty());
    std::vector<std::string> titles, below;
    for (const auto& entry : outlines) {
        EXPECT_TRUE(entry.at("destpageposfrom1").is_number()) << entry.at("title");
        titles.push_back(entry.at("title"));
        for (const auto& kid : entry.at("kids"))
            below.push_back(titles.back() + " / " + kid.at("title").get<std::string>());
    }
    EXPECT_THAT(titles,
                testing::IsSupersetOf({"Impression", "Findings in the colon", "Findings, one by one", "Scans"}));
    EXPECT_THAT(below, testing::ElementsAre("Findings, one by one / Finding 1 (polyp)",
                                            "Findings, one by one / Finding 3 (polyp)"));
}

TEST_F(PdfOfFindings, SaysEveryNumberOfAFinding)
{
    addFindings(1);
    content_.read.findings[0].finding.height_mm = 2.5;
    content_.read.findings[0].finding.volume_ml = 0.4;
    write();
    std::string text = samples::textOf(pdf_);
    std::replace(text.begin(), text.end(), '\n', ' ');
    for (const char* what :
         {"6.7 mm (largest diameter in the best plane), surface 6.6 mm, height 2.5 mm, volume 0.400 ml",
          "20 mm from the", "1580 mm from the", "40 mm from the", "best plane 6.4 mm", "surface 6.3 mm", "43 HU, mean",
          "42 HU", "estimated: about 3 cm (1 to 4 cm)", "what f1 is like", "prone (series 3), m1",
          "prone (series 3), m2", "From inside", "Below the wall, in the circle", "Slices: axial, coronal, sagittal"})
        EXPECT_THAT(text, HasSubstr(what));
}

TEST_F(PdfOfFindings, ListsMarkersOfNoFindingAsSuch)
{
    addFindings(1);
    EXPECT_THAT((write(), samples::textOf(pdf_)), Not(HasSubstr("Markers not assigned to a finding")));
    addMarkers(3);
    content_.markers.erase(content_.markers.begin() + 2, content_.markers.begin() + 4);  // m1 and m2 again
    content_.read.loose_markers = {"m3"};
    expectWellMade(write());
    const std::string text = samples::textOf(pdf_);
    EXPECT_THAT(text, AllOf(HasSubstr("Markers not assigned to a finding"), HasSubstr("Marker m3,"),
                            Not(HasSubstr("Marker m1,"))));
}

TEST_F(PdfOfFindings, ShowsOnlyThePicturesThatTheReaderChose)
{
    addFindings(1);
    content_.read.findings[0].finding.pictures = {"m2"};
    write();
    EXPECT_THAT(samples::textOf(pdf_),
                AllOf(HasSubstr("\nprone (series 3), m2"), Not(HasSubstr("\nprone (series 3), m1"))));
}

TEST_F(PdfOfFindings, HoldsTwelveOfThemAndNamesTheirPages)
{
    addFindings(12);
    expectWellMade(write());
    const std::string table = support::runCommand("pdftotext -layout " + pdf_.string() + " -").output;
    const std::vector<std::string> pages = samples::pageTexts(pdf_);
    for (const FindingWithFacts& f : content_.read.findings) {
        const std::string number = std::to_string(f.finding.number());
        std::smatch found;
        ASSERT_TRUE(
            std::regex_search(table, found, std::regex("\n *" + number + " +polyp, sessile .*cm +2 +([0-9]+)\n")))
            << number;
        EXPECT_THAT(pages.at(std::stoul(found[1]) - 1), HasSubstr("Finding " + number + ": polyp, sessile\n"));
    }
}

TEST_F(PdfOfFindings, OfANormalStudyIsOnePage)
{
    for (const std::size_t scans : {1u, 2u}) {
        while (content_.scans.size() < scans) {
            content_.scans.push_back(content_.scans[0]);
            content_.scans.back().scan.id = "s2";
        }
        content_.read.parts.clear();
        samples::makeNormal(content_);
        for (ScanEntry& entry : content_.scans)
            entry.quality->noise_hu = 14;
        for (const Paper paper : {Paper::a4, Paper::letter}) {
            const PdfResult result = write({.paper = paper});
            EXPECT_EQ(result.pages, 1) << scans << " scans on " << nameIn(kPaperNames, paper);
            expectSound(pdf_);
        }
        EXPECT_THAT(samples::textOf(pdf_),
                    AllOf(HasSubstr("No polyp of 6 mm or more was found."), HasSubstr("C1: normal colon"),
                          HasSubstr("Continue routine screening."), HasSubstr("No findings were stated"),
                          HasSubstr("good in every segment and position"), HasSubstr("whole colon"),
                          HasSubstr("colon of "), HasSubstr("noise ")))
            << "each scan in a line";
    }
}

TEST_F(PdfOfFindings, OfOneScanTellsItsPartsBesideTheMapAndNowhereElse)
{
    for (const int found : {0, 1, 12}) {
        content_.markers.clear();
        content_.read.findings.clear();
        addFindings(found);
        content_.read.parts.clear();
        samples::makeNormal(content_);
        expectWellMade(write());
        const auto pages = samples::wordsByPage(pdf_);
        std::vector<samples::Word> titles;
        for (const auto& words : pages)
            for (const samples::Word& word : words)
                if (word.text == "Radius")
                    titles.push_back(word);
        ASSERT_EQ(titles.size(), 1u) << found;
        const auto caption = std::find_if(pages[0].begin(), pages[0].end(),
                                          [](const samples::Word& word) { return word.text == "Prone,"; });
        ASSERT_NE(caption, pages[0].end());
        EXPECT_GT(titles[0].left, 45 + 90) << "right of the map, which is 90 pixels wide";
        EXPECT_LT(titles[0].top, caption->top) << "beside it";
    }
}

TEST_F(PdfOfFindings, CutsNoWordOfWhatAFindingIsInTheTable)
{
    addFindings(1);
    Finding& finding = content_.read.findings[0].finding;
    finding.kind = FindingKind::inverted_diverticulum;
    finding.morphology = Morphology::pedunculated;
    finding.attenuation = Attenuation::soft_tissue;
    expectWellMade(write());
    EXPECT_THAT(samples::pageTexts(pdf_).at(0), Not(HasSubstr("\u2026")));
}

TEST_F(PdfOfFindings, ShowsTheColonLaidStraightWithItsPartsAndWhereFindingsLie)
{
    addFindings(3);
    samples::addLumen(content_.scans[0], 600, 640);
    content_.scans.push_back(content_.scans[0]);
    content_.scans[1].scan.id = "s2";
    content_.scans[1].scan.series.patient_position = "HFS";
    expectWellMade(write());
    const std::vector<std::string> pages = samples::pageTexts(pdf_);
    const auto page = std::find_if(pages.begin(), pages.end(), [](const std::string& text) {
        return text.find("Distension and fluid along the colon") != std::string::npos;
    });
    ASSERT_NE(page, pages.end());
    EXPECT_THAT(*page, AllOf(HasSubstr("under 3.0 mm of radius"), HasSubstr("From the rectum"), HasSubstr("30 mm")));
    std::vector<samples::Word> words = samples::wordsByPage(pdf_).at(std::size_t(page - pages.begin()));
    const auto unit = std::find_if(words.begin(), words.end(), [](const auto& w) { return w.text == "tagged"; });
    std::erase_if(words, [top = unit->top](const samples::Word& w) {
        return w.top <= top || w.top > 795;
    });  // above it, and the footer
    const auto leftOf = [&](const std::string& text) {
        const auto word = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.text == text; });
        return word == words.end() ? -1 : (word->left + word->right) / 2;
    };
    double last = 0;
    for (const char* part : {"rectum", "sigmoid", "descending", "transverse", "ascending", "caecum"}) {
        EXPECT_GT(leftOf(part), last) << part;
        last = leftOf(part);
    }
    // Finding 5 lies at 100 and 120 mm, finding 1 at 20 and 40; the other scan shows none.
    const auto numbers = [&](const std::string& text) {
        return std::count_if(words.begin(), words.end(), [&](const auto& w) { return w.text == text; });
    };
    EXPECT_EQ(numbers("5"), 2);
    EXPECT_EQ(numbers("1"), 2);
    EXPECT_LT(leftOf("1"), leftOf("5"));
}

TEST_F(PdfOfFindings, SaysOnEveryPageWhetherItIsSigned)
{
    addFindings(2);
    const struct {
        std::optional<ReportVersion> version;
        std::vector<std::string> said, not_said;
    } cases[] = {
        {{}, {kDraftLine, "draft 2"}, {"Signed", "PRELIMINARY"}},
        {version(1, ReportState::preliminary), {kPreliminaryLine, "version 1"}, {"Signed", "DRAFT"}},
        {version(2, ReportState::final),
         {"Signed by anna, 2026-11-21 08:15 UTC, version 2", "no medical device"},
         {"DRAFT", "PRELIMINARY"}},
    };
    for (const auto& c : cases) {
        content_.version = c.version;
        expectWellMade(write());
        for (const std::string& page : samples::pageTexts(pdf_)) {
            for (const std::string& what : c.said)
                EXPECT_THAT(page, HasSubstr(what));
            for (const std::string& what : c.not_said)
                EXPECT_THAT(page, Not(HasSubstr(what)));
        }
    }
}

TEST_F(PdfOfFindings, SaysWhatItAmendsAndWhy)
{
    addFindings(1);
    content_.version = version(2, ReportState::amended);
    content_.version->replaces = 1;
    content_.version->reason = "size read again";
    expectWellMade(write());
    EXPECT_THAT(samples::pageTexts(pdf_).at(0), HasSubstr("Amends version 1, which stays: size read again"));
}

}  // namespace
}  // namespace vicon::report
