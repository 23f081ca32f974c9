#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <cmath>

#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

TEST(WallDistance, AgreesWithItksMaurerFilter)
{
    const Grid grid{.size = {40, 36, 32}, .spacing_mm = {0.8, 0.8, 0.8}};
    InsideVolume inside(grid);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Point3 p = grid.pointAt(grid.indexOf(n));
        inside.voxels[n] = std::hypot(std::hypot(p.x - 16, p.y - 14) - 8, p.z - 12.4) < 4.5 ? kGas : kOutside;
    }
    using Image = itk::Image<std::uint8_t, 3>;
    auto outside = Image::New();
    outside->SetRegions(Image::SizeType{40, 36, 32});
    outside->SetSpacing(grid.spacing_mm.data());
    outside->Allocate();
    for (std::size_t n = 0; n < grid.voxelCount(); ++n)
        outside->GetBufferPointer()[n] = inside.voxels[n] ? 0 : 1;
    auto maurer = itk::SignedMaurerDistanceMapImageFilter<Image, itk::Image<float, 3>>::New();
    maurer->SetInput(outside);
    maurer->SquaredDistanceOff();
    maurer->UseImageSpacingOn();
    maurer->Update();
    NoProgress quiet;
    const FieldVolume field = wallDistance(inside, quiet);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n)
        if (inside.voxels[n]) {
            ASSERT_NEAR(field.voxels[n], maurer->GetOutput()->GetBufferPointer()[n] - 0.4, 1e-4);
        }
}

}  // namespace
}  // namespace vicon::steps
