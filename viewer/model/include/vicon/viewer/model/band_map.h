#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/path_frames.h"

namespace vicon::viewer {

/// A place of the band: how far along, and how far around. Around is 0 where the path's frame has its up, and grows to
/// the right of one who looks towards the caecum with that up.
struct BandPlace {
    double station_mm = 0;
    double around_rad = 0;
};

/// The wall of a whole colon, cut open and laid flat: each triangle has one place in the band. A corner's place is the
/// nearest one of the path in its own loop, which the distance from the exit tells, and the angle around it, both
/// evened out over the wall (after Haker's flattening and Yao's reversible unfolding: S. Haker et al., IEEE TMI 19(7),
/// 2000; J. Yao et al., IEEE TBME 57(12), 2010).
class BandMap {
public:
    /// @param surface and `path` must outlive it; of an organ that is one way from end to end
    /// @param exit_distance of the same scan
    /// Throws Error{cancelled}. Takes some seconds for a colon.
    BandMap(const CellSurface& surface, const PathFrames& path, const FieldView& exit_distance, Progress& progress);

    const CellSurface& surface() const { return *surface_; }
    const PathFrames& path() const { return *path_; }
    double firstStation_mm() const { return first_mm_; }  ///< before the path's beginning where wall lies there
    double lastStation_mm() const { return last_mm_; }

    /// How wide half a turn is laid out at a station, over pi: about the lumen's radius, so that shapes are kept.
    double radiusAt_mm(double station_mm) const;
    /// The corners of a triangle, the middle of their angles from -pi to pi; a corner's own may lie beyond.
    std::array<BandPlace, 3> cornersOf(std::size_t triangle) const;
    double station_mm(std::size_t point) const { return station_mm_[point]; }
    /// How far a point of the surface lies from the path.
    double depth_mm(std::size_t point) const { return depth_mm_[point]; }
    /// Area in the band over area of the wall around a point, within some 3 mm.
    double areaFactor(std::size_t point) const { return area_factor_[point]; }
    /// The share of the wall's area that lies under other wall in the band: folded over, as behind an overhang.
    double turnedShare() const { return turned_share_; }

    /// The place of a point on or near the wall: of the nearest of the surface.
    BandPlace placeOf(Point3 p) const;

private:
    void findRadii();
    /// For each point the areas of its triangles, in the band and of the wall.
    std::vector<float> areasOfPoints();

    const CellSurface* surface_;
    const PathFrames* path_;
    std::vector<float> station_mm_, around_rad_, depth_mm_, area_factor_;  // of each point
    std::vector<double> radius_mm_;                                        // of each millimetre
    double first_mm_ = 0, last_mm_ = 0;
    double turned_share_ = 0;
};

}  // namespace vicon::viewer
