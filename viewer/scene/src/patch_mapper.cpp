#include "patch_mapper.h"

#include <vtkCellArray.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLIndexBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

#include <cstdint>

namespace vicon::viewer {
namespace {

constexpr const char* kPrimitiveIdOffset = "PrimitiveIDOffset";  // VTK's name

}  // namespace

vtkStandardNewMacro(PatchMapper);

void PatchMapper::drawOnly(const std::vector<TriangleRun>& runs)
{
    drawAll();
    all_ = false;
    for (const TriangleRun& run : runs) {
        counts_.push_back(int(run.count * 3));
        // NOLINTNEXTLINE(performance-no-int-to-ptr): how OpenGL takes an offset into a bound buffer
        offsets_.push_back(reinterpret_cast<const void*>(run.first * 3 * sizeof(unsigned int)));
    }
}

void PatchMapper::drawAll()
{
    all_ = true;
    counts_.clear();
    offsets_.clear();
}

void PatchMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
    vtkOpenGLState* state = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow())->GetState();
    const vtkOpenGLState::ScopedglEnableDisable as_before(state, GL_BLEND);
    state->vtkglDisable(GL_BLEND);
    vtkOpenGLHelper& triangles = Primitives[PrimitiveTris];
    // VTK may leave out degenerate triangles when it fills the index buffer; then runs would not fit, and all is drawn.
    const bool fits = triangles.IBO->IndexCount == std::size_t(GetInput()->GetNumberOfPolys()) * 3;
    if (all_ || !fits) {
        vtkOpenGLPolyDataMapper::RenderPieceDraw(renderer, actor);
        return;
    }
    if (counts_.empty())
        return;
    // What VTK says of itself before it draws triangles; it decides on shader and colours.
    DrawingVertices = false;
    DrawingSelection = false;
    UpdateShaders(triangles, renderer, actor);
    triangles.IBO->Bind();
    if (!triangles.Program->IsUniformUsed(kPrimitiveIdOffset))
        glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(), GLsizei(counts_.size()));
    else  // triangles have colours of their own, and OpenGL numbers them from 0 in each run
        for (std::size_t n = 0; n < counts_.size(); ++n) {
            const auto first = reinterpret_cast<std::uintptr_t>(offsets_[n]) / (3 * sizeof(unsigned int));
            triangles.Program->SetUniformi(kPrimitiveIdOffset, int(first));
            glDrawElements(GL_TRIANGLES, counts_[n], GL_UNSIGNED_INT, offsets_[n]);
        }
    triangles.IBO->Release();
}

}  // namespace vicon::viewer
