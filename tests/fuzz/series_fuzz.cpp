// Data set to the description of a scan. The input changes elements of a small series: each change is a byte for the
// slice, one for the element, one for the length of its value and the way it is written (by the dictionary, or as bytes
// of an unknown kind), and the value. An odd first byte makes one object of frames of the series, each change one of a
// frame's functional groups where one holds the element. Whatever they say, the series is planned within the limits or
// refused with a reason, and its description is JSON.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <list>
#include <map>
#include <optional>

#include "inspect.h"
#include "memory_file.h"
#include "scan_description.h"
#include "scan_reader.h"
#include "series_template.h"
#include "stack.h"
#include "stack_plan.h"
#include "vicon/core/error.h"

using namespace vicon;
using namespace vicon::ingest;

namespace {

constexpr int kSlices = 6;

const std::array kElements{DCM_ImagePositionPatient,
                           DCM_ImageOrientationPatient,
                           DCM_PixelSpacing,
                           DCM_SliceThickness,
                           DCM_RescaleSlope,
                           DCM_RescaleIntercept,
                           DCM_RescaleType,
                           DCM_ImageType,
                           DCM_AcquisitionNumber,
                           DCM_AcquisitionTime,
                           DCM_ConvolutionKernel,
                           DCM_PatientPosition,
                           DCM_SeriesInstanceUID,
                           DCM_SOPInstanceUID,
                           DCM_StudyInstanceUID,
                           DCM_Modality,
                           DCM_SOPClassUID,
                           DCM_PixelPaddingValue,
                           DCM_PixelPaddingRangeLimit,
                           DCM_BitsStored,
                           DCM_HighBit,
                           DCM_PixelRepresentation,
                           DCM_Rows,
                           DCM_Columns,
                           DCM_SamplesPerPixel,
                           DCM_PhotometricInterpretation,
                           DCM_NumberOfFrames,
                           DCM_SpecificCharacterSet,
                           DCM_PatientName,
                           DCM_PatientID,
                           DCM_SeriesDescription,
                           DCM_SeriesNumber,
                           DCM_KVP,
                           DCM_LossyImageCompression,
                           DCM_FrameOfReferenceUID,
                           DCM_AcquisitionDateTime};

struct Change {
    DcmTagKey tag;
    std::string value;
    bool unknown = false;  ///< written as UN
};

/// As the element is written: numbers from decimal text where its kind is binary.
void change(DcmItem& dataset, const Change& asked)
{
    const auto& [tag, value, unknown] = asked;
    dataset.findAndDeleteElement(tag);
    if (unknown) {
        auto* const element = new DcmOtherByteOtherWord(DcmTag(tag, EVR_UN));
        element->putUint8Array(reinterpret_cast<const Uint8*>(value.data()), value.size());
        dataset.insert(element, true);
        return;
    }
    const auto number = std::strtol(value.c_str(), nullptr, 10);
    switch (DcmTag(tag).getEVR()) {
        case EVR_US:
        case EVR_xs:
            dataset.putAndInsertUint16(DcmTag(tag, EVR_US), Uint16(number));
            break;
        default:
            dataset.putAndInsertOFStringArray(tag, OFString(value.data(), value.size()));
    }
}

/// The functional group that holds an element; nothing where it belongs to the data set.
std::optional<DcmTagKey> groupOf(const DcmTagKey& tag)
{
    static const std::map<DcmTagKey, DcmTagKey> kGroups{{DCM_ImagePositionPatient, DCM_PlanePositionSequence},
                                                        {DCM_ImageOrientationPatient, DCM_PlaneOrientationSequence},
                                                        {DCM_PixelSpacing, DCM_PixelMeasuresSequence},
                                                        {DCM_SliceThickness, DCM_PixelMeasuresSequence},
                                                        {DCM_RescaleSlope, DCM_PixelValueTransformationSequence},
                                                        {DCM_RescaleIntercept, DCM_PixelValueTransformationSequence},
                                                        {DCM_RescaleType, DCM_PixelValueTransformationSequence},
                                                        {DCM_ConvolutionKernel, DCM_CTReconstructionSequence}};
    const auto found = kGroups.find(tag);
    return found == kGroups.end() ? std::nullopt : std::optional(found->second);
}

/// The slices as the frames of one object: what a group may hold is moved into each frame's own.
DcmDataset asFrames(std::vector<DcmDataset>& slices)
{
    DcmDataset whole(slices.front());
    whole.putAndInsertString(DCM_SOPClassUID, UID_EnhancedCTImageStorage);
    whole.putAndInsertString(DCM_NumberOfFrames, std::to_string(slices.size()).c_str());
    std::vector<Uint16> pixels;
    for (DcmDataset& slice : slices) {
        DcmItem* frame = nullptr;
        whole.findOrCreateSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, -2);
        for (const DcmTagKey& tag : kElements) {
            DcmElement* element = nullptr;
            const auto group = groupOf(tag);
            if (!group || slice.findAndGetElement(tag, element).bad())
                continue;
            DcmItem* item = nullptr;
            frame->findOrCreateSequenceItem(*group, item, 0);
            item->insert(static_cast<DcmElement*>(element->clone()), true);
            whole.findAndDeleteElement(tag);
        }
        const Uint16* values = nullptr;
        unsigned long count = 0;
        if (slice.findAndGetUint16Array(DCM_PixelData, values, &count).good() && values)
            pixels.insert(pixels.end(), values, values + count);
    }
    whole.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    return whole;
}

/// The bytes of a file.
std::string written(DcmDataset& dataset)
{
    DcmFileFormat format(&dataset);
    std::string bytes(1 << 16, '\0');
    DcmOutputBufferStream stream(bytes.data(), offile_off_t(bytes.size()));
    format.transferInit();
    const OFCondition done = format.write(stream, EXS_LittleEndianExplicit, EET_UndefinedLength, nullptr);
    format.transferEnd();
    void* begin = nullptr;
    offile_off_t count = 0;
    stream.flushBuffer(begin, count);
    return done.good() ? std::string(static_cast<const char*>(begin), std::size_t(count)) : std::string();
}

void checkPlan(const Stack& stack, const StackPlan& plan, const ImportOptions& options)
{
    fuzz::require(plan.shift_pixels.size() == stack.slices.size() || !plan.refused.empty());
    (void)describeGeometry(stack, plan).dump();
    if (!plan.refused.empty())
        return;
    fuzz::require(plan.planes.size() == std::size_t(plan.grid.size[2]));
    for (std::size_t a = 0; a < 3; ++a)
        fuzz::require(plan.grid.size[a] > 0 && plan.grid.spacing_mm[a] > 0 && std::isfinite(plan.grid.spacing_mm[a]));
    fuzz::require(double(plan.grid.voxelCount()) <= options.largest_volume_mvoxel * 1e6);
    for (const PlaneSource& plane : plan.planes)
        fuzz::require(plane.below < stack.slices.size() && plane.above < stack.slices.size() && plane.part_above >= 0 &&
                      plane.part_above <= 1);
}

void describe(const std::vector<const ImageObject*>& objects)
{
    ImportOptions options;
    options.largest_volume_mvoxel = 1;
    NoProgress quiet;
    for (const Stack& stack : splitSeries(objects, comparePixels(quiet))) {
        const StackPlan plan = planStack(stack, options);
        checkPlan(stack, plan, options);
        ScanRecord record;
        record.series = seriesOf(stack);
        record.ingest["geometry"] = describeGeometry(stack, plan);
        (void)nlohmann::json(record.series).dump();
        (void)describeRepairs(objects, plan).dump();
        if (!plan.refused.empty())
            continue;
        (void)nlohmann::json(describeInWords(record, plan)).dump();
        const HuVolume volume = readVolume(stack, plan, quiet);
        fuzz::require(volume.voxels.size() == volume.grid.voxelCount());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::array<fuzz::MemoryFile, kSlices> files;
    const bool in_frames = size > 0 && data[0] % 2 != 0;
    std::vector<DcmDataset> slices;
    for (int n = 0; n < kSlices; ++n)
        slices.push_back(fuzz::templateSlice(n));
    for (std::size_t at = 0; at + 3 <= size;) {
        constexpr std::size_t kLongest = 64;
        const std::size_t length = std::min<std::size_t>(data[at + 2] % kLongest, size - at - 3);
        const Change asked{kElements[data[at + 1] % kElements.size()],
                           {reinterpret_cast<const char*>(data) + at + 3, length},
                           data[at + 2] >= 3 * kLongest};
        // Behind the last slice: all of them alike, then every other one, so that kinds alternate.
        const int which = data[at] / 2 % (kSlices + 2);
        for (int n = 0; n < kSlices; ++n)
            if (n == which || which == kSlices || (which > kSlices && n % 2 == 0))
                change(slices[std::size_t(n)], asked);
        at += 3 + length;
    }
    if (in_frames)
        slices = {asFrames(slices)};
    std::list<ImageObject> objects;
    std::map<std::string, std::vector<const ImageObject*>> series;
    for (std::size_t n = 0; n < slices.size(); ++n) {
        const std::string bytes = written(slices[n]);
        files[n].fill(bytes.data(), bytes.size());
        Inspection found = inspectFile(files[n].path(), {});
        (void)nlohmann::json(found.reason).dump();
        if (found.verdict != Inspection::Verdict::image)
            continue;
        objects.push_back(std::move(found.object));
        series[objects.back().series.uid].push_back(&objects.back());
    }
    for (const auto& [uid, members] : series)
        describe(members);
    return 0;
}
