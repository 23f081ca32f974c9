#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vicon/viewer/model/band_raster.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/prepared_scan.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// What a picture of a band shows, and what is drawn over the wall.
struct BandRequest {
    int width = 0, height = 0;
    double pixel_ratio = 1;             ///< of the screen, as in SnapshotRequest
    double text_px = 0;                 ///< likewise
    std::optional<double> middle_mm;    ///< of a single row, a station; nothing: the whole band, in rows
    bool from_caecum = false;           ///< the rows go from the caecum to the rectum
    std::optional<SnapshotResult> eye;  ///< where it is
    std::vector<Marker> markers;        ///< of the scan
    std::vector<PriorPlace> priors;     ///< likewise
    std::vector<std::uint8_t> seen;     ///< of each triangle, 1: painted as seen; empty: none is
    Caption caption;
    bool captioned = false;  ///< who and when is written above
    bool still = true;       ///< smoothed
};

/// A picture of the band, and what its pixels are.
struct BandPicture {
    Picture picture;
    BandPage page;
    std::shared_ptr<const BandRaster> raster;  ///< finer than the picture by `finer`
    int finer = 1;

    /// The point of the wall that a pixel shows.
    std::optional<Point3> pointAt(const BandMap& band, Pixel at) const;
};

/// Of an organ that is one way from end to end. Throws Error{wrong_use} for one that branches, Error{cancelled}, and as
/// PreparedScan does.
BandMap bandOf(const PreparedScan& scan, Progress& progress);

/// Needs no display. Where the area in the band is less than half or more than twice that of the wall it is hatched.
/// Throws Error{cancelled}, and as PreparedScan does.
/// @param band of this scan
BandPicture bandPicture(const PreparedScan& scan, const BandMap& band, const BandRequest& request, Progress& progress);

}  // namespace vicon::viewer
