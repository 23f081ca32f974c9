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
/// costs nothing. For data of triangles only, drawn as surfaces, without colours of their own a triangle.
class PatchMapper : public vtkOpenGLPolyDataMapper {
public:
    static PatchMapper* New();
    vtkTypeMacro(PatchMapper, vtkOpenGLPolyDataMapper);

    /// Runs in ascending order. Without a call everything is drawn.
    void drawOnly(std::vector<TriangleRun> runs);
    void drawAll();

    PatchMapper(const PatchMapper&) = delete;
    PatchMapper& operator=(const PatchMapper&) = delete;

protected:
    PatchMapper() = default;
    ~PatchMapper() override = default;
    void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

private:
    bool all_ = true;
    std::vector<TriangleRun> runs_;
};

}  // namespace vicon::viewer
