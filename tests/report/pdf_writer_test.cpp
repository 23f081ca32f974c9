#include "vicon/report/pdf_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>

#include "pdf_fixture.h"
#include "vicon/core/file.h"
#include "vicon/report/statements.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon::report {
namespace {

using support::runCommand;
using support::TemporaryFolder;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Every page says whose report it is, that it is a draft, and which page of how many.
void expectFurniture(const fs::path& pdf, int pages, const std::string& name)
{
    const std::vector<std::string> texts = samples::pageTexts(pdf);
    ASSERT_EQ(int(texts.size()), pages);
    for (int page = 1; page <= pages; ++page)
        for (const std::string& what :
             {name, std::string("ID PID-4711"), std::string("born 1961-04-12"), std::string("Study of 2026-11-20"),
              std::string(kDraftLine), "Page " + std::to_string(page) + " of " + std::to_string(pages),
              std::string("2026-11-21 08:15 UTC with VICON 0.1.0")})
            EXPECT_THAT(texts[std::size_t(page - 1)], HasSubstr(what)) << "page " << page;
}

TEST_F(PdfWriter, WritesASoundFileWithEmbeddedFontsAndNoPatientInItsMetadata)
{
    addMarkers(2);
    const PdfResult result = write();
    EXPECT_THAT(result.warnings, IsEmpty());
    expectSound(pdf_);
    expectFurniture(pdf_, result.pages, "Adams, John Robert");
    const std::string fonts = runCommand("pdffonts " + pdf_.string() + " | tail -n +3").output;
    std::istringstream lines(fonts);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_TRUE(std::regex_search(line, std::regex("Identity-H +yes +yes +yes"))) << line;
    EXPECT_EQ(count, 2) << fonts;
    const std::string info = runCommand("pdfinfo " + pdf_.string()).output;
    EXPECT_THAT(info, testing::AllOf(HasSubstr("CT colonography report"), HasSubstr("VICON 0.1.0"), HasSubstr("A4"),
                                     Not(HasSubstr("Adams")), Not(HasSubstr("PID"))));
}

TEST_F(PdfWriter, SaysAllOfAMarker)
{
    addMarkers(1);
    content_.markers[0].part_name = "sigmoid";
    content_.markers[0].marker.station_mm = 412;
    content_.markers[0].marker.from_caecum_mm = 1188;
    content_.markers[0].marker.fraction = 0.2575;
    const PdfResult result = write();
    const std::string text = samples::textOf(pdf_);
    for (const char* what :
         {"Marker m1, red", "prone (series 3)", "L 85.2, P 12.0, H 340.5 mm", "sigmoid", "412 mm along the centreline",
          "1188 mm along the centreline", "25.8 % of the whole, 1600 mm", "estimated: about 32 cm", "note of m1",
          "prone (series 3), m1", "From inside", "Slices: axial"})
        EXPECT_THAT(text, HasSubstr(what));
    EXPECT_LT(text.find("1188 mm"), text.find("estimated: about"));
    expectTidy(pdf_);
}

TEST_F(PdfWriter, WithoutMarkersItSaysSo)
{
    EXPECT_EQ(write().pages, 1);
    EXPECT_THAT(samples::textOf(pdf_), HasSubstr("No findings were stated in this case."));
    content_.scans.clear();
    write();
    EXPECT_THAT(samples::textOf(pdf_), HasSubstr("This case has no scan."));
}

TEST_F(PdfWriter, MarkersOfNoFindingAreNeverDenied)
{
    content_.read.loose_markers = {"m1", "m2"};
    write();
    const std::string text = samples::textOf(pdf_);
    EXPECT_THAT(text, HasSubstr("Markers not assigned to a finding: m1, m2."));
    EXPECT_THAT(text, Not(HasSubstr("No findings were stated")));
}

TEST_F(PdfWriter, TheSameContentGivesTheSameBytes)
{
    addMarkers(2);
    write();
    const std::string first = readFile(pdf_);
    write();
    EXPECT_EQ(readFile(pdf_), first);
    content_.created = "2026-11-21T08:16:30Z";
    write();
    EXPECT_NE(readFile(pdf_), first);
}

TEST_F(PdfWriter, FiftyMarkersFillPagesWithoutOverlap)
{
    addMarkers(50);
    const PdfResult result = write();
    expectFurniture(pdf_, result.pages, "Adams, John Robert");
    EXPECT_LE(result.pages, 29);  // two entries a page
    const std::string text = samples::textOf(pdf_);
    for (int n = 1; n <= 50; ++n)
        EXPECT_THAT(text, HasSubstr("Marker m" + std::to_string(n) + ","));
    expectTidy(pdf_);
}

class PdfWriterTable : public PdfWriter, public testing::WithParamInterface<int> {};

TEST_P(PdfWriterTable, OfMarkersNamesTheRightPage)
{
    const int markers = GetParam();
    addMarkers(markers);
    write();
    const std::string table = runCommand("pdftotext -layout " + pdf_.string() + " -").output;
    const std::vector<std::string> pages = samples::pageTexts(pdf_);
    for (int n = 1; n <= markers; ++n) {
        const std::string id = "m" + std::to_string(n);
        std::smatch found;
        ASSERT_TRUE(std::regex_search(table, found, std::regex(id + " (red|yellow|green) .*% +([0-9]+)\n"))) << id;
        EXPECT_THAT(pages.at(std::stoul(found[2]) - 1), HasSubstr("Marker " + id + ","));
    }
}

INSTANTIATE_TEST_SUITE_P(Markers, PdfWriterTable, testing::Values(1, 7));

TEST_F(PdfWriter, ANoteOfFiveThousandWordsRunsOverPagesWhole)
{
    addMarkers(1);
    std::string& note = content_.markers[0].marker.note;
    note.clear();
    for (int n = 0; n < 5000; ++n)
        note += "word" + std::to_string(n) + (n % 400 == 399 ? "\n\n" : " ");
    const PdfResult result = write();
    EXPECT_GT(result.pages, 8);
    expectFurniture(pdf_, result.pages, "Adams, John Robert");
    const std::string text = samples::textOf(pdf_);
    const std::regex word("word([0-9]+)");
    int expected = 0;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), word); at != std::sregex_iterator(); ++at)
        ASSERT_EQ(std::stoi((*at)[1]), expected++);
    EXPECT_EQ(expected, 5000);
    const std::vector<std::string> pages = samples::pageTexts(pdf_);
    for (std::size_t page = 2; page + 1 < pages.size(); ++page)
        EXPECT_THAT(pages[page], HasSubstr("Note of m1"));
    expectTidy(pdf_);
}

TEST_F(PdfWriter, LongTextsAreBrokenWhereTheyMustAndStayOnThePage)
{
    addMarkers(2);
    content_.read.record.patient.name =
        "Wolfeschlegelsteinhausenbergerdorff^Hubert Blaine Adolph Charles David Earl^Frederick";
    content_.read.record.patient.id = std::string(64, '9');
    content_.read.record.study.description = std::string(64, 'W');
    content_.read.record.study.institution = "Hospital of the " + std::string(300, 'x');
    content_.read.record.flags = {"The same patient ID was seen with another name: a person must decide. " +
                                  std::string(150, 'y')};
    content_.markers[0].marker.note = std::string(3000, 'z');
    content_.markers[0].scan_label =
        "a label that is much longer than a label of a scan is ever going to be, and then some";
    content_.markers[1].part_name = "a part of the colon that has a very long name indeed, longer than its column";
    content_.scans[0].reason = std::string(500, 'v') + " " + std::string(5000, 'r');
    const PdfResult result = write();
    expectSound(pdf_);
    EXPECT_EQ(int(samples::pageTexts(pdf_).size()), result.pages);
    for (const std::string& page : samples::pageTexts(pdf_))
        EXPECT_THAT(page, HasSubstr("Wolfeschlegelsteinhausenbergerdorff, Hubert"));
    expectTidy(pdf_);
    const std::string text = samples::textOf(pdf_);
    EXPECT_EQ(std::count(text.begin(), text.end(), 'z'), 3000);
}

TEST_F(PdfWriter, AnEndlessNameIsCutInTheHeaderAndWholeOnTheFirstPage)
{
    content_.read.record.patient.name.clear();
    for (int n = 0; n < 60; ++n)
        content_.read.record.patient.name += "Name" + std::to_string(n) + " ";
    write();
    EXPECT_THAT(samples::pageTexts(pdf_).at(0), testing::AllOf(HasSubstr("Name59"), HasSubstr("\u2026")));
    expectTidy(pdf_);
}

TEST_F(PdfWriter, OtherNumbersOfScansAreDrawn)
{
    for (const int scans : {2, 3}) {
        while (int(content_.scans.size()) < scans) {
            content_.scans.push_back(content_.scans[0]);
            content_.scans.back().scan.series.number = 3 + int(content_.scans.size());
            content_.scans.back().scan.series.patient_position = "HFS";
            content_.scans.back().scan.series.lossy = true;
        }
        const PdfResult result = write();
        const std::string text = samples::textOf(pdf_);
        EXPECT_THAT(text, HasSubstr("Prone, head first · series 3"));
        EXPECT_THAT(text, HasSubstr("Supine, head first · series 5"));
        EXPECT_THAT(text, HasSubstr("LOSSY COMPRESSION"));
        expectTidy(pdf_);
        EXPECT_EQ(result.pages, scans - 1);
    }
}

TEST_F(PdfWriter, LetterPaperAndASignedReport)
{
    addMarkers(3);
    content_.version =
        ReportVersion{.version = 1, .state = ReportState::final, .person = "anna", .at = "2026-11-21T08:15:30Z"};
    const PdfResult result = write({.paper = Paper::letter});
    EXPECT_THAT(runCommand("pdfinfo " + pdf_.string()).output, HasSubstr("letter"));
    EXPECT_THAT(samples::textOf(pdf_), Not(HasSubstr("DRAFT")));
    EXPECT_THAT(samples::textOf(pdf_), HasSubstr("research software that is no medical device"));
    expectTidy(pdf_, 612, 792);
}

TEST_F(PdfWriter, PicturesAreNeitherMirroredNorTurned)
{
    samples::writeQuarters(content_.scans[0].overview_picture, 900, 1100,
                           {{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 0, 255}}});
    write();
    const samples::Raster page = samples::render(pdf_, 1, 144);
    struct Mean {
        double x = 0, y = 0;
        int count = 0;
    };
    const auto mean = [&](int red, int green, int blue) {
        Mean m;
        for (int y = 0; y < page.height; ++y)
            for (int x = 0; x < page.width; ++x)
                if (const auto* p = page.at(x, y);
                    std::abs(p[0] - red) + std::abs(p[1] - green) + std::abs(p[2] - blue) <= 2)
                    m = {m.x + x, m.y + y, m.count + 1};
        return Mean{m.x / m.count, m.y / m.count, m.count};
    };
    const Mean upper_left = mean(255, 0, 0), upper_right = mean(0, 255, 0), lower_left = mean(0, 0, 255),
               lower_right = mean(255, 0, 255);
    ASSERT_GT(std::min({upper_left.count, upper_right.count, lower_left.count, lower_right.count}), 1000);
    EXPECT_NEAR(upper_left.y, upper_right.y, 1);
    EXPECT_NEAR(upper_left.x, lower_left.x, 1);
    EXPECT_LT(upper_left.x + 50, upper_right.x);
    EXPECT_LT(upper_left.y + 50, lower_left.y);
    EXPECT_LT(lower_left.x + 50, lower_right.x);
}

TEST_F(PdfWriter, TheSamePictureIsEmbeddedOnce)
{
    addMarkers(4);
    for (MarkerEntry& entry : content_.markers) {
        entry.slices_picture = folder_ / "same.png";
        entry.endoscopic_picture = folder_ / (entry.marker.id + "-copy.png");
        entry.below_picture.clear();
        samples::writeQuarters(entry.slices_picture, 1200, 900, {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}});
        samples::writeQuarters(entry.endoscopic_picture, 1200, 900, {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}});
    }
    write();
    const std::string objects =
        runCommand("pdfimages -list " + pdf_.string() + " | tail -n +3 | awk '{print $11}' | sort -u | wc -l").output;
    EXPECT_EQ(std::stoi(objects), 2);  // the overview and the one picture of all markers
}

TEST_F(PdfWriter, PicturesOfAnySizeAreDrawn)
{
    addMarkers(3);
    const std::array<std::pair<int, int>, 6> sizes = {
        {{1, 1}, {16, 12}, {2000, 2000}, {2000, 200}, {200, 2000}, {37, 53}}};
    for (std::size_t n = 0; n < 3; ++n) {
        const std::array<std::array<std::uint8_t, 3>, 4> colors = {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}};
        samples::writeQuarters(content_.markers[n].endoscopic_picture, sizes[2 * n].first, sizes[2 * n].second, colors);
        samples::writeQuarters(content_.markers[n].slices_picture, sizes[2 * n + 1].first, sizes[2 * n + 1].second,
                               colors);
    }
    const PdfResult result = write();
    EXPECT_THAT(result.warnings, IsEmpty());
    expectSound(pdf_);
    expectTidy(pdf_);
}

TEST_F(PdfWriter, MissingAndBrokenPicturesLeaveALineAndAWarning)
{
    addMarkers(2);
    content_.scans[0].overview_picture.clear();
    fs::remove(content_.markers[0].endoscopic_picture);
    replaceFile(content_.markers[0].slices_picture, "no picture");
    const std::string png = readFile(content_.markers[1].slices_picture);
    replaceFile(content_.markers[1].slices_picture, png.substr(0, png.size() / 2));
    content_.markers[1].endoscopic_picture.clear();
    const PdfResult result = write();
    EXPECT_THAT(result.warnings, testing::ElementsAre("marker m1: the endoscopic picture cannot be read",
                                                      "marker m1: the slice picture cannot be read",
                                                      "marker m2: the slice picture cannot be read"));
    const std::string text = samples::textOf(pdf_);
    EXPECT_THAT(text, HasSubstr("No overview picture was made."));
    EXPECT_THAT(text, HasSubstr("No endoscopic picture was made."));
    EXPECT_THAT(text, HasSubstr("The slice picture cannot be read."));
    expectSound(pdf_);
}

}  // namespace
}  // namespace vicon::report
