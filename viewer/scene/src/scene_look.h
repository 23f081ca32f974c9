#pragma once

#include <functional>
#include <vector>

#include "vicon/viewer/scene/prepared_scan.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace vicon::viewer {

/// What a scene wears, so that it changes only what is wanted otherwise.
class SceneLook {
public:
    using Values = std::function<const std::vector<float>&()>;

    /// @param surface that the scene was made from
    /// @param openness, tagging of its points; asked for when they are first needed. No tagging known: no tint.
    void wear(SurfaceScene& scene, const WallLook& wanted, const CellSurface& surface, const Values& openness,
              const Values& tagging);
    /// The same for the whole surface of a scan.
    void wear(SurfaceScene& scene, const WallLook& wanted, const PreparedScan& scan);

private:
    WallLook worn_{.ambient_occlusion = false};
};

}  // namespace vicon::viewer
