// The part of Sections that is for who referred the patient: whose study it is, what was found and what to do.
#include <algorithm>

#include "parts_table.h"
#include "sections.h"
#include "vicon/cases/printed.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

// Of the map, an overview for each scan: points.
constexpr double kSmallestMap = 120, kSmallestQuietMap = 80, kTallestMap = 235, kWidestMap = 246;
constexpr double kTallestQuietMap = 92, kMapGap = 8;                 // where nothing was found
constexpr double kFactsBesideTwoMaps = 205;                          // width
constexpr std::size_t kMapsBeside = 3, kMapsBesideFacts = 2;         // in a row
constexpr double kLogoHeight = 34, kLogoWidth = 120, kLogoGap = 10;  // points

void append(std::vector<Statement>& to, const std::vector<Statement>& from)
{
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

/// At the right edge; returns the height used.
double Sections::drawSite(double width)
{
    double right = flow_.left() + flow_.width(), logo_height = 0, text = 0;
    if (!site_.logo.empty()) {
        const FramedPicture logo = framed(site_.logo, kLogoWidth, "", "logo", "the site");
        const Box box = logo.fitted(kLogoWidth, kLogoHeight);
        logo.draw(flow_, right - box.width, flow_.y(), kLogoWidth, kLogoHeight);
        right -= box.width + kLogoGap;
        width -= box.width + kLogoGap;
        logo_height = box.height;
    }
    for (const std::string& said : site_.name_lines) {
        const bool is_name = text == 0;
        const TextStyle style = is_name ? look::kEntry : look::kSmall;
        for (const TextLine& line : flow_.type.lines(said, style, width)) {
            flow_.putRight(right, flow_.y() - text, line, is_name ? look::kInk : look::kMuted);
            text += leadingOf(style);
        }
    }
    return std::max(logo_height, text);
}

void Sections::drawTitle()
{
    const bool amended = content_.version && content_.version->replaces != 0;
    const std::string what = std::string(examinationOf(quantityOf(content_.read))) + " report";
    const TextLine title = flow_.type.line(amended ? what + ", amended" : what, look::kTitle);
    const std::string made = content_.version
                                 ? stateWords(content_.version)
                                 : "Draft " + std::to_string(content_.number) + ", made on " +
                                       utcWords(content_.created) + " with VICON " + content_.software_version;
    const auto said = flow_.type.lines(made, look::kBody, flow_.width() / 2);
    const double width = std::max(title.width, flow_.width() / 2);
    const double site = drawSite(flow_.width() - width - kColumnGap);
    flow_.put(flow_.left(), flow_.y(), title, look::kAccent);
    double used = leadingOf(look::kTitle);
    for (const TextLine& line : said) {
        flow_.put(flow_.left(), flow_.y() - used, line, look::kMuted);
        used += leadingOf(look::kBody);
    }
    flow_.skip(std::max(used, site) + 10);
    drawNotice(flow_, content_.read.record.flags);
    if (!content_.read.record.flags.empty())
        flow_.skip(look::kGap / 2);
}

void Sections::drawCase()
{
    // ID, birth date and sex stand above, as on every page; a long name does not.
    std::vector<Statement> about{{"Patient", printedPatientName(content_.read.record.patient.name)}};
    append(about, studyStatements(content_.read.record));
    append(about, occasionStatements(content_.read));
    const double column = (flow_.width() - kColumnGap) / 2;
    const auto tableOf = [&](std::size_t from, std::size_t to) {
        return StatementTable(flow_.type, {about.begin() + long(from), about.begin() + long(to)}, column,
                              look::kNarrowLabelWidth);
    };
    std::size_t on_left = 1;
    while (on_left < about.size() && tableOf(0, on_left).height() < tableOf(on_left, about.size()).height())
        ++on_left;
    const StatementTable left = tableOf(0, on_left), right = tableOf(on_left, about.size());
    const double height = std::max(left.height(), right.height());
    if (height > flow_.wholePage()) {  // texts of several pages: below each other
        left.draw(flow_, flow_.left());
        right.draw(flow_, flow_.left());
        return;
    }
    flow_.need(height);
    left.draw(flow_, flow_.left());
    flow_.skip(-left.height());
    right.draw(flow_, flow_.left() + column + kColumnGap);
    flow_.skip(height - right.height() + look::kGap);
}

void Sections::drawImpression()
{
    const ReadCase& read = content_.read;
    std::vector<Statement> said{{"Impression", impressionText(read)}};
    append(said, categoryStatements(read));
    said.push_back({"Recommended", recommendationText(read)});
    if (const std::string amends = amendmentWords(content_.version); !amends.empty())
        said.push_back({"Amendment", amends});
    const StatementTable table(flow_.type, said, flow_.width());
    drawSection(flow_, "Impression", std::min(table.height(), flow_.wholePage() / 2));
    table.draw(flow_, flow_.left());
    flow_.skip(look::kGap);
}

FramedPicture Sections::overviewOf(const ScanEntry& entry)
{
    constexpr const char* kLossyMark = "\nLOSSY COMPRESSION";
    return framed(entry.overview_picture, kWidestMap,
                  scanTitle(entry) + (entry.scan.series.lossy ? kLossyMark
                                      : isQuiet()             ? ""
                                                              : ", from the front"),
                  "overview", "scan " + entry.scan.id);
}

std::vector<Statement> Sections::studyFacts(bool of_colon) const
{
    std::vector<Statement> said;
    if (of_colon)
        said.push_back({"In the colon", kNoFindings});
    for (const Statement& statement : extracolonicStatements(content_.read))
        said.push_back({"Outside", (statement.label == "None" ? "" : statement.label + ", ") + statement.text});
    append(said, examinationStatements());
    return said;
}

double Sections::roomForMap() const
{
    const double rest =
        isQuiet() ? leadingOf(look::kSection) + 8 + qualityHeight() + endHeight() : findingTableHeight();
    return flow_.room() - look::kGap / 2 - rest;
}

bool Sections::drawOneMapBesideParts()
{
    if (content_.scans.size() != 1 || measuredScans().empty())
        return false;
    parts_told_ = true;
    const double captions = 2 * leadingOf(look::kSmall) + 4, room = roomForMap();
    const double tallest = std::clamp(room - captions, kSmallestMap, kTallestMap);
    const FramedPicture map = overviewOf(content_.scans.front());
    const double map_width = map.fitted(kWidestMap, tallest).width;
    const double column = flow_.width() - map_width - kColumnGap;
    const StatementTable facts(flow_.type, studyFacts(isQuiet()), column, look::kNarrowLabelWidth);
    const PartsTable parts(flow_.type, content_.scans.front(), column);
    const double beside = facts.height() + look::kGap + parts.height();
    if (std::max(beside, tallest + captions) > room) {
        parts_told_ = drawOneMapInThreeColumns(room);
        return parts_told_;
    }
    if (isQuiet())
        drawSection(flow_, "Findings", std::max(beside, tallest + captions));
    const double top = flow_.y(), x = flow_.left() + flow_.width() - column;
    const double used = std::max(beside, map.draw(flow_, flow_.left(), top, map_width, tallest));
    facts.draw(flow_, x);
    parts.draw(flow_, x, flow_.y() - look::kGap);
    flow_.skip(used - facts.height() + look::kGap / 2);
    return true;
}

bool Sections::drawOneMapInThreeColumns(double room)
{
    const ScanEntry& scan = content_.scans.front();
    const FramedPicture map = overviewOf(scan);
    const double captions = 3 * leadingOf(look::kSmall) + 4, tallest = std::clamp(room - captions, 0.0, kSmallestMap);
    const double map_width = map.fitted(kWidestMap, tallest).width, parts_width = PartsTable::leastWidth(scan);
    const double column = flow_.width() - map_width - parts_width - 2 * kColumnGap;
    const StatementTable facts(flow_.type, studyFacts(isQuiet()), column, look::kNarrowLabelWidth);
    const PartsTable parts(flow_.type, scan, parts_width);
    const double most = std::max({facts.height(), parts.height(), tallest + captions});
    if (isQuiet() || tallest < kSmallestMap || most > room)
        return false;
    const double top = flow_.y(), x = flow_.left() + map_width + kColumnGap;
    const double used =
        std::max({map.draw(flow_, flow_.left(), top, map_width, tallest), parts.height(), facts.height()});
    parts.draw(flow_, x + column + kColumnGap, top);
    facts.draw(flow_, x);
    flow_.skip(used - facts.height() + look::kGap / 2);
    return true;
}

bool Sections::drawMapBesideFacts()
{
    if (drawOneMapBesideParts())
        return true;
    const bool quiet = isQuiet();
    if (content_.scans.empty() || content_.scans.size() > kMapsBesideFacts)
        return false;
    const auto maps = double(content_.scans.size());
    const double column = quiet || content_.scans.size() == 1 ? (flow_.width() - kColumnGap) / 2 : kFactsBesideTwoMaps;
    const double map_width = (flow_.width() - column - kColumnGap - (maps - 1) * kMapGap) / maps;
    const StatementTable table(flow_.type, studyFacts(quiet), column, look::kNarrowLabelWidth);
    const double captions = (quiet ? 1 : 2) * leadingOf(look::kSmall) + 4, heading = leadingOf(look::kSection) + 8;
    const double room = flow_.room() - look::kGap / 2 - (quiet ? heading : findingTableHeight());
    const double smallest = quiet ? kSmallestQuietMap : kSmallestMap;
    if (std::max(table.height(), smallest + captions) > room)
        return false;
    if (quiet)
        drawSection(flow_, "Findings", std::max(table.height(), smallest + captions));
    const double top = flow_.y();
    const double tallest = std::clamp(room - captions, smallest,
                                      quiet ? std::max(kTallestQuietMap, table.height() - captions) : kTallestMap);
    double used = table.height();
    for (std::size_t n = 0; n < content_.scans.size(); ++n)
        used =
            std::max(used, overviewOf(content_.scans[n])
                               .draw(flow_, flow_.left() + double(n) * (map_width + kMapGap), top, map_width, tallest));
    table.draw(flow_, flow_.left() + flow_.width() - column);
    flow_.skip(used - table.height() + look::kGap / 2);
    return true;
}

void Sections::drawMap()
{
    if (content_.scans.empty()) {
        flow_.paragraph(flow_.left(), flow_.width(), {flow_.type.line("This case has no scan.", look::kBody)},
                        look::kBody, look::kInk);
        flow_.skip(look::kGap);
        return;
    }
    const double captions = 2 * leadingOf(look::kSmall) + 8;
    const std::size_t beside = std::min(content_.scans.size(), kMapsBeside);
    const bool alone = content_.scans.size() == 1 && !measuredScans().empty();  // then its parts stand beside it
    const double columns = alone ? 2 : double(beside);
    const double column = (flow_.width() - (columns - 1) * kColumnGap) / columns;
    for (std::size_t n = 0; n < content_.scans.size(); n += beside) {
        flow_.need(kSmallestMap + captions);
        const double room = flow_.room() - captions - look::kGap / 2;
        const double height = std::clamp(room - findingTableHeight(), kSmallestMap, kTallestMap);
        double used = 0;
        for (std::size_t k = n; k < std::min(n + beside, content_.scans.size()); ++k)
            used = std::max(used, overviewOf(content_.scans[k])
                                      .draw(flow_, flow_.left() + double(k - n) * (column + kColumnGap), flow_.y(),
                                            column, height));
        if (alone) {
            const PartsTable parts(flow_.type, content_.scans.front(), column);
            parts.draw(flow_, flow_.left() + column + kColumnGap, flow_.y());
            used = std::max(used, parts.height());
        }
        flow_.skip(used + look::kGap / 2);
    }
    parts_told_ = alone;
}

}  // namespace vicon::report
