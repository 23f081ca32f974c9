#pragma once

class vtkShaderProperty;

namespace vicon::viewer {

/// A lamp at the eye, in place of VTK's shaders: one light, one material that lets nothing through, and no more work
/// for a pixel than that takes. For data with unit normals.
/// @param reach_mm distance at which the lamp has lost half of its strength
/// @param by_openness less light where the attribute `openness` (addOpenness()) is small
void useLampShader(vtkShaderProperty* shader, double reach_mm, bool by_openness);
/// Of a shader that useLampShader() made.
void setLampReach(vtkShaderProperty* shader, double reach_mm);

}  // namespace vicon::viewer
