#include "stock_chain.h"

#include <itkBinaryThresholdImageFilter.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkFastMarchingImageFilter.h>
#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImageRegionConstIteratorWithIndex.h>
#include <itkImageSeriesReader.h>
#include <itkRelabelComponentImageFilter.h>
#include <itkResampleImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#include <vtkImageData.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace vicon::bench {
namespace {

using Hu = itk::Image<std::int16_t, 3>;
using Mask = itk::Image<std::uint8_t, 3>;
using Labels = itk::Image<std::uint32_t, 3>;
using Field = itk::Image<float, 3>;

template <class Work>
auto timed(const char* step, Work work)
{
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    std::printf("%s %.3f\n", step, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return result;
}

/// A filter's output, alone: the filter and its inputs go.
template <class Filter>
auto detached(Filter& filter)
{
    filter->Update();
    auto image = filter->GetOutput();
    typename Filter::ObjectType::OutputImageType::Pointer kept = image;
    kept->DisconnectPipeline();
    return kept;
}

Hu::Pointer readSeries(const std::filesystem::path& series)
{
    auto names = itk::GDCMSeriesFileNames::New();
    names->SetDirectory(series.string());
    auto reader = itk::ImageSeriesReader<Hu>::New();
    reader->SetImageIO(itk::GDCMImageIO::New());
    reader->SetFileNames(names->GetInputFileNames());
    return detached(reader);
}

Hu::Pointer resampled(const Hu::Pointer& image)
{
    const auto spacing = image->GetSpacing();
    const auto size = image->GetLargestPossibleRegion().GetSize();
    const double finest = std::min({spacing[0], spacing[1], spacing[2]});
    itk::Size<3> new_size;
    for (unsigned a = 0; a < 3; ++a)
        new_size[a] = itk::SizeValueType(std::floor(double(size[a] - 1) * spacing[a] / finest + 1e-6)) + 1;
    auto filter = itk::ResampleImageFilter<Hu, Hu>::New();
    filter->SetInput(image);
    filter->SetSize(new_size);
    const double isotropic[3] = {finest, finest, finest};
    filter->SetOutputSpacing(isotropic);
    filter->SetOutputOrigin(image->GetOrigin());
    filter->SetOutputDirection(image->GetDirection());
    return detached(filter);
}

template <class In>
Mask::Pointer between(const typename In::Pointer& image, double low, double high)
{
    auto filter = itk::BinaryThresholdImageFilter<In, Mask>::New();
    filter->SetInput(image);
    filter->SetLowerThreshold(typename In::PixelType(low));
    filter->SetUpperThreshold(typename In::PixelType(high));
    filter->SetInsideValue(1);
    filter->SetOutsideValue(0);
    return detached(filter);
}

Labels::Pointer components(const Mask::Pointer& mask)
{
    auto filter = itk::ConnectedComponentImageFilter<Mask, Labels>::New();
    filter->SetInput(mask);
    return detached(filter);
}

Labels::Pointer relabelled(const Labels::Pointer& labels)
{
    auto filter = itk::RelabelComponentImageFilter<Labels, Labels>::New();
    filter->SetInput(labels);
    return detached(filter);
}

Field::Pointer maurer(const Mask::Pointer& mask)
{
    auto filter = itk::SignedMaurerDistanceMapImageFilter<Mask, Field>::New();
    filter->SetInput(mask);
    filter->SquaredDistanceOff();
    filter->UseImageSpacingOn();
    return detached(filter);
}

Field::Pointer marched(const Mask::Pointer& mask)
{
    using March = itk::FastMarchingImageFilter<Field, Mask>;
    auto march = March::New();
    auto seeds = March::NodeContainer::New();
    March::NodeType seed;
    for (itk::ImageRegionConstIteratorWithIndex<Mask> at(mask, mask->GetLargestPossibleRegion()); !at.IsAtEnd(); ++at)
        if (at.Get()) {
            seed.SetIndex(at.GetIndex());
            break;
        }
    seed.SetValue(0);
    seeds->InsertElement(0, seed);
    march->SetInput(mask);
    march->SetTrialPoints(seeds);
    return detached(march);
}

long long contoured(const Mask::Pointer& mask)
{
    const auto size = mask->GetLargestPossibleRegion().GetSize();
    vtkNew<vtkUnsignedCharArray> values;
    values->SetArray(mask->GetBufferPointer(), vtkIdType(size[0] * size[1] * size[2]), 1);
    vtkNew<vtkImageData> image;
    image->SetDimensions(int(size[0]), int(size[1]), int(size[2]));
    image->SetSpacing(mask->GetSpacing().GetDataPointer());
    image->GetPointData()->SetScalars(values);
    vtkNew<vtkMarchingCubes> cubes;
    cubes->SetInputData(image);
    cubes->SetValue(0, 0.5);
    cubes->ComputeNormalsOn();
    cubes->Update();
    return cubes->GetOutput()->GetNumberOfPolys();
}

}  // namespace

void runStockChain(const std::filesystem::path& series)
{
    Hu::Pointer hu = timed("GDCMSeriesReader", [&] { return readSeries(series); });
    hu = timed("ResampleImageFilter", [&] { return resampled(hu); });
    Mask::Pointer mask = timed("BinaryThreshold", [&] { return between<Hu>(hu, -1024, -800); });
    hu = nullptr;
    Labels::Pointer labels = timed("ConnectedComponent", [&] { return components(mask); });
    mask = nullptr;
    labels = timed("RelabelComponent", [&] { return relabelled(labels); });
    // The largest component is the air around the body; the next one stands for the colon.
    mask = between<Labels>(labels, 2, 2);
    labels = nullptr;
    timed("SignedMaurerDistanceMap", [&] { return maurer(mask)->GetBufferPointer()[0]; });
    timed("FastMarching", [&] { return marched(mask)->GetBufferPointer()[0]; });
    timed("vtkMarchingCubes", [&] { return contoured(mask); });
}

}  // namespace vicon::bench
