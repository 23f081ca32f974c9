#include "patch_mapper.h"

#include <vtkCellArray.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLIndexBufferObject.h>
#include <vtkPolyData.h>
#include <vtk_glew.h>

namespace vicon::viewer {

vtkStandardNewMacro(PatchMapper);

void PatchMapper::drawOnly(std::vector<TriangleRun> runs)
{
    all_ = false;
    runs_ = std::move(runs);
}

void PatchMapper::drawAll()
{
    all_ = true;
    runs_.clear();
}

void PatchMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
    vtkOpenGLHelper& triangles = Primitives[PrimitiveTris];
    // VTK may leave out degenerate triangles when it fills the index buffer; then runs would not fit, and all is drawn.
    const bool fits = triangles.IBO->IndexCount == std::size_t(GetInput()->GetNumberOfPolys()) * 3;
    if (all_ || !fits) {
        vtkOpenGLPolyDataMapper::RenderPieceDraw(renderer, actor);
        return;
    }
    if (runs_.empty())
        return;
    // What VTK says of itself before it draws triangles; it decides on shader and colours.
    DrawingVertices = false;
    DrawingSelection = false;
    UpdateShaders(triangles, renderer, actor);
    triangles.IBO->Bind();
    for (const TriangleRun& run : runs_)
        glDrawElements(GL_TRIANGLES, GLsizei(run.count * 3), GL_UNSIGNED_INT,
                       // NOLINTNEXTLINE(performance-no-int-to-ptr): how OpenGL takes an offset into a bound buffer
                       reinterpret_cast<const void*>(run.first * 3 * sizeof(unsigned int)));
    triangles.IBO->Release();
}

}  // namespace vicon::viewer
