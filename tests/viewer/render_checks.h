#pragma once

#include "vicon/viewer/scene/prepared_scan.h"

namespace vicon::viewer::test {

/// Pictures with culling against pictures of everything, pixel by pixel, from random eyes inside the lumen.
void expectCulledPicturesIdentical(const PreparedScan& scan, int poses, unsigned seed, int side = 200,
                                   bool ambient_occlusion = false);

}  // namespace vicon::viewer::test
