#include "vicon/viewer/scene/snapshot.h"

#include <cmath>

#include "pictures.h"
#include "vicon/cases/printed.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/window_level.h"
#include "vicon/viewer/scene/band_picture.h"

namespace vicon::viewer {
namespace {

SnapshotRequest completed(const PreparedScan& scan, SnapshotRequest request)
{
    constexpr double kNarrowest_deg = 20, kWidest_deg = 150;
    const bool overview = request.view == SnapshotView::overview;
    if (request.width == 0)
        request.width = 1024;
    if (request.height == 0)
        request.height = overview ? 1024 : 768;
    for (const int side : {request.width, request.height})
        if (side < SnapshotRequest::kLeastSide || side > SnapshotRequest::kMostSide)
            throw Error(ErrorCode::wrong_use, "a picture's sides must be 200 to 4096 pixels", std::to_string(side));
    if (request.view_angle_deg < kNarrowest_deg || request.view_angle_deg > kWidest_deg)
        throw Error(ErrorCode::wrong_use, "the field of view must be 20 to 150 degrees",
                    std::to_string(request.view_angle_deg));
    if (!request.window.empty())
        scan.window(request.window);
    if (!request.peel.preset.empty())
        transferFunction(request.peel.preset);
    const bool casts = request.wall.acquired || !request.peel.preset.empty();
    if (casts && scan.quantity() == Quantity::signal)
        throw Error(ErrorCode::wrong_use,
                    request.wall.acquired ? "the wall as acquired is one of densities, and MR has none"
                                          : "translucency shows densities, and MR has none",
                    request.wall.acquired ? "--as-acquired" : "--peel");
    return request;
}

Picture bandSnapshot(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    NoProgress quiet;
    BandRequest band;
    band.width = request.width;
    band.height = request.height;
    band.pixel_ratio = request.pixel_ratio;
    band.from_caecum = request.from_caecum;
    if (!request.whole_band) {
        band.middle_mm = place.station_mm;
        band.eye = place;
    }
    band.markers = request.markers;
    band.priors = request.priors;
    band.caption = request.caption;
    band.captioned = request.captioned;
    return bandPicture(scan, bandOf(scan, quiet), band, quiet).picture;
}

OverlayText lineOf(const std::string& text, Rgb color)
{
    OverlayText line;
    line.text = text;
    line.color = color;
    return line;
}

}  // namespace

Caption captionFor(const CaseRecord& a_case, const ScanRecord& scan)
{
    return {a_case.patient.name,       a_case.patient.id,
            a_case.patient.birth_date, positionName(scan.series.patient_position),
            a_case.study.date,         true,
            scan.series.lossy};
}

SnapshotResult placeOf(const PreparedScan& scan, const SnapshotRequest& request)
{
    const Lumen lumen = scan.lumen();
    ViewPose view;
    double station = request.station_mm;
    if (request.look_at_mm) {
        view = poseForPoint(scan.skeleton(), scan.frames(), lumen, *request.look_at_mm);
        station = scan.skeleton().nearest(*request.look_at_mm).station_mm;
    } else {
        view = poseAtStation(scan.frames(), lumen, request.station_mm, Heading::caecum);
        station = view.station_mm;
    }
    return {view.pose, station, view.clearance_mm, view.sees_target};
}

std::vector<OverlayText> patientLines(const Caption& caption)
{
    std::vector<OverlayText> lines;
    const auto joined = [](const std::string& a, const std::string& b) {
        return a.empty() || b.empty() ? a + b : a + "   " + b;
    };
    const std::string born = caption.birth_date.empty() ? "" : "born " + printedDate(caption.birth_date);
    const std::string id = caption.patient_id.empty() ? "" : "ID " + caption.patient_id;
    const std::string name = caption.named ? printedPatientName(caption.patient_name) : "";
    for (const std::string& text :
         {name, caption.named ? joined(id, born) : "", joined(caption.position, printedDate(caption.study_date))})
        if (!text.empty())
            lines.push_back(lineOf(text, kTextColor));
    return lines;
}

std::vector<OverlayText> captionLines(const Caption& caption, double station_mm, double length_mm,
                                      const OrganWords& words)
{
    std::vector<OverlayText> lines = patientLines(caption);
    if (words.has_path)
        for (const std::string& text : stationTexts(station_mm, length_mm, words))
            lines.push_back(lineOf(text, kTextColor));
    if (caption.lossy)
        lines.push_back(lineOf("LOSSY COMPRESSION", kWarningColor));
    return lines;
}

DrawnSnapshot drawSnapshot(const PreparedScan& scan, const SnapshotRequest& request)
{
    const SnapshotRequest whole = completed(scan, request);
    const SnapshotResult place = placeOf(scan, whole);
    switch (whole.view) {
        case SnapshotView::slices:
            return {slicesPicture(scan, whole, place), place};
        case SnapshotView::overview:
            return {overviewPicture(scan, whole, place), place};
        case SnapshotView::band:
            return {bandSnapshot(scan, whole, place), place};
        case SnapshotView::cube:
            return {EndoscopicPictures(scan).drawCube(whole, place), place};
        case SnapshotView::endo:
            break;
    }
    return {EndoscopicPictures(scan).draw(whole, place), place};
}

SnapshotResult renderSnapshot(const PreparedScan& scan, const SnapshotRequest& request,
                              const std::filesystem::path& png)
{
    DrawnSnapshot drawn = drawSnapshot(scan, request);
    writePng(png, drawn.picture);
    return drawn.place;
}

}  // namespace vicon::viewer
