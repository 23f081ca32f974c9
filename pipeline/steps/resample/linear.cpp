#include "resample/linear.h"

#include <algorithm>

#include "resample/row_sampler.h"

namespace vicon::steps {

void LinearResampleFilter::setScan(const OrientedScan& scan, const Sampling& sampling)
{
    scan_ = &scan;
    sampling_ = &sampling;
    SetInput(itkView(scan.acquired.voxels.data(), scan.acquired.grid.size));
}

void LinearResampleFilter::GenerateOutputInformation()
{
    ItkHu::SizeType size;
    std::copy(sampling_->grid.size.begin(), sampling_->grid.size.end(), size.begin());
    GetOutput()->SetLargestPossibleRegion(size);
}

void LinearResampleFilter::GenerateInputRequestedRegion()
{
    // Everything: the scan is in memory.
    const_cast<ItkHu*>(GetInput())->SetRequestedRegionToLargestPossibleRegion();
}

void LinearResampleFilter::DynamicThreadedGenerateData(const OutputImageRegionType& region)
{
    RowSampler sampler(*scan_, *sampling_);
    ItkHu& out = *GetOutput();
    const auto begin = region.GetIndex(), end = region.GetUpperIndex();
    for (auto k = begin[2]; k <= end[2]; ++k)
        for (auto j = begin[1]; j <= end[1]; ++j)
            sampler.sample(int(j), int(k), &out.GetPixel({0, j, k}));
}

}  // namespace vicon::steps
