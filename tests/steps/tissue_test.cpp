#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tissue_scene.h"
#include "vicon/core/error.h"
#include "vicon/steps/cells.h"

namespace vicon::steps {
namespace {

TEST(Tissue, ASpeckInTheLumenIsNoWallButALumpIs)
{
    for (const auto& [radius_mm, is_wall] : {std::pair{1.7, false}, std::pair{3.2, true}}) {
        Scene scene([r = radius_mm](Point3 p) { return std::abs(p.x) > 12 || distance(p, {}) < r; }, 20);
        for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n)
            if (std::abs(scene.grid.pointAt(scene.grid.indexOf(n)).x) < 8)
                scene.inside.voxels[n] = kGas;
        const InsideVolume lumen = scene.find().lumen;
        const Index3 middle{scene.grid.size[0] / 2, scene.grid.size[1] / 2, scene.grid.size[2] / 2};
        EXPECT_EQ(lumen.at(middle) == kOutside, is_wall) << radius_mm;
    }
}

TEST(Tissue, OnAnotherGridIsRefused)
{
    const Scene scene([](Point3 p) { return std::abs(p.x) > 5; }, 20, 0, 16);
    NoProgress quiet;
    TissueVolume other(Grid{.size = {4, 4, 4}});
    EXPECT_THROW(LumenSurface(other, scene.inside, quiet), Error);
}

}  // namespace
}  // namespace vicon::steps
