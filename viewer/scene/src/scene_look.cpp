#include "scene_look.h"

namespace vicon::viewer {

void SceneLook::wear(SurfaceScene& scene, const WallLook& wanted, const CellSurface& surface, const Values& openness,
                     const Values& tagging)
{
    if (wanted.colors != worn_.colors)
        scene.setColors(wanted.colors);
    if (wanted.ambient_occlusion && !worn_.ambient_occlusion)
        scene.shadeByOpenness(surface, openness());
    if (!wanted.ambient_occlusion && worn_.ambient_occlusion)
        scene.shadeEvenly();
    worn_.colors = wanted.colors;
    worn_.ambient_occlusion = wanted.ambient_occlusion;
    if (wanted.tagging == worn_.tagging)
        return;
    const std::vector<float> none;
    if (const auto& values = wanted.tagging ? tagging() : none; !values.empty())
        scene.tintTagging(surface, values);
    else
        scene.tintNothing();
    worn_.tagging = wanted.tagging;
}

void SceneLook::wear(SurfaceScene& scene, const WallLook& wanted, const PreparedScan& scan)
{
    wear(
        scene, wanted, scan.cells(), [&]() -> const std::vector<float>& { return scan.openness(); },
        [&]() -> const std::vector<float>& { return scan.tagging(); });
}

}  // namespace vicon::viewer
