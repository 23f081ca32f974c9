#pragma once

#include "vicon/viewer/scene/band_picture.h"

namespace vicon::viewer {

/// The wall of a band, without anything written: lit from the upper left, so that what rises is told from what sinks;
/// darker where it is repeated; hatched where areas are off.
/// @param openness of the wall's points; empty: evenly lit
/// @param raster finer by this than the picture
Picture bandWall(const BandMap& band, const BandRaster& raster, int finer, const std::vector<std::uint8_t>& seen,
                 const std::vector<float>& openness, Progress& progress);

}  // namespace vicon::viewer
