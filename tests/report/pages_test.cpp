// The kinds of reports that there are: each is sound, tidy, and says every number of its case.
#include <algorithm>
#include <array>
#include <cstdio>

#include "layout_check.h"
#include "pdf_fixture.h"
#include "quality_table.h"
#include "vicon/core/file.h"
#include "vicon/picture/png_file.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

using testing::HasSubstr;

std::string fixed(double value, int decimals)
{
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

/// Every number that was measured or said, as it is printed.
std::vector<std::string> numbersOf(const ReportContent& content)
{
    std::vector<std::string> out;
    const auto add = [&](const std::optional<double>& value, int decimals, const char* unit) {
        if (value)
            out.push_back(fixed(*value, decimals) + " " + unit);
    };
    for (const auto& [finding, facts] : content.read.findings) {
        add(facts.size_mm, 1, "mm");
        add(facts.size_2d_mm, 1, "mm");
        add(facts.size_3d_mm, 1, "mm");
        add(finding.height_mm, 1, "mm");
        add(finding.volume_ml, finding.volume_ml ? volumeDecimals(*finding.volume_ml) : 0, "ml");
        add(facts.mean_hu, 0, "HU");
        if (facts.endoscope)
            out.push_back(endoscopeWords(facts));
        for (const FindingSight& sight : facts.sights) {
            add(sight.station_mm, 0, "mm from the rectal end");
            add(sight.from_caecum_mm, 0, "mm from the caecal end");
            add(100 * sight.fraction, 1, "%");
            add(sight.size_2d_mm, 1, "mm");
            add(sight.size_3d_mm, 1, "mm");
            add(sight.mean_hu, 0, "HU");
            out.push_back(positionLetters(sight.position_mm));
            if (sight.clock_hour)
                out.push_back(std::to_string(*sight.clock_hour) + " o'clock");
        }
    }
    add(content.read.assessment.dose_mgy_cm, 1, "mGy cm");
    add(content.read.assessment.coverage_percent, 1, "%");
    add(content.read.assessment.reading_minutes, 1, "min");
    for (const ScanEntry& entry : content.scans) {
        add(entry.skeleton_length_mm, 0, "mm");
        if (entry.quality)
            add(entry.quality->noise_hu, 0, "HU");
        for (const QualityRow& row : qualityRows({&entry}))
            for (const std::string& cell : {row.scans[0]->radius, row.scans[0]->fluid})
                out.push_back(cell);
        if (entry.quality && !(entry.quality->whole.adequate && entry.quality->whole.collapsed_mm <= 0))
            for (const QualityRow& row : qualityRows({&entry}))
                out.push_back(row.scans[0]->collapsed);
    }
    return out;
}

struct Page {
    const char* name;
    int findings;
    int scans;
    void (*change)(ReportContent&);
    int most_pages;
    const char* site = "Example Hospital";
    bool keeps_layout = false;
};

/// Numbers of each part that no other part has.
void measure(ReportContent& content)
{
    samples::makeNormal(content);
    double scan = 0;
    for (ScanEntry& entry : content.scans) {
        ++scan;
        entry.quality->noise_hu = 13 + scan;
        entry.skeleton_length_mm = 1600 + scan;
        double n = 0;
        for (StretchQuality& part : entry.quality->parts) {
            ++n;
            part.median_radius_mm = 10 + n + 20 * scan;
            part.fluid_ml = 7 * n + scan;
        }
    }
    Assessment& said = content.read.assessment;
    said.technique = "Low dose, 120 kV, carbon dioxide by pump, faecal tagging by mouth.";
    said.dose_mgy_cm = 287.4;
    said.coverage_percent = 94.1;
    said.reading_minutes = 11.5;
}

void collapse(ReportContent& content)
{
    for (ScanEntry& entry : content.scans) {
        StretchQuality& sigmoid = entry.quality->parts[1];
        sigmoid.collapsed_mm = entry.quality->whole.collapsed_mm = 83;
        sigmoid.collapsed_fraction = 0.24;
        sigmoid.adequate = entry.quality->whole.adequate = false;
        entry.quality->reason = "sigmoid collapsed over 83 mm";
        samples::addLumen(entry, 300, 383);
    }
    for (PartState& part : content.read.parts)
        if (part.part == ColonPart::sigmoid)
            part.distension = Distension::collapsed;
    content.read.assessment.inadequate = true;
    content.read.assessment.preparation = Grade::inadequate;
    content.read.assessment.colon_category = {ColonCategory::c0, ""};
    content.read.colon_proposal = {ColonCategory::c0, "sigmoid is collapsed in every position"};
}

const Page kPages[] = {
    {"Normal", 0, 2, [](ReportContent&) {}, 1},
    {"OneScanOnly", 0, 1, [](ReportContent&) {}, 1, "Example Hospital", true},
    {"OneFinding", 1, 2, [](ReportContent&) {}, 3, "Example Hospital", true},
    {"OneFindingInOneScan", 1, 1, [](ReportContent&) {}, 3, "Example Hospital", true},
    {"TwelveFindings", 12, 2, [](ReportContent&) {}, 15},
    {"TwelveFindingsInOneScan", 12, 1, [](ReportContent&) {}, 15},
    {"MarkersOfNoFinding", 3, 2,
     [](ReportContent& content) {
         content.read.findings.clear();
         for (const MarkerEntry& entry : content.markers)
             content.read.loose_markers.push_back(entry.marker.id);
     },
     7},
    {"AMass", 1, 2,
     [](ReportContent& content) {
         Finding& mass = content.read.findings[0].finding;
         mass.kind = FindingKind::mass;
         mass.morphology = Morphology::mass;
         mass.narrows_lumen = mass.invades = true;
         mass.height_mm = 18.5;
         mass.volume_ml = 14.7;
         content.read.assessment.extracolonic = {{"liver", "lesion of 31 mm in segment 7", ExtracolonicCategory::e4}};
     },
     3},
    {"Inadequate", 0, 2, collapse, 2, "Example Hospital", true},
    {"Amended", 1, 2,
     [](ReportContent& content) {
         content.version = {.version = 2,
                            .state = ReportState::amended,
                            .replaces = 1,
                            .reason = "size read again",
                            .person = "anna",
                            .at = "2026-11-21T08:15:30Z"};
     },
     3},
    {"ALongName", 1, 2,
     [](ReportContent& content) {
         std::string& name = content.read.record.patient.name;
         for (int n = 0; n < 24; ++n)
             name += " Bartholomew" + std::to_string(n);
     },
     3},
    {"LongTextsOfASite", 0, 1,
     [](ReportContent& content) {
         Assessment& said = content.read.assessment;
         for (int n = 0; n < 12; ++n) {
             said.technique += " Carbon dioxide by pump, in the positions that the patient could take.";
             said.extracolonic.push_back({"kidney", "cyst without septa, seen before", ExtracolonicCategory::e4});
         }
     },
     3, "Example Hospital of the United Communes along the Upper River and of the Two Valleys beyond it", true},
    {"NoBirthDate", 1, 2, [](ReportContent& content) { content.read.record.patient.birth_date.clear(); }, 3},
};

/// Where the lowest word of page one stands that is not in the footer, as a share of the page's height.
double filledShare(const std::filesystem::path& pdf, double page_height)
{
    constexpr double kFooter = 45;  // points
    double lowest = 0;
    const std::vector<std::vector<samples::Word>> pages = samples::wordsByPage(pdf);
    for (const samples::Word& word : pages.at(0))
        if (word.bottom < page_height - kFooter)
            lowest = std::max(lowest, word.bottom);
    return lowest / page_height;
}

class Pages : public PdfWriter, public testing::WithParamInterface<Page> {
protected:
    void SetUp() override
    {
        const Page& page = GetParam();
        while (int(content_.scans.size()) < page.scans) {
            content_.scans.push_back(content_.scans[0]);
            content_.scans.back().scan.id = "s2";
            content_.scans.back().scan.series.patient_position = "HFS";
        }
        addMarkers(2 * page.findings);
        for (int n = 1; n <= page.findings; ++n)
            samples::addFinding(content_, 2 * n - 1);
        measure(content_);
        page.change(content_);
    }
};

constexpr std::size_t kLeastWords = 45;  // of the last page, with what stands on every page

TEST_P(Pages, AreSoundAndTidyAndSayEveryNumber)
{
    for (const Paper paper : {Paper::a4, Paper::letter}) {
        const PdfResult result = write({.paper = paper, .site = {GetParam().site, "1 Main Street, Exampleton"}});
        EXPECT_THAT(result.warnings, testing::IsEmpty());
        EXPECT_LE(result.pages, GetParam().most_pages) << nameIn(kPaperNames, paper);
        expectSound(pdf_);
        if (paper == Paper::a4) {
            expectTidy(pdf_);
            if (GetParam().keeps_layout)
                samples::expectLayout(pdf_, GetParam().name);
        } else {
            expectTidy(pdf_, 612, 792);
        }
        EXPECT_THAT(samples::pageTexts(pdf_).back(), HasSubstr(content_.version ? "Signed by" : "Draft, not signed"));
        EXPECT_GT(samples::wordsByPage(pdf_).back().size(), kLeastWords) << "no page for the signature alone";
        if (content_.version && content_.version->replaces != 0) {
            EXPECT_THAT(samples::pageTexts(pdf_).at(0), HasSubstr("CT colonography report, amended"));
        }
        if (GetParam().findings > 0) {
            EXPECT_GT(filledShare(pdf_, paper == Paper::a4 ? 842 : 792), 0.75) << nameIn(kPaperNames, paper);
        }
        std::string text =
            samples::textOf(pdf_) + support::runCommand("pdftotext -layout " + pdf_.string() + " -").output;
        std::replace(text.begin(), text.end(), '\n', ' ');
        for (const std::string& number : numbersOf(content_))
            EXPECT_THAT(text, HasSubstr(number));
        EXPECT_THAT(text, HasSubstr("Example Hospital"));
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Pages, testing::ValuesIn(kPages), [](const auto& info) { return info.param.name; });

TEST_F(PdfWriter, ShowsTheSitesLogoOrSaysThatItCannot)
{
    const std::filesystem::path logo = folder_ / "logo.png";
    const auto pictures = [&](const ReportOptions& options) {
        write(options);
        return support::runCommand("pdfimages -list " + pdf_.string()).output;
    };
    EXPECT_THAT(pictures({}), testing::Not(HasSubstr(" 64 ")));
    samples::writeQuarters(logo, 64, 32, {{{10, 60, 120}, {200, 200, 200}, {200, 200, 200}, {10, 60, 120}}});
    EXPECT_THAT(pictures({.logo = logo.string()}), testing::ContainsRegex(" 64 +32 "));
    const PdfResult result = write({.logo = (folder_ / "none.png").string()});
    EXPECT_THAT(result.warnings, testing::ElementsAre(HasSubstr("the logo picture cannot be read")));
}

TEST_F(PdfWriter, PicturesThatWereBegunAreTheSameInTheFile)
{
    addMarkers(2);
    write();
    const std::string alone = readFile(pdf_);
    PrintPictures begun;
    for (const std::filesystem::path& file :
         {content_.scans[0].overview_picture, content_.markers[0].endoscopic_picture})
        begun.begin(file, std::make_shared<picture::Picture>(picture::readPng(file)));
    writePdf(content_, pdf_, {}, &begun);
    EXPECT_EQ(readFile(pdf_), alone);
}

}  // namespace
}  // namespace vicon::report
