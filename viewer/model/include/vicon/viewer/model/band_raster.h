#pragma once

#include <optional>
#include <vector>

#include "vicon/viewer/model/band_page.h"
#include "vicon/viewer/model/triangle_raster.h"

namespace vicon::viewer {

/// What each pixel of a page of a band shows: of wall that lies over other wall, that nearest to the path.
class BandRaster {
public:
    BandRaster(const BandMap& band, const BandPage& page);

    const BandPage& page() const { return page_; }
    std::optional<TriangleRaster::Hit> at(int x, int y) const;

private:
    BandPage page_;
    std::vector<TriangleRaster> rows_;
    std::vector<int> first_row_;  // of pixels, of each row of the band
};

}  // namespace vicon::viewer
