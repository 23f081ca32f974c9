#pragma once

#include "vicon/viewer/model/band_map.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// How a band lies in a picture: in one row or in several, as lines of text do, each going on where the one above ends.
/// Seen from inside, so that nothing is mirrored: a row goes to the right from the rectum, up being where angles grow;
/// from the caecum it is the same turned by half a turn. Above and below the full turn an eighth of a turn is repeated,
/// so that nothing is cut at an edge.
struct BandPage {
    static constexpr double kTurn_rad = 2 * 3.14159265358979323846;
    static constexpr double kBeyond_rad = kTurn_rad / 8;  ///< repeated at each edge

    int width = 0, height = 0;  ///< pixels
    int rows = 1;
    double from_mm = 0;  ///< station at the beginning of the first row
    double mm_per_pixel = 1;
    bool from_caecum = false;  ///< stations fall along a row
    double top_px = 0;         ///< above all rows, for what is written there
    double label_px = 0;       ///< at the top of each row

    double rowHeight() const { return (height - top_px) / rows; }
    double rowTop(int row) const { return top_px + row * rowHeight(); }
    double rowLength_mm() const { return width * mm_per_pixel; }
    /// Each row begins with the end of the one above: a finding at the break is whole in one of them.
    double repeated_mm() const { return rows > 1 ? 0.03 * rowLength_mm() : 0; }
    /// Of a row's beginning and end, the lesser first.
    double rowBegin_mm(int row) const;
    double rowLeast_mm(int row) const { return from_caecum ? rowBegin_mm(row) - rowLength_mm() : rowBegin_mm(row); }
    double rowMost_mm(int row) const { return rowLeast_mm(row) + rowLength_mm(); }
    /// What lies in all rows.
    double length_mm() const { return rows * rowLength_mm() - (rows - 1) * repeated_mm(); }

    /// Of a place in the picture, were it in this row.
    Pixel toPixel(const BandMap& band, BandPlace place, int row) const;
    /// The row that shows a station, the first of two; outside all: the nearest.
    int rowOf(double station_mm) const;
    int rowAt(Pixel at) const;
    /// Of a place in the picture: its full turn.
    Pixel toPixel(const BandMap& band, BandPlace place) const;
    /// What of the band lies at a pixel; it may be beyond its edges.
    BandPlace placeAt(const BandMap& band, Pixel at) const;
};

/// The page with the scale at which the widest part of the colon fills a row.
BandPage fitted(const BandMap& band, BandPage page);
/// The page with the whole band, in as many rows as make it largest.
BandPage wholeBand(const BandMap& band, BandPage page);

}  // namespace vicon::viewer
