#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/option_names.h"
#include "vicon/viewer/model/peeling.h"
#include "vicon/viewer/model/prior_place.h"
#include "vicon/viewer/model/view_pose.h"
#include "vicon/viewer/model/wall_look.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/prepared_scan.h"

namespace vicon::viewer {

/// What every picture says about whom and what it shows.
struct Caption {
    std::string patient_name;  ///< UTF-8, in DICOM's form or as people write it
    std::string patient_id;
    std::string birth_date;  ///< YYYYMMDD or as it shall be printed
    std::string position;    ///< "supine", "prone", ...
    std::string study_date;  ///< YYYYMMDD or as it shall be printed
    bool named = true;       ///< false: it says which scan it is of, not whose, as what surrounds it does
    bool lossy = false;      ///< the pixels went through a lossy compression: printed as a warning
};

/// The caption of a scan's pictures.
Caption captionFor(const CaseRecord& a_case, const ScanRecord& scan);

/// A look below the wall.
struct PeelRequest {
    std::string preset;  ///< of config/transfer_functions.toml; empty: none
    PeelingOptions options;
    int coarse = 1;                  ///< one ray for a square of so many pixels a side: quicker, while the eye moves
    bool middle_only = false;        ///< only within a circle; the surface stays around it
    bool over_surface = false;       ///< laid half transparent over the surface; else in its place
    std::optional<Pixel> circle_at;  ///< its centre; nothing: the middle of the picture
    double circle_px = 0;            ///< its radius; 0: three tenths of the picture's smaller side
};

enum class SnapshotView { endo, slices, overview, cube, band };
inline constexpr EnumNames<SnapshotView, 5> kSnapshotViewNames{{
    {SnapshotView::endo, "endo"},
    {SnapshotView::slices, "slices"},
    {SnapshotView::overview, "overview"},
    {SnapshotView::cube, "cube"},
    {SnapshotView::band, "band"},
}};
constexpr const auto& optionNames(SnapshotView /*value*/)
{
    return kSnapshotViewNames;
}

/// A picture of a scan.
struct SnapshotRequest {
    SnapshotView view = SnapshotView::endo;
    std::optional<Point3> look_at_mm;  ///< what to look at (a marker's position); empty: the place at `station_mm`
    double station_mm = 0;             ///< used without `look_at_mm`; beyond the ends: the end
    std::vector<Marker> markers;       ///< drawn where they are in view
    std::vector<PriorPlace> priors;    ///< where findings of earlier reports, or another scan's place, should lie
    Caption caption;
    bool captioned = true;       ///< who, when and where is written into the picture
    int width = 0;               ///< pixels, kLeastSide to kMostSide; 0: 1024
    int height = 0;              ///< 0: 768, or 1024 for the overview
    double pixel_ratio = 1;      ///< of the screen that it is shown on; text is as high there as on any other
    double text_px = 0;          ///< height of what is written; 0: as is read well in a picture of this size
    double view_angle_deg = 90;  ///< endo: over the picture's height, 20 to 150
    WallLook wall;               ///< endo, cube: how the wall looks
    std::string window;          ///< slices: a preset of config/windows.toml; empty: the organ's default
    bool cleansed = false;       ///< slices: without tagging, where that was taken out
    bool from_caecum = false;    ///< band: its rows begin there
    bool whole_band = true;      ///< band: all of it, in rows; else a single row around the place
    double slice_field_mm = 0;   ///< slices: how much to show around the point; 0: the whole scan
    PeelRequest peel;            ///< endo: the look below the wall

    static constexpr int kLeastSide = 200;
    static constexpr int kMostSide = 4096;
};

/// What a picture turned out to show.
struct SnapshotResult {
    Pose pose;                ///< endo: the eye; others: the eye that the endo picture would have
    double station_mm = 0;    ///< of the place shown, or of the marker's foot on the skeleton
    double clearance_mm = 0;  ///< of the eye from the wall
    bool sees_target = true;  ///< endo: false where nothing inside the lumen has the marker in plain view
};

struct DrawnSnapshot {
    Picture picture;
    SnapshotResult place;
};

/// Starts a private display for the time of the call where there is none; for many pictures hold a Display. The same
/// scan and request give the same picture on the same machine. Throws Error{wrong_use} for a size or an angle out of
/// range, Error{not_ready}, Error{no_display}.
DrawnSnapshot drawSnapshot(const PreparedScan& scan, const SnapshotRequest& request);
/// The same, written as PNG by replaceFile(). Throws Error{store}, too.
SnapshotResult renderSnapshot(const PreparedScan& scan, const SnapshotRequest& request,
                              const std::filesystem::path& png);

}  // namespace vicon::viewer
