#pragma once

#include "anatomy.h"
#include "vicon/phantom/phantom.h"

namespace vicon::phantom {

/// Where a scanner lays the voxels: columns of an image run down to the table, slices advance towards the gantry's far
/// side, rows complete a right-handed frame. That gives the ImageOrientationPatient that scanners write: HFS
/// 1\0\0\0\1\0, HFP -1\0\0\0\-1\0, FFS -1\0\0\0\1\0, FFP 1\0\0\0\-1\0. The grid's middle is the trunk's.
Grid scanGrid(const PhantomOptions& options, Placement placement);

}  // namespace vicon::phantom
