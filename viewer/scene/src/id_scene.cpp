#include "vicon/viewer/scene/id_scene.h"

#include <vtkCellData.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

#include "cell_actors.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr std::size_t kMostIds = (1U << 24) - 1;  // black is the ground

vtkSmartPointer<vtkUnsignedCharArray> idColors(std::size_t first, std::size_t count)
{
    auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
    colors->SetNumberOfComponents(3);
    colors->SetNumberOfTuples(vtkIdType(count));
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t id = first + n + 1;
        for (int c = 0; c < 3; ++c)
            colors->SetTypedComponent(vtkIdType(n), c, std::uint8_t(id >> (8 * c) & 255));
    }
    return colors;
}

}  // namespace

struct IdScene::Parts {
    std::vector<CellActor> cells;
    std::vector<Patch> patches;
    vtkNew<vtkRenderer> renderer;
};

IdScene::IdScene(const CellSurface& surface) : parts_(std::make_unique<Parts>())
{
    if (surface.triangleCount() > kMostIds)
        throw Error(ErrorCode::bad_input, "the surface has too many triangles for a colour each");
    parts_->cells = cellActors(surface);
    parts_->patches = patchesOf(surface.segment);
    for (const CellActor& cell : parts_->cells) {
        cell.data->GetPointData()->SetNormals(nullptr);
        cell.data->GetCellData()->SetScalars(idColors(cell.first_triangle, cell.triangles));
        cell.actor->GetMapper()->ScalarVisibilityOn();
        cell.actor->GetMapper()->SetScalarModeToUseCellData();
        cell.actor->GetMapper()->SetColorModeToDirectScalars();
        cell.actor->GetProperty()->LightingOff();
        cell.actor->GetProperty()->SetBackfaceCulling(true);
        parts_->renderer->AddActor(cell.actor);
    }
    parts_->renderer->SetBackground(0, 0, 0);
}

IdScene::~IdScene() = default;

vtkRenderer* IdScene::renderer() const
{
    return parts_->renderer;
}

void IdScene::lookFrom(const Pose& pose, double view_angle_deg)
{
    placeCamera(parts_->renderer->GetActiveCamera(), pose, view_angle_deg);
}

void IdScene::showOnly(const std::vector<int>& segments)
{
    viewer::showOnly(parts_->cells, segments);
}

void IdScene::showSeen(const VisibleParts& parts)
{
    if (parts.everything)
        showOnly({});
    else if (parts.patches.size() == parts_->patches.size())
        viewer::showPatches(parts_->cells, parts_->patches, parts);
    else
        showOnly(parts.segments);
}

std::vector<std::uint32_t> IdScene::trianglesIn(const Picture& picture)
{
    std::vector<std::uint32_t> ids;
    ids.reserve(picture.rgb.size() / 3);
    for (std::size_t n = 0; n < picture.rgb.size(); n += 3) {
        const auto* p = picture.rgb.data() + n;
        const std::uint32_t id = p[0] | std::uint32_t(p[1]) << 8 | std::uint32_t(p[2]) << 16;
        if (id != 0)
            ids.push_back(id - 1);
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

}  // namespace vicon::viewer
