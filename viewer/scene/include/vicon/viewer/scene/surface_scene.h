#pragma once

#include <array>
#include <memory>
#include <vector>

#include "vicon/scan_files/cells_file.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/overlay.h"
#include "vicon/viewer/model/path_frames.h"
#include "vicon/viewer/model/wall_look.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/cell_visibility.h"

class vtkRenderer;

namespace vicon::viewer {

/// Red, green and blue, 0 to 1, of a wall in the light; by depth the light itself is coloured.
std::array<double, 3> wallColor(WallColors colors);

/// How far the lamp at the eye reaches, where it has lost half of its strength, in a lumen of usual width.
constexpr double kUsualLampReach_mm = 45;
/// The same for the lumen around a station: the wider it is, the farther. The near wall is not burnt out, and the lumen
/// is readable to some 15 cm.
double lampReachAt_mm(const PathFrames& path, double station_mm);

/// The colon's surface in a VTK renderer, one actor a cell, lit by a lamp at the eye. Works in any render window: the
/// reading room puts renderer() into its widget, pictures without a window come from OffscreenSurface.
class SurfaceScene {
public:
    explicit SurfaceScene(const CellSurface& surface);
    ~SurfaceScene();
    SurfaceScene(SurfaceScene&&) noexcept;
    SurfaceScene& operator=(SurfaceScene&&) noexcept;

    vtkRenderer* renderer() const;

    /// The endoscopic view: perspective, light that fades with the distance.
    void lookFrom(const Pose& pose, double view_angle_deg);

    /// Draws only these segments' cells; empty: all.
    void showOnly(const std::vector<int>& segments);
    /// Draws only what CellVisibility found; it must have been made for the same surface.
    void showSeen(const VisibleParts& parts);
    /// The next picture, which shows the same, also hands the driver all that it does not show. What is shown for the
    /// first time later costs its picture tens of milliseconds otherwise.
    void sendAll();
    /// Paints each cell in a colour of its own.
    void colorCells(bool on);
    /// How far the lamp reaches: the distance at which it has lost half of its strength.
    void setLampReach(double half_mm);
    /// Ambient occlusion: the less open the lumen is before the wall, the less light. Costs a frame next to nothing.
    /// @param surface that this scene was made from
    /// @param openness of opennessOf() for it
    void shadeByOpenness(const CellSurface& surface, const std::vector<float>& openness);
    /// Without ambient occlusion, as at the beginning.
    void shadeEvenly();
    /// What the wall is coloured by; mucosa at the beginning.
    void setColors(WallColors colors);
    /// Blue where tagging touches the wall.
    /// @param surface that this scene was made from
    /// @param tagging of taggingOf() for it
    void tintTagging(const CellSurface& surface, const std::vector<float>& tagging);
    /// Without that tint, as at the beginning.
    void tintNothing();

    std::size_t cellCount() const;
    std::size_t triangleCount() const;
    std::size_t cellsShown() const;
    std::size_t trianglesShown() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace vicon::viewer
