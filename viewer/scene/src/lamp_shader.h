#pragma once

#include "vicon/viewer/model/wall_look.h"

class vtkShaderProperty;

namespace vicon::viewer {

/// What the lamp's shader shows beside the shape.
struct LampLook {
    WallColors colors = WallColors::mucosa;
    bool by_openness = false;  ///< less light where the attribute kOpenness is small
    bool by_tagging = false;   ///< blue where the attribute kTagging is large
};
/// Of addAttribute().
constexpr const char* kOpenness = "openness";
constexpr const char* kTagging = "tagging";

/// A lamp at the eye, in place of VTK's shaders: one light, one material that lets nothing through, and no more work
/// for a pixel than that takes. For data with unit normals.
/// @param reach_mm distance at which the lamp has lost half of its strength
void useLampShader(vtkShaderProperty* shader, double reach_mm, const LampLook& look);
/// Of a shader that useLampShader() made.
void setLampReach(vtkShaderProperty* shader, double reach_mm);

}  // namespace vicon::viewer
