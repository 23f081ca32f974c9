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
    /// Until the next call of these two: once as many triangles have been given to OpenGL, it begins to fill pixels.
    void handOverAfter(std::size_t triangles);

    PatchMapper(const PatchMapper&) = delete;
    PatchMapper& operator=(const PatchMapper&) = delete;

protected:
    PatchMapper() = default;
    ~PatchMapper() override = default;
    void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

private:
    void drawRuns(std::size_t first, std::size_t end) const;

    bool all_ = true;
    std::size_t hand_over_after_ = 0;   ///< runs; 0: never
    std::vector<int> counts_;           ///< of each run, in corners
    std::vector<const void*> offsets_;  ///< of each run, in bytes of the index buffer
};

}  // namespace vicon::viewer
