#pragma once

#include <cstdint>
#include <vector>

#include "pictures.h"
#include "vicon/core/cell_surface.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// How much of the wall that lies before and behind each place of a projection was reviewed.
class ReviewedWall {
public:
    /// Nothing was. @param surface must outlive it
    ReviewedWall(const CellSurface& surface, const PlaneView& view);

    /// @param seen of each triangle, 1 where it was reviewed; else 0
    void see(const std::vector<std::uint8_t>& seen);
    /// 0 to 1; 0 where there is no wall.
    double shareAt(Pixel at) const;

private:
    struct Place {
        float whole_mm2 = 0, seen_mm2 = 0;
    };
    void add(std::size_t triangle, float area_mm2, float Place::*to);
    /// The four places around a pixel, with their weights.
    template <class Do>
    void around(Pixel at, Do what) const;

    const CellSurface& surface_;
    PlaneView view_;
    double place_px_;
    int width_, height_;
    std::vector<float> areas_mm2_;
    std::vector<std::uint8_t> seen_;
    std::vector<Place> places_;
};

/// Tints the projection's wall by what was reviewed of it; what is written over it stays as it is.
void paintReviewed(OverviewGround& ground, const ReviewedWall& reviewed);

}  // namespace vicon::viewer
