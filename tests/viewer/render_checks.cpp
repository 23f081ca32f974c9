#include "render_checks.h"

#include <gtest/gtest.h>

#include <random>

#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace vicon::viewer::test {

void expectCulledPicturesIdentical(const PreparedScan& scan, int poses, unsigned seed, int side, bool ambient_occlusion)
{
    SurfaceScene scene(scan.cells());
    if (ambient_occlusion)
        scene.shadeByOpenness(scan.cells(), scan.openness());
    Offscreen offscreen(scene.renderer());
    const CellVisibility visibility(scan);
    const InsideView& inside = scan.inside();
    std::vector<std::size_t> voxels;
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        if (inside.voxels[n] != kOutside && scan.wallDistance().voxels[n] >= 2)
            voxels.push_back(n);
    ASSERT_FALSE(voxels.empty());
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::size_t> pick(0, voxels.size() - 1);
    std::normal_distribution<double> any;
    std::size_t drawn = 0;
    for (int n = 0; n < poses; ++n) {
        const Point3 eye = inside.grid.pointAt(inside.grid.indexOf(voxels[pick(random)]));
        const Pose pose = lookAt(eye, eye + normalized({any(random), any(random), any(random)}),
                                 {any(random), any(random), any(random)});
        const double angle = 60 + 60 * std::uniform_real_distribution<double>()(random);
        scene.lookFrom(pose, angle);
        scene.showOnly({});
        const Picture all = offscreen.render(side, side);
        scene.showSeen(visibility.visibleFrom(pose, {angle, side, side}));
        drawn += scene.trianglesShown();
        ASSERT_EQ(offscreen.render(side, side).rgb, all.rgb) << "pose " << n << ", seed " << seed;
    }
    EXPECT_LT(double(drawn) / poses, 0.6 * double(scene.triangleCount()));  // and yet much is not drawn
}

}  // namespace vicon::viewer::test
