#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vicon/scan_files/cells_file.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/cell_visibility.h"

class vtkRenderer;

namespace vicon::viewer {

/// The surface with each triangle in a colour of its own: which triangles a picture shows.
class IdScene {
public:
    /// Throws Error{bad_input} for a surface of more triangles than there are colours (16.7 million).
    explicit IdScene(const CellSurface& surface);
    ~IdScene();

    vtkRenderer* renderer() const;
    void lookFrom(const Pose& pose, double view_angle_deg);
    void showOnly(const std::vector<int>& segments);
    /// Draws only what CellVisibility found; it must have been made for the same surface.
    void showSeen(const VisibleParts& parts);

    /// The numbers of the triangles in a picture of this scene that was rendered without smoothing; ascending, each
    /// once.
    static std::vector<std::uint32_t> trianglesIn(const Picture& picture);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace vicon::viewer
