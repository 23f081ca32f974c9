#pragma once

#include <QString>
#include <filesystem>

#include "vicon/cases/case_store.h"
#include "vicon/viewer/model/navigator.h"
#include "vicon/viewer/model/scan_coverage.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/prepared_scan.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// A scan that is open: its files, read, and where the eye is in it.
struct OpenScan {
    PreparedScan files;
    ScanRecord record;
    Caption caption;        ///< of pictures in the window, which says itself whose they are
    Caption saved_caption;  ///< of pictures that leave it
    Lumen lumen;
    Navigator navigator;
    ScanCoverage coverage;
    std::filesystem::file_time_type made;  ///< when its files were
    int branch = -1;                       ///< whose end the way leads to; below 0: to the farthest tip

    OpenScan(PreparedScan prepared, const ScanRecord& scan, const CaseRecord& a_case);
    /// Along a voxel's shortest side: no length below it is known.
    double voxel_mm() const;
    /// "Phantom, Anna - ID PH-1 - born 1960-01-02 - supine 2026-01-02".
    QString inWords() const;
};

/// Whether a place of the one scan has a corresponding place in the other: a path leads through both.
bool haveSamePlaces(const OpenScan& a, const OpenScan& b);

/// When the files of a scan were made; what is open may be older.
std::filesystem::file_time_type madeAt(const std::filesystem::path& folder);

/// The place that slices show while the eye is led: the eye's or, where it is carried over a collapsed segment, the
/// centreline's, for there is wall to be read there, too.
Point3 placeInSlices(const OpenScan& scan, const NavigationState& state);

/// The view that was saved with a marker of this scan; where there is none or the eye would be in the wall: one that
/// shows its place.
ViewPose viewOfMarker(const OpenScan& scan, const Marker& marker);

}  // namespace vicon::viewer
