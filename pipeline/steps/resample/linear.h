#pragma once

#include <itkImageToImageFilter.h>

#include "grid/itk_view.h"
#include "resample/oriented_scan.h"
#include "resample/sampling.h"

namespace vicon::steps {

/// Linear resampling of a scan onto parallel axes, as a filter of ITK's pipeline that can be asked for any region.
/// Input: the scan as stored. Output: the new volume along the oriented axes, origin 0 and spacing 1, padding kept out.
/// itk::ResampleImageFilter works out each voxel's place and eight weights by itself; along parallel axes they are the
/// same for whole rows, which saves most of the time: see `resample` in vicon_bench.
class LinearResampleFilter final : public itk::ImageToImageFilter<ItkHu, ItkHu> {
public:
    using Self = LinearResampleFilter;
    using Pointer = itk::SmartPointer<Self>;
    itkNewMacro(Self);

    /// @param scan, sampling must outlive the filter
    void setScan(const OrientedScan& scan, const Sampling& sampling);

private:
    void GenerateOutputInformation() override;
    void GenerateInputRequestedRegion() override;
    void DynamicThreadedGenerateData(const OutputImageRegionType& region) override;

    const OrientedScan* scan_ = nullptr;
    const Sampling* sampling_ = nullptr;
};

}  // namespace vicon::steps
