#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "mask/image_header.h"

namespace vicon::ingest {

/// A frame of a segmentation: a plane of the patient, and whose it is.
struct SegmentFrame {
    Point3 first_mm;  ///< centre of its first pixel
    int segment = 0;
};

/// The planes of a segmentation's frames. All have one matrix and lie alike.
struct FramePlanes {
    int rows = 0, columns = 0;
    Vector3 column_step_mm;       ///< from pixel to pixel of a row
    Vector3 row_step_mm;          ///< from row to row
    double declared_step_mm = 0;  ///< between slices, as the object says; 0: it does not
    std::vector<SegmentFrame> frames;
};

/// The lattice on which all frames lie, and the slice of each. Throws Error{bad_input} where there is none: frames that
/// lie unevenly, or lean.
struct FrameStack {
    Grid grid;
    std::vector<int> slice;  ///< of each frame
};
FrameStack stackOf(const FramePlanes& planes, double largest_mvoxel, const std::filesystem::path& file);

}  // namespace vicon::ingest
