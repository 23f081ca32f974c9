#pragma once

#include <vtkOpenGLPolyDataMapper.h>

#include <cstddef>
#include <vector>

namespace vicon::viewer {

/// A run of triangles.
struct TriangleRun {
    std::size_t first = 0, count = 0;
};

/// Draws only some of the triangles of its data, which stay where they are in the driver's memory: choosing others
/// costs nothing. For data of triangles only that let nothing through, drawn as surfaces.
class PatchMapper : public vtkOpenGLPolyDataMapper {
public:
    static PatchMapper* New();
    vtkTypeMacro(PatchMapper, vtkOpenGLPolyDataMapper);

    /// Runs in ascending order. Without a call everything is drawn.
    void drawOnly(const std::vector<TriangleRun>& runs);
    void drawAll();

    PatchMapper(const PatchMapper&) = delete;
    PatchMapper& operator=(const PatchMapper&) = delete;

protected:
    PatchMapper() = default;
    ~PatchMapper() override = default;
    void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

private:
    bool all_ = true;
    std::vector<int> counts_;           ///< of each run, in corners
    std::vector<const void*> offsets_;  ///< of each run, in bytes of the index buffer
};

}  // namespace vicon::viewer
