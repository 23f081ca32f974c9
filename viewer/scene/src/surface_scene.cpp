#include "vicon/viewer/scene/surface_scene.h"

#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cell_actors.h"
#include "lamp_shader.h"

namespace vicon::viewer {
namespace {

std::array<double, 3> cellColor(int segment)
{
    constexpr double kGoldenAngle = 2.399963;  // neighbours get hues far apart
    const double hue = segment * kGoldenAngle;
    const auto part = [&](double turn) { return 0.62 + 0.3 * std::cos(hue - turn); };
    return {part(0), part(2 * std::numbers::pi / 3), part(4 * std::numbers::pi / 3)};
}

}  // namespace

std::array<double, 3> wallColor(WallColors colors)
{
    constexpr std::array kMucosa{0.93, 0.66, 0.56}, kBone{0.93, 0.9, 0.82};
    return colors == WallColors::bone ? kBone : kMucosa;
}

double lampReachAt_mm(const PathFrames& path, double station_mm)
{
    // Chosen by eye on tubes of 8 to 25 mm radius and a real scan.
    constexpr double kPerRadius = 3, kLeast_mm = 36, kMost_mm = 80;
    constexpr double kAround_mm = 40, kStep_mm = 5;  // so that the light does not flicker from fold to fold
    double radii_mm = 0, count = 0;
    for (double off_mm = -kAround_mm; off_mm <= kAround_mm; off_mm += kStep_mm, ++count)
        radii_mm += path.at(station_mm + off_mm).radius_mm;
    return std::clamp(kPerRadius * radii_mm / count, kLeast_mm, kMost_mm);
}

struct SurfaceScene::Parts {
    std::vector<CellActor> cells;
    std::vector<Patch> patches;
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkLight> lamp;
    double lamp_reach_mm = kUsualLampReach_mm;
    LampLook look;
    bool color_cells = false, has_openness = false, has_tagging = false;

    void setMaterial() const
    {
        for (const CellActor& cell : cells) {
            vtkProperty* p = cell.actor->GetProperty();
            const auto color = color_cells ? cellColor(cell.segment) : wallColor(look.colors);
            p->SetColor(color[0], color[1], color[2]);
            p->SetAmbient(0);
            p->SetDiffuse(1);
            p->BackfaceCullingOn();
        }
    }

    void setLamp() const
    {
        lamp->SetLightTypeToHeadlight();
        for (const CellActor& cell : cells)
            useLampShader(cell.actor->GetShaderProperty(), lamp_reach_mm, look);
    }
};

SurfaceScene::SurfaceScene(const CellSurface& surface) : parts_(std::make_unique<Parts>())
{
    parts_->cells = cellActors(surface);
    parts_->patches = patchesOf(surface.segment);
    for (const CellActor& cell : parts_->cells)
        parts_->renderer->AddActor(cell.actor);
    parts_->renderer->SetBackground(0, 0, 0);
    parts_->renderer->AutomaticLightCreationOff();
    parts_->renderer->RemoveAllLights();
    parts_->renderer->AddLight(parts_->lamp);
    parts_->setMaterial();
    parts_->setLamp();
}

SurfaceScene::~SurfaceScene() = default;
SurfaceScene::SurfaceScene(SurfaceScene&&) noexcept = default;
SurfaceScene& SurfaceScene::operator=(SurfaceScene&&) noexcept = default;

vtkRenderer* SurfaceScene::renderer() const
{
    return parts_->renderer;
}

void SurfaceScene::lookFrom(const Pose& pose, double view_angle_deg)
{
    placeCamera(parts_->renderer->GetActiveCamera(), pose, view_angle_deg);
}

void SurfaceScene::showOnly(const std::vector<int>& segments)
{
    viewer::showOnly(parts_->cells, segments);
}

void SurfaceScene::showSeen(const VisibleParts& parts)
{
    if (parts.everything)
        viewer::showOnly(parts_->cells, {});
    else if (parts.patches.size() == parts_->patches.size())
        viewer::showPatches(parts_->cells, parts_->patches, parts);
    else
        viewer::showOnly(parts_->cells, parts.segments);
}

void SurfaceScene::sendAll()
{
    viewer::sendAll(parts_->cells);
}

void SurfaceScene::colorCells(bool on)
{
    parts_->color_cells = on;
    parts_->setMaterial();
}

void SurfaceScene::setLampReach(double half_mm)
{
    parts_->lamp_reach_mm = half_mm;
    for (const CellActor& cell : parts_->cells)
        viewer::setLampReach(cell.actor->GetShaderProperty(), half_mm);
}

void SurfaceScene::shadeByOpenness(const CellSurface& surface, const std::vector<float>& openness)
{
    if (!parts_->has_openness)
        addAttribute(parts_->cells, surface, kOpenness, openness);
    parts_->has_openness = parts_->look.by_openness = true;
    parts_->setLamp();
}

void SurfaceScene::shadeEvenly()
{
    parts_->look.by_openness = false;
    parts_->setLamp();
}

void SurfaceScene::setColors(WallColors colors)
{
    parts_->look.colors = colors;
    parts_->setMaterial();
    parts_->setLamp();
}

void SurfaceScene::tintTagging(const CellSurface& surface, const std::vector<float>& tagging)
{
    if (!parts_->has_tagging)
        addAttribute(parts_->cells, surface, kTagging, tagging);
    parts_->has_tagging = parts_->look.by_tagging = true;
    parts_->setLamp();
}

void SurfaceScene::tintNothing()
{
    parts_->look.by_tagging = false;
    parts_->setLamp();
}

std::size_t SurfaceScene::cellCount() const
{
    return parts_->cells.size();
}

std::size_t SurfaceScene::triangleCount() const
{
    std::size_t sum = 0;
    for (const CellActor& cell : parts_->cells)
        sum += cell.triangles;
    return sum;
}

std::size_t SurfaceScene::cellsShown() const
{
    std::size_t sum = 0;
    for (const CellActor& cell : parts_->cells)
        sum += cell.drawn > 0 ? 1 : 0;
    return sum;
}

std::size_t SurfaceScene::trianglesShown() const
{
    std::size_t sum = 0;
    for (const CellActor& cell : parts_->cells)
        sum += cell.drawn;
    return sum;
}

}  // namespace vicon::viewer
