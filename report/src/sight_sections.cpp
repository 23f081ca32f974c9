// The part of Sections that shows findings and markers in pictures.
#include <algorithm>

#include "row_table.h"
#include "sections.h"
#include "vicon/report/finding_statements.h"

namespace vicon::report {
namespace {

constexpr double kTallest = 190, kTallestMeasures = 105, kLeastWithMeasures = 100;  // points
constexpr double kPictureGap = 12;
// At most so wide they are printed, points; as many pixels of a printer's 300 to the inch are kept.
constexpr double kSquareWidth = 150, kSlicesWidth = 250, kMeasuresWidth = 300;

}  // namespace

std::vector<FramedPicture> Sections::fromInside(const MarkerEntry& entry)
{
    const std::string owner = "marker " + entry.marker.id;
    const std::string mark = isLossy(content_, entry.marker.scan_id) ? " \u00b7 LOSSY COMPRESSION" : "";
    std::vector<FramedPicture> made{
        framed(entry.endoscopic_picture, kSquareWidth,
               "From inside" + (entry.seen_from.empty() ? "" : ", " + entry.seen_from) + mark, "endoscopic", owner)};
    if (!entry.below_picture.empty())
        made.push_back(framed(entry.below_picture, kSquareWidth,
                              "Below the wall, in the circle: fat green, tissue red" + mark, "below the wall", owner));
    return made;
}

FramedPicture Sections::slicesOf(const MarkerEntry& entry)
{
    const std::string mark = isLossy(content_, entry.marker.scan_id) ? " \u00b7 LOSSY COMPRESSION" : "";
    return framed(entry.slices_picture, kSlicesWidth, "Slices: axial, coronal, sagittal" + mark, "slice",
                  "marker " + entry.marker.id);
}

PictureBlock Sections::blockOf(const std::vector<ShownMarker>& shown, const MarkerEntry* measured)
{
    PictureBlock block;
    PictureStrip inside{{}, kTallest}, slices{{}, kTallest};
    for (const ShownMarker& one : shown) {
        block.heads.push_back(one.head);
        for (FramedPicture& picture : fromInside(*one.entry))
            inside.pictures.push_back(std::move(picture));
        slices.pictures.push_back(slicesOf(*one.entry));
    }
    if (shown.size() == 1)
        inside.pictures.push_back(slices.pictures.front());
    block.strips.push_back(std::move(inside));
    if (shown.size() > 1)
        block.strips.push_back(std::move(slices));
    if (measured && !measured->measures_picture.empty())
        addMeasures(block, *measured);
    return block;
}

/// Beside the others, where they stay large enough; else below them.
void Sections::addMeasures(PictureBlock& block, const MarkerEntry& entry)
{
    PictureStrip alone{{framed(entry.measures_picture, kMeasuresWidth, "Measured, " + entry.marker.id, "measures",
                               "marker " + entry.marker.id)},
                       kTallestMeasures};
    PictureStrip& last = block.strips.back();
    last.pictures.push_back(alone.pictures.front());
    if (block.strips.size() == 1 && stripHeight(last) >= kLeastWithMeasures)
        return;
    last.pictures.pop_back();
    block.strips.push_back(std::move(alone));
}

std::vector<PictureBlock> Sections::sightsOf(const FindingWithFacts& f)
{
    const auto& chosen = f.finding.pictures;
    std::vector<ShownMarker> shown;
    const MarkerEntry* lead = nullptr;
    for (const FindingSight& sight : f.facts.sights) {
        if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), sight.marker_id) == chosen.end())
            continue;
        const auto entry = std::find_if(content_.markers.begin(), content_.markers.end(),
                                        [&](const MarkerEntry& e) { return e.marker.id == sight.marker_id; });
        if (entry == content_.markers.end())
            continue;
        shown.push_back({&*entry, scanLabel(content_.read, sight.scan_id) + ", " + sight.marker_id});
        if (&sight == f.facts.lead())
            lead = &*entry;
    }
    std::vector<PictureBlock> blocks;
    for (std::size_t n = 0; n < shown.size(); n += 2) {
        const std::size_t end = std::min(n + 2, shown.size());
        blocks.push_back(blockOf({shown.begin() + std::ptrdiff_t(n), shown.begin() + std::ptrdiff_t(end)},
                                 end == shown.size() ? lead : nullptr));
    }
    return blocks;
}

double Sections::stripHeight(const PictureStrip& strip) const
{
    double aspects = 0;
    for (const FramedPicture& framed : strip.pictures)
        aspects += framed.aspect();
    return std::min(strip.tallest, (flow_.width() - double(strip.pictures.size() - 1) * kPictureGap) / aspects);
}

double Sections::captionHeight(const PictureStrip& strip) const
{
    std::size_t lines = 0;
    for (const FramedPicture& framed : strip.pictures)
        lines = std::max(lines,
                         flow_.type.lines(framed.caption, look::kSmall, framed.aspect() * stripHeight(strip)).size());
    return double(lines) * leadingOf(look::kSmall) + 4;
}

double Sections::heightOf(const PictureBlock& block) const
{
    double height = leadingOf(look::kBold) + 2;
    for (const PictureStrip& strip : block.strips)
        height += stripHeight(strip) + captionHeight(strip) + look::kGap / 2;
    return height;
}

void Sections::drawStrip(const PictureStrip& strip)
{
    const double height = stripHeight(strip);
    flow_.need(height + captionHeight(strip));
    double x = flow_.left(), used = 0;
    for (const FramedPicture& framed : strip.pictures) {
        const double width = framed.aspect() * height;
        used = std::max(used, framed.draw(flow_, x, flow_.y(), width, height));
        x += width + kPictureGap;
    }
    flow_.skip(used + look::kGap / 2);
}

void Sections::drawPictures(const PictureBlock& block)
{
    const double half = (flow_.width() - kPictureGap) / 2;
    flow_.need(leadingOf(look::kBold) + 2 + stripHeight(block.strips.front()));
    for (std::size_t n = 0; n < block.heads.size(); ++n)
        flow_.put(flow_.left() + double(n) * (half + kPictureGap), flow_.y(),
                  cutTo(flow_.type, block.heads[n], look::kBold, block.heads.size() > 1 ? half : flow_.width()),
                  look::kInk);
    flow_.skip(leadingOf(look::kBold) + 2);
    for (const PictureStrip& strip : block.strips)
        drawStrip(strip);
}

}  // namespace vicon::report
