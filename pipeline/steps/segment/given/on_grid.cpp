#include "segment/given/on_grid.h"

#include <itkLinearInterpolateImageFunction.h>
#include <itkResampleImageFilter.h>

#include <algorithm>
#include <cmath>

#include "grid/itk_view.h"
#include "grid/voxel_box.h"

namespace vicon::steps {
namespace {

// ITK rounds to whole numbers, and half must stay half.
constexpr std::uint8_t kIn = 200, kHalf = 100;

/// The voxels of a grid that a mask's box reaches, with one around.
VoxelBox reached(const Grid& mask, const Grid& grid)
{
    VoxelBox box;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto end = [&](unsigned axis) { return corner >> axis & 1U ? mask.size[axis] - 0.5 : -0.5; };
        box.take(grid.indexAt(mask.pointAt(ContinuousIndex3{end(0), end(1), end(2)})));
    }
    return box.grown(1, grid);
}

template <class Image>
void placeAs(Image& image, const Grid& grid)
{
    typename Image::PointType origin;
    typename Image::SpacingType spacing;
    typename Image::DirectionType direction;
    const std::array<double, 3> first{grid.origin_mm.x, grid.origin_mm.y, grid.origin_mm.z};
    for (unsigned a = 0; a < 3; ++a) {
        origin[a] = first[a];
        spacing[a] = grid.spacing_mm[a];
        direction[0][a] = grid.axis[a].x;
        direction[1][a] = grid.axis[a].y;
        direction[2][a] = grid.axis[a].z;
    }
    image.SetOrigin(origin);
    image.SetSpacing(spacing);
    image.SetDirection(direction);
}

}  // namespace

InsideVolume onGrid(const InsideVolume& mask, const Grid& grid)
{
    const VoxelBox box = reached(mask.grid, grid);
    if (box.empty())
        return {};
    InsideVolume weighed = mask;
    std::transform(mask.voxels.begin(), mask.voxels.end(), weighed.voxels.begin(),
                   [](std::uint8_t v) { return v ? kIn : std::uint8_t(0); });
    const ItkMask::Pointer input = itkView(weighed.voxels.data(), weighed.grid.size);
    placeAs(*input, mask.grid);
    auto out = makeVolume<std::uint8_t>(cropped(grid, box));
    const ItkMask::Pointer reference = itkView(out.voxels.data(), out.grid.size);
    placeAs(*reference, out.grid);
    using Resample = itk::ResampleImageFilter<ItkMask, ItkMask>;
    auto resample = Resample::New();
    resample->SetInput(input);
    resample->SetReferenceImage(reference);
    resample->UseReferenceImageOn();
    resample->SetInterpolator(itk::LinearInterpolateImageFunction<ItkMask>::New());
    resample->SetDefaultPixelValue(0);
    resample->Update();
    const std::uint8_t* made = resample->GetOutput()->GetBufferPointer();
    std::transform(made, made + out.voxels.size(), out.voxels.begin(),
                   [](std::uint8_t share) { return std::uint8_t(share >= kHalf ? 1 : 0); });
    return out;
}

}  // namespace vicon::steps
