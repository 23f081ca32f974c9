#pragma once

#include <string>
#include <vector>

#include "vicon/cases/prior_match.h"
#include "vicon/cases/station_map.h"
#include "vicon/core/skeleton.h"
#include "vicon/viewer/model/lumen.h"
#include "vicon/viewer/model/overlay.h"
#include "vicon/viewer/model/path_frames.h"

namespace vicon::viewer {

inline constexpr Rgb kPriorColor{196, 160, 255};

inline constexpr Rgb kSamePlaceColor{120, 230, 170};

/// Where something should lie in a scan, a finding of an earlier report or the same place of another scan: a stretch of
/// the centreline, not a point of the wall.
struct PriorPlace {
    std::string label;                                 ///< "2021: polyp 7.0 mm"
    Point3 position_mm;                                ///< of the centreline, in the middle of what is expected
    std::vector<Point3> band_mm;                       ///< along the centreline, as far as it is expected
    double station_mm = 0, least_mm = 0, most_mm = 0;  ///< the same as stations
    Rgb color = kPriorColor;
};
/// @param least_mm,most_mm stations; beyond the ends: the ends
PriorPlace priorPlace(const std::string& label, const Skeleton& skeleton, double station_mm, double least_mm,
                      double most_mm);

/// Where a place of another scan lies in this one, with the interval of 80 %. @param label "supine: same place"
PriorPlace samePlace(const std::string& label, const Skeleton& skeleton, const StationInterval& place);

/// Of all findings of earlier reports that say where they lie.
std::vector<PriorPlace> priorPlacesIn(const PriorList& priors, const ScanColon& colon, const Skeleton& skeleton,
                                      const PriorOptions& options);

/// The stretch, beside the centreline's own line.
void addPriorBand(Overlay& overlay, const PlaneView& view, const PriorPlace& place, double text_px);

/// Its label, where there is nothing to find a better place for it.
void addPriorName(Overlay& overlay, Pixel at, const PriorPlace& place, double text_px);

/// What is seen from inside of a stretch: lines around the wall where it begins and where it ends, as far as they are
/// in plain view of an eye. Nothing where the centreline leaves the lumen.
std::vector<std::vector<Point3>> priorRings(const PriorPlace& place, const PathFrames& path, const Lumen& lumen,
                                            Point3 eye_mm);
/// The rings as the eye sees them, with the label.
void addPriorRings(Overlay& overlay, const PriorPlace& place, const PathFrames& path, const Lumen& lumen,
                   const Pose& pose, const Lens& lens, double text_px);

/// In a slice: a diamond where the stretch passes within `near_mm` of the plane, nearest to its middle; dashed where
/// that is not the middle. Nothing where it does not. Its label stands towards the picture's middle.
/// @param depth_mm of the plane, as the view has it
void addPriorDiamond(Overlay& overlay, const PlaneView& view, const PriorPlace& place, double depth_mm, double near_mm,
                     double radius_px, double text_px);

}  // namespace vicon::viewer
