#pragma once

#include <itkImage.h>
#include <itkImportImageFilter.h>

#include <array>
#include <cstdint>

namespace vicon::steps {

using ItkHu = itk::Image<std::int16_t, 3>;
using ItkMask = itk::Image<std::uint8_t, 3>;
using ItkFloat = itk::Image<float, 3>;

/// ITK's view of voxels that stay their owner's: origin 0, spacing 1, axes as stored. Nothing is copied.
template <class Pixel>
typename itk::Image<Pixel, 3>::Pointer itkView(Pixel* first, const std::array<int, 3>& size)
{
    using Import = itk::ImportImageFilter<Pixel, 3>;
    typename Import::RegionType region;
    for (unsigned d = 0; d < 3; ++d)
        region.SetSize(d, itk::SizeValueType(size[d]));
    auto import = Import::New();
    import->SetRegion(region);
    import->SetImportPointer(first, region.GetNumberOfPixels(), false);
    import->Update();
    typename itk::Image<Pixel, 3>::Pointer image = import->GetOutput();
    image->DisconnectPipeline();
    return image;
}

}  // namespace vicon::steps
