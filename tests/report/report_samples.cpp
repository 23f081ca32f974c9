#include "report_samples.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "vicon/cases/finding_facts.h"
#include "vicon/core/file.h"
#include "vicon/picture/png_file.h"
#include "vicon/support/support.h"

namespace vicon::report::samples {
namespace {

std::string replaceAll(std::string text, const std::string& from, const std::string& to)
{
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

std::string output(const std::string& command)
{
    const support::CommandResult result = support::runCommand(command);
    if (result.exit_code != 0)
        throw std::runtime_error(command + ": " + result.output);
    return result.output;
}

std::string quoted(const std::filesystem::path& file)
{
    return "'" + file.string() + "'";
}

}  // namespace

void writeQuarters(const std::filesystem::path& file, int width, int height,
                   const std::array<std::array<std::uint8_t, 3>, 4>& colors)
{
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto& color = colors[std::size_t(2 * (2 * y >= height) + (2 * x >= width))];
            rgb.insert(rgb.end(), color.begin(), color.end());
        }
    picture::writePng(file, width, height, rgb);
}

ReportContent plainCase(const std::filesystem::path& folder)
{
    ReportContent content;
    content.created = "2026-11-21T08:15:30Z";
    content.software_version = "0.1.0";
    content.number = 2;
    content.read.record.id = "c1";
    content.read.record.patient = {"PID-4711", "Adams^John Robert", "19610412", "M"};
    content.read.record.study.date = "20261120";
    ScanEntry entry;
    entry.scan.id = "s1";
    entry.scan.series.number = 3;
    entry.scan.series.patient_position = "HFP";
    entry.verdict = Verdict::found;
    entry.organ_title = "colon";
    entry.confidence = 0.86;
    entry.skeleton_length_mm = 1600;
    entry.overview_picture = folder / "overview.png";
    writeQuarters(entry.overview_picture, 90, 110, {{{30, 30, 30}, {40, 40, 40}, {50, 50, 50}, {60, 60, 60}}});
    content.scans.push_back(entry);
    return content;
}

MarkerEntry plainMarker(const std::filesystem::path& folder, int n)
{
    MarkerEntry entry;
    entry.marker.id = "m" + std::to_string(n);
    entry.marker.scan_id = "s1";
    entry.marker.position_mm = {85.2, 12.0, 340.5};
    entry.marker.color = MarkerColor((n - 1) % 3);
    entry.marker.note = "note of " + entry.marker.id;
    entry.marker.station_mm = 20.0 * n;
    entry.marker.from_caecum_mm = 1600 - entry.marker.station_mm;
    entry.marker.fraction = entry.marker.station_mm / 1600;
    entry.scan_label = "prone (series 3)";
    entry.endoscopic_picture = folder / (entry.marker.id + "-endo.png");
    entry.below_picture = folder / (entry.marker.id + "-below.png");
    entry.slices_picture = folder / (entry.marker.id + "-slices.png");
    const auto shade = std::uint8_t(n);
    writeQuarters(entry.endoscopic_picture, 90, 90, {{{200, shade, 0}, {150, 60, 50}, {90, 20, 20}, {40, 10, 10}}});
    writeQuarters(entry.below_picture, 90, 90, {{{0, 200, shade}, {50, 150, 60}, {20, 90, 20}, {10, 40, 10}}});
    writeQuarters(entry.slices_picture, 120, 90, {{{shade, 90, 0}, {50, 50, 50}, {90, 90, 90}, {120, 120, 120}}});
    return entry;
}

void addFinding(ReportContent& content, int n)
{
    Finding finding{.id = "f", .morphology = Morphology::sessile, .note = "what f"};
    finding.id += std::to_string(n);
    finding.note += std::to_string(n) + " is like";
    std::vector<Marker> markers;
    for (int k = n; k <= std::min(n + 1, int(content.markers.size())); ++k) {
        Marker& marker = content.markers[std::size_t(k) - 1].marker;
        marker.part = ColonPart::sigmoid;
        marker.size = MarkerSize{.straight_mm = 6 + 0.3 * k, .plane = PlaneSize{.diameter_mm = 6.1 + 0.3 * k}};
        marker.density = DensitySample{.voxels = 40, .mean_hu = 41.0 + k};
        finding.markers.push_back(marker.id);
        markers.push_back(marker);
        std::erase(content.read.loose_markers, marker.id);
    }
    Skeleton straight;
    straight.pieces = {{false, {{{60, 12, 0}, 0, 15}, {{60, 12, 1600}, 1600, 15}}}};
    content.read.findings.push_back({finding, factsOf(finding, markers, {{"s1", straight}})});
    content.read.scans = {content.scans[0].scan};
}

void addLumen(ScanEntry& entry, double collapsed_from_mm, double collapsed_to_mm)
{
    entry.parts.clear();
    constexpr double kStep_mm = 5, kEnds_mm[] = {0, 130, 480, 720, 780, 1240, 1300, 1480, 1600};
    for (int part = 0; part < 8; ++part)
        entry.parts.push_back({ColonPart(part), kEnds_mm[part], kEnds_mm[part + 1]});
    LumenAlong along{.step_mm = kStep_mm};
    for (double at_mm = kStep_mm / 2; at_mm < entry.skeleton_length_mm; at_mm += kStep_mm) {
        const bool collapsed = at_mm > collapsed_from_mm && at_mm < collapsed_to_mm;
        along.radius_mm.push_back(collapsed ? 0 : 16 + 6 * std::sin(at_mm / 70) + 8 * at_mm / 1600);
        along.fluid_fraction.push_back(std::max(0.0, 0.5 * std::sin(at_mm / 110)));
    }
    if (collapsed_to_mm > collapsed_from_mm)
        along.collapsed.push_back({collapsed_from_mm, collapsed_to_mm});
    if (!entry.quality)
        entry.quality = ScanQuality{};
    entry.quality->along = along;
    entry.quality->thresholds = {{"quality.collapsed_radius_mm", 3.0}};
}

void makeNormal(ReportContent& content)
{
    content.read.scans.clear();
    for (ScanEntry& entry : content.scans) {
        entry.confidence = 0.98;
        ScanQuality quality;
        quality.whole = {.median_radius_mm = 18, .volume_ml = 1900, .fluid_ml = 60, .adequate = true};
        for (int part = 0; part < 8; ++part) {
            quality.parts.push_back(quality.whole);
            quality.parts.back().part = ColonPart(part);
            content.read.parts.push_back({entry.scan.id, ColonPart(part), Distension::good, false});
        }
        entry.quality = quality;
        addLumen(entry);
        content.read.scans.push_back(entry.scan);
    }
    Assessment& said = content.read.assessment;
    said.indication = "screening";
    said.preparation = said.tagging = Grade::good;
    said.colon_category = {ColonCategory::c1, ""};
    said.extracolonic_category = {ExtracolonicCategory::e1, ""};
    content.read.colon_proposal.category = ColonCategory::c1;
    content.read.extracolonic_proposal.category = ExtracolonicCategory::e1;
}

std::string textOf(const std::filesystem::path& pdf)
{
    std::string text = output("pdftotext " + quoted(pdf) + " -");
    for (const char* mark : {"\u202a", "\u202b", "\u202c"})
        text = replaceAll(text, mark, "");
    return text;
}

std::vector<std::string> pageTexts(const std::filesystem::path& pdf)
{
    std::vector<std::string> pages(1);
    for (const char c : textOf(pdf))  // a form feed ends each page
        if (c == '\f')
            pages.emplace_back();
        else
            pages.back() += c;
    pages.pop_back();
    return pages;
}

std::vector<std::vector<Word>> wordsByPage(const std::filesystem::path& pdf)
{
    std::vector<std::vector<Word>> pages;
    std::istringstream lines(output("pdftotext -bbox " + quoted(pdf) + " -"));
    const std::regex pattern("<word xMin=\"(.*?)\" yMin=\"(.*?)\" xMax=\"(.*?)\" yMax=\"(.*?)\">(.*)</word>");
    std::smatch found;
    for (std::string line; std::getline(lines, line);)
        if (line.find("<page ") != std::string::npos)
            pages.emplace_back();
        else if (std::regex_search(line, found, pattern))
            pages.back().push_back(
                {std::stod(found[1]), std::stod(found[2]), std::stod(found[3]), std::stod(found[4]), found[5]});
    return pages;
}

Raster render(const std::filesystem::path& pdf, int page, int dpi)
{
    const support::TemporaryFolder folder;
    const std::string number = std::to_string(page);
    const std::string said = output("pdftoppm -singlefile -r " + std::to_string(dpi) + " -f " + number + " -l " +
                                    number + " " + quoted(pdf) + " " + quoted(folder / "page"));
    if (!said.empty())
        throw std::runtime_error("poppler: " + said);
    const std::string ppm = readFile(folder / "page.ppm");
    std::istringstream head(ppm);
    std::string magic;
    int highest = 0;
    Raster raster;
    head >> magic >> raster.width >> raster.height >> highest;
    const auto from = std::size_t(head.tellg()) + 1;
    raster.rgb.assign(ppm.begin() + std::ptrdiff_t(from), ppm.end());
    return raster;
}

}  // namespace vicon::report::samples
