#include "vicon/viewer/scene/band_picture.h"

#include <algorithm>
#include <cmath>

#include "band_shade.h"
#include "pictures.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {
namespace {

constexpr int kBandSmooth = 2;
constexpr double kBandRing_mm = 8;  // as in the view from inside

double bandTextHeight(const BandRequest& request)
{
    constexpr double kLeast_px = 11;
    if (request.text_px > 0)
        return request.text_px;
    return std::max(0.7 * textHeightFor(request.width, request.height, request.pixel_ratio),
                    kLeast_px * request.pixel_ratio);
}

double bandCaptionHeight(const BandRequest& request)
{
    return request.captioned ? 1.6 * bandTextHeight(request) : 0;
}

BandPage pageFor(const BandMap& band, const BandRequest& request)
{
    BandPage page;
    page.width = request.width;
    page.height = request.height;
    page.from_caecum = request.from_caecum;
    page.top_px = bandCaptionHeight(request);
    page.label_px = 1.5 * bandTextHeight(request);
    if (!request.middle_mm)
        return wholeBand(band, page);
    page = fitted(band, page);
    // As much of the row as there is wall for.
    const double half = page.rowLength_mm() / 2;
    const double first = band.firstStation_mm() + half, last = band.lastStation_mm() - half;
    const double middle = first < last ? std::clamp(*request.middle_mm, first, last)
                                       : (band.firstStation_mm() + band.lastStation_mm()) / 2;
    page.from_mm = request.from_caecum ? middle + half : middle - half;
    return page;
}

BandPage finerPage(BandPage page, int finer)
{
    page.width *= finer;
    page.height *= finer;
    page.top_px *= finer;
    page.label_px *= finer;
    page.mm_per_pixel /= finer;
    return page;
}

OverlayText textAt(Pixel at, const std::string& text, double height_px, Rgb color)
{
    return {at, text, height_px, color, Across::left, Along::top, 1e9};
}

std::string distanceLabel(double station_mm)
{
    return std::to_string(std::lround(station_mm / 10)) + " cm";
}

double widthOf(const std::string& words, double text_px)
{
    return textSize(textAt({}, words, text_px, kTextColor)).width_px;
}

/// Of a distance and a part's name, the longest that there can be.
double widestLabel_px(const PreparedScan& scan, double text_px)
{
    const std::string farthest = distanceLabel(scan.frames().length_mm());
    double widest_px = widthOf(farthest, text_px);
    for (const ColonPartRange& range : scan.parts())
        widest_px = std::max(widest_px, widthOf(farthest + "  " + nameOf(range.part), text_px));
    return widest_px;
}

/// Ticks with the distance from the rectum, and which part of the colon this is. At the end of a row the words move as
/// far to the left as the ones before leave room; else the distance alone is written, or nothing.
void addStations(Overlay& overlay, const PreparedScan& scan, const BandPage& page, double text_px)
{
    const double gap_px = 0.3 * text_px, widest_px = widestLabel_px(scan, text_px);
    double every_mm = 100;
    while (every_mm / page.mm_per_pixel < widest_px + 2 * gap_px)
        every_mm *= 2;
    const double length_mm = scan.frames().length_mm();
    for (int row = 0; row < page.rows; ++row) {
        const double top = page.rowTop(row), bottom = top + page.label_px;
        const bool falls = page.from_caecum;
        const double least = std::ceil(std::max(0.0, page.rowLeast_mm(row)) / every_mm),
                     most = std::floor(std::min(length_mm, page.rowMost_mm(row)) / every_mm);
        double written_to_px = 0;
        for (double n = 0; n <= most - least; ++n) {  // from left to right
            const double station = every_mm * (falls ? most - n : least + n);
            const double x = std::abs(station - page.rowBegin_mm(row)) / page.mm_per_pixel;
            overlay.lines.push_back({{{x, bottom - 0.4 * text_px}, {x, bottom}}, kTextColor, 1, 0});
            const std::string far = distanceLabel(station);
            std::string whole = far;
            if (const std::string part = partNameAt(scan.parts(), station); !part.empty())
                whole += "  " + part;
            for (const std::string& words : {whole, far}) {
                const double width_px = widthOf(words, text_px);
                const double at_px = std::min(x + gap_px, page.width - width_px - gap_px);
                if (at_px < written_to_px + gap_px && at_px < x + gap_px)
                    continue;
                overlay.texts.push_back(textAt({at_px, top}, words, text_px, kTextColor));
                written_to_px = at_px + width_px;
                break;
            }
        }
    }
}

/// At the beginning of each row: to which side of the patient the wall lies.
void addSides(Overlay& overlay, const BandMap& band, const BandPage& page, double text_px)
{
    for (int row = 0; row < page.rows; ++row) {
        const double station = std::clamp(page.rowBegin_mm(row), band.firstStation_mm(), band.lastStation_mm());
        const PathFrame frame = band.path().at(station);
        const Vector3 right = cross(frame.forward, frame.up);
        for (const double around : {0.0, BandPage::kTurn_rad / 4, -BandPage::kTurn_rad / 4}) {
            const double y = page.toPixel(band, {station, around}, row).y;
            OverlayText letter =
                textAt({0.3 * text_px, y}, lettersFor(frame.up * std::cos(around) + right * std::sin(around)), text_px,
                       kLetterColor);
            letter.along = Along::middle;
            overlay.texts.push_back(letter);
        }
    }
}

/// Where there is no lumen there is no wall.
void addBridges(Overlay& overlay, const BandMap& band, const Skeleton& skeleton, const BandPage& page, double text_px)
{
    for (const SkeletonPiece& piece : skeleton.pieces) {
        if (!piece.bridge)
            continue;
        const double from = piece.points.front().station_mm, to = piece.points.back().station_mm;
        for (int row = 0; row < page.rows; ++row) {
            const double a = std::max(from, page.rowLeast_mm(row)), b = std::min(to, page.rowMost_mm(row));
            if (a >= b)
                continue;
            overlay.lines.push_back(
                {{page.toPixel(band, {a, 0}, row), page.toPixel(band, {b, 0}, row)}, kBridgeColor, 2, 6});
            OverlayText name = textAt(page.toPixel(band, {(a + b) / 2, 0}, row), "collapsed", text_px, kBridgeColor);
            name.across = Across::centre;
            overlay.texts.push_back(name);
        }
    }
}

/// As often as a row shows the marker: where its turn is repeated, too.
void addBandMarkers(Overlay& overlay, const BandMap& band, const BandPage& page, const std::vector<Marker>& markers,
                    double text_px)
{
    constexpr double kEdge_rad = BandPage::kTurn_rad / 2 + BandPage::kBeyond_rad;
    for (const Marker& marker : markers) {
        const BandPlace place = band.placeOf(marker.position_mm);
        for (int row = 0; row < page.rows; ++row)
            for (const int turn : {-1, 0, 1}) {
                const BandPlace here{place.station_mm, place.around_rad + turn * BandPage::kTurn_rad};
                const bool shown = here.station_mm >= page.rowLeast_mm(row) &&
                                   here.station_mm <= page.rowMost_mm(row) && std::abs(here.around_rad) <= kEdge_rad;
                if (shown)
                    addMarkerRing(overlay, page.toPixel(band, here, row),
                                  std::max(kBandRing_mm / page.mm_per_pixel, 0.6 * text_px), marker, text_px);
            }
    }
}

/// A bracket from where something is expected at least to where at most, with its label, and a tick at its middle.
void addBandPriors(Overlay& overlay, const BandMap& band, const BandPage& page, const std::vector<PriorPlace>& priors,
                   double text_px)
{
    constexpr double kDash_px = 6;
    for (const PriorPlace& place : priors)
        for (int row = 0; row < page.rows; ++row) {
            const double least = std::max(place.least_mm, page.rowLeast_mm(row)),
                         most = std::min(place.most_mm, page.rowMost_mm(row));
            if (least > most)
                continue;
            const auto x = [&](double station) { return page.toPixel(band, {station, 0}, row).x; };
            const double top = page.rowTop(row) + page.label_px, bottom = page.rowTop(row) + page.rowHeight();
            const double bar = top + 0.3 * text_px;
            overlay.lines.push_back({{{x(least), bar}, {x(most), bar}}, place.color, std::max(3.0, 0.3 * text_px), 0});
            for (const double end : {place.least_mm, place.most_mm})
                if (end >= least && end <= most)
                    overlay.lines.push_back({{{x(end), top}, {x(end), bottom}}, place.color, 2, kDash_px});
            if (place.station_mm < least || place.station_mm > most)
                continue;
            overlay.discs.push_back({{x(place.station_mm), bar}, 0.45 * text_px, place.color, 2});
            addPriorName(overlay, {x(place.station_mm), bar + 1.1 * text_px}, place, text_px);
        }
}

/// A line across the band where the eye is, and a mark on the wall at which it looks.
void addEye(Overlay& overlay, const BandMap& band, const BandPage& page, const SnapshotResult& eye, double text_px)
{
    const int row = page.rowOf(eye.station_mm);
    if (eye.station_mm < page.rowLeast_mm(row) || eye.station_mm > page.rowMost_mm(row))
        return;
    const double x = page.toPixel(band, {eye.station_mm, 0}, row).x;
    const double top = page.rowTop(row) + page.label_px, bottom = page.rowTop(row) + page.rowHeight();
    overlay.lines.push_back({{{x, top}, {x, bottom}}, kHereColor, 1, 4});
    const double sign =
        dot(eye.pose.forward, band.path().at(eye.station_mm).forward) * (page.from_caecum ? -1 : 1) < 0 ? -1 : 1;
    const double arm = 0.5 * text_px;
    overlay.lines.push_back({{{x, top}, {x + sign * arm, top + arm}, {x, top + 2 * arm}}, kHereColor, 2, 0});
}

}  // namespace

Overlay bandOverlay(const PreparedScan& scan, const BandMap& band, const BandPage& page, const BandRequest& request)
{
    const double text_px = bandTextHeight(request);
    Overlay overlay;
    addStations(overlay, scan, page, text_px);
    addSides(overlay, band, page, text_px);
    addBridges(overlay, band, scan.skeleton(), page, text_px);
    addBandPriors(overlay, band, page, request.priors, text_px);
    addBandMarkers(overlay, band, page, request.markers, text_px);
    if (request.eye)
        addEye(overlay, band, page, *request.eye, text_px);
    addScaleBar(overlay, {0, 0, double(page.width), double(page.height)}, page.mm_per_pixel, text_px);
    if (request.captioned) {
        std::string line;
        for (const OverlayText& part : patientLines(request.caption))
            line += (line.empty() ? "" : "   ") + part.text;
        OverlayText caption = textAt({0.3 * text_px, 0.2 * text_px}, line, text_px, kTextColor);
        caption.most_width_px = request.caption.lossy ? 0.7 * page.width : page.width - 0.6 * text_px;
        overlay.texts.push_back(caption);
        if (request.caption.lossy) {
            OverlayText lossy =
                textAt({page.width - 0.3 * text_px, 0.2 * text_px}, "LOSSY COMPRESSION", text_px, kWarningColor);
            lossy.across = Across::right;
            overlay.texts.push_back(lossy);
        }
    }
    return overlay;
}

std::optional<Point3> BandPicture::pointAt(const BandMap& band, Pixel at) const
{
    if (!raster)
        return std::nullopt;
    const auto hit = raster->at(int(std::floor(at.x * finer)), int(std::floor(at.y * finer)));
    return hit ? std::optional(pointOf(band.surface(), *hit)) : std::nullopt;
}

BandMap bandOf(const PreparedScan& scan, Progress& progress)
{
    if (!scan.tree().empty())
        throw Error(ErrorCode::wrong_use, "an organ that branches cannot be opened into one band",
                    scan.words().organ.name(), "choose another view");
    if (!scan.hasPath())
        throw Error(ErrorCode::wrong_use, "an organ without a centreline cannot be opened into a band",
                    scan.words().organ.name(), "choose another view");
    return {scan.cells(), scan.frames(), scan.exitDistance(), progress};
}

BandPicture bandPicture(const PreparedScan& scan, const BandMap& band, const BandRequest& request, Progress& progress)
{
    BandPicture drawn;
    drawn.finer = request.still ? kBandSmooth : 1;
    drawn.page = pageFor(band, request);
    drawn.raster = std::make_shared<const BandRaster>(band, finerPage(drawn.page, drawn.finer));
    progress.check();
    static const std::vector<float> kEven;
    drawn.picture = bandWall(band, *drawn.raster, drawn.finer, request.seen,
                             request.still || scan.hasOpenness() ? scan.openness() : kEven, progress);
    paint(drawn.picture, bandOverlay(scan, band, drawn.page, request));
    return drawn;
}

}  // namespace vicon::viewer
