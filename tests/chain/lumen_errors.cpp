#include "lumen_errors.h"

#include <tbb/parallel_for.h>
#include <vtkFlyingEdges3D.h>
#include <vtkGenericCell.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "vicon/steps/cells.h"
#include "vicon/support/poly_data.h"

namespace vicon::test {
namespace {

constexpr std::size_t kEvery = 23;  // of the surfaces' points: some 50,000 a surface tell a percentile well enough

/// Distance from a point to the nearest voxel (a box) of a mask, sought two voxels around; large where there is none.
double toMask(const InsideVolume& mask, Point3 p)
{
    const Grid& grid = mask.grid;
    const ContinuousIndex3 c = grid.continuousIndexAt(p);
    const Index3 at = grid.indexAt(p);
    const auto gap = [](double from, int voxel) { return std::max(0.0, std::abs(from - voxel) - 0.5); };
    double least = 1e9;
    for (int k = at.k - 2; k <= at.k + 2; ++k)
        for (int j = at.j - 2; j <= at.j + 2; ++j)
            for (int i = at.i - 2; i <= at.i + 2; ++i)
                if (mask.valueOr({i, j, k}, kOutside) != kOutside) {
                    const Vector3 d{gap(c.i, i) * grid.spacing_mm[0], gap(c.j, j) * grid.spacing_mm[1],
                                    gap(c.k, k) * grid.spacing_mm[2]};
                    least = std::min(least, length(d));
                }
    return least;
}

struct Excess {
    double all_ml = 0, far_ml = 0, common_ml = 0;
};

/// Voxels of one mask that lie outside another.
Excess beyond(const InsideVolume& mask, const InsideVolume& other)
{
    const Grid& grid = mask.grid;
    const double voxel_ml = grid.voxelVolume_mm3() / 1000;
    const double diagonal_mm = std::hypot(other.grid.spacing_mm[0], other.grid.spacing_mm[1], other.grid.spacing_mm[2]);
    std::vector<Excess> slices(std::size_t(grid.size[2]), Excess{});
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        Excess& sum = slices[std::size_t(k)];
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) {
                if (!mask.at({i, j, k}))
                    continue;
                const Point3 p = grid.pointAt(Index3{i, j, k});
                if (other.valueOr(other.grid.indexAt(p), kOutside) != kOutside) {
                    sum.common_ml += voxel_ml;
                    continue;
                }
                sum.all_ml += voxel_ml;
                sum.far_ml += toMask(other, p) > diagonal_mm / 2 ? voxel_ml : 0;
            }
    });
    Excess all;
    for (const Excess& s : slices)
        all = {all.all_ml + s.all_ml, all.far_ml + s.far_ml, all.common_ml + s.common_ml};
    return all;
}

/// The truth's surface, in LPS mm.
vtkNew<vtkPolyData> trueSurface(const InsideVolume& truth)
{
    const Grid& grid = truth.grid;
    const auto [nx, ny, nz] = grid.size;
    vtkNew<vtkUnsignedCharArray> values;
    values->SetNumberOfValues(vtkIdType(truth.voxels.size()));
    unsigned char* out = values->GetPointer(0);
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                int sum = 0;
                for (int dk = -1; dk <= 1; ++dk)
                    for (int dj = -1; dj <= 1; ++dj)
                        for (int di = -1; di <= 1; ++di)
                            if (truth.valueOr({i + di, j + dj, k + dk}, kOutside) != kOutside)
                                sum += (2 - std::abs(di)) * (2 - std::abs(dj)) * (2 - std::abs(dk));
                out[grid.offset({i, j, k})] = static_cast<unsigned char>(sum);
            }
    });
    vtkNew<vtkImageData> image;
    image->SetDimensions(grid.size.data());
    image->GetPointData()->SetScalars(values);
    vtkNew<vtkFlyingEdges3D> edges;
    edges->SetInputData(image);
    edges->SetValue(0, 32);
    edges->ComputeNormalsOff();
    edges->ComputeScalarsOff();
    edges->Update();
    vtkNew<vtkPolyData> surface;
    surface->ShallowCopy(edges->GetOutput());
    vtkPoints* points = surface->GetPoints();
    for (vtkIdType n = 0; n < points->GetNumberOfPoints(); ++n) {
        double c[3];
        points->GetPoint(n, c);
        const Point3 p = grid.pointAt(ContinuousIndex3{c[0], c[1], c[2]});
        points->SetPoint(n, p.x, p.y, p.z);
    }
    return surface;
}

vtkNew<vtkPolyData> foundSurface(const HuVolume& volume, const InsideVolume& found)
{
    NoProgress quiet;
    SegmentVolume segments(found.grid);
    for (std::size_t n = 0; n < found.voxels.size(); ++n)
        segments.voxels[n] = found.voxels[n] ? 1 : 0;
    return support::asPolyData(steps::extractCells(volume, found, segments, {}, quiet));
}

void addDistances(vtkPolyData* from, vtkPolyData* to, std::vector<double>& distances_mm)
{
    vtkNew<vtkStaticCellLocator> locator;
    locator->SetDataSet(to);
    locator->BuildLocator();
    vtkNew<vtkGenericCell> cell;
    for (vtkIdType n = 0; n < from->GetNumberOfPoints(); n += vtkIdType(kEvery)) {
        double p[3], closest[3], squared = 0;
        vtkIdType id = 0;
        int part = 0;
        from->GetPoint(n, p);
        locator->FindClosestPoint(p, closest, cell, id, part, squared);
        distances_mm.push_back(std::sqrt(squared));
    }
}

double percentile95(std::vector<double> values)
{
    if (values.empty())
        return 1e9;
    const auto at = values.begin() + std::ptrdiff_t(values.size() * 95 / 100);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

LumenErrors lumenErrors(const HuVolume& volume, const InsideVolume& found, const InsideVolume& truth)
{
    LumenErrors errors;
    const Excess outside = beyond(found, truth), missed = beyond(truth, found);
    errors.outside_ml = outside.all_ml;
    errors.far_outside_ml = outside.far_ml;
    errors.missed_ml = missed.all_ml;
    errors.far_missed_ml = missed.far_ml;
    errors.dice = 2 * outside.common_ml / (outside.common_ml + outside.all_ml + missed.common_ml + missed.all_ml);
    std::vector<double> to_truth, to_found;
    const auto shown = foundSurface(volume, found), real = trueSurface(truth);
    addDistances(shown, real, to_truth);
    addDistances(real, shown, to_found);
    errors.found_surface_95_mm = percentile95(to_truth);
    errors.true_surface_95_mm = percentile95(to_found);
    to_truth.insert(to_truth.end(), to_found.begin(), to_found.end());
    errors.surface_95_mm = percentile95(std::move(to_truth));
    return errors;
}

}  // namespace vicon::test
