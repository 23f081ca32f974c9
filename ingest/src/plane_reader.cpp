#include "plane_reader.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace vicon::ingest {
namespace {

/// Direction cosines are written with five or more decimals; beyond this a header is wrong, not rounded.
constexpr double kDirectionTolerance = 0.01;
/// No table is longer, and no patient lies farther from the origin.
constexpr double kFarthest_mm = 10000;
/// From the finest inner ear to the coarsest attenuation map.
constexpr double kSmallestPixel_mm = 0.01, kLargestPixel_mm = 20;
/// Beyond these a stored value of 1 would be denser than any metal.
constexpr double kLargestSlope = 1000, kLargestIntercept_hu = 100000;

/// The longest of perfusion and of the heart have a third.
constexpr int kMostFrames = 20000;

/// Where a frame's attributes stand: in the functional groups of a multi-frame object, or in the data set itself.
class Groups {
public:
    /// @param own the frame's functional groups; nothing for a plain image
    Groups(const Dataset& dataset, std::optional<Dataset> shared, std::optional<Dataset> own)
        : dataset_(dataset), shared_(std::move(shared)), own_(std::move(own))
    {
    }

    /// The item of a functional group: the frame's own, else the shared one, else (plain image) the data set.
    Dataset group(const DcmTagKey& sequence) const
    {
        for (const auto& holder : {own_, shared_})
            if (holder)
                if (auto item = holder->item(sequence))
                    return *item;
        return dataset_;
    }

private:
    Dataset dataset_;
    std::optional<Dataset> shared_, own_;
};

std::optional<Vector3> vectorAt(const Dataset& dataset, const DcmTagKey& tag, unsigned long from)
{
    const auto x = dataset.number(tag, from), y = dataset.number(tag, from + 1), z = dataset.number(tag, from + 2);
    if (!x || !y || !z)
        return {};
    return Vector3{*x, *y, *z};
}

std::string joined(const std::vector<std::string>& values, std::size_t most)
{
    std::string out;
    for (std::size_t n = 0; n < values.size() && n < most; ++n)
        out += (n ? "\\" : "") + values[n];
    return out;
}

/// Fills position and directions; returns what is wrong with them.
std::string readGeometry(const Groups& groups, Slice& slice, bool& absent)
{
    const auto position = vectorAt(groups.group(DCM_PlanePositionSequence), DCM_ImagePositionPatient, 0);
    const Dataset orientation = groups.group(DCM_PlaneOrientationSequence);
    const auto row = vectorAt(orientation, DCM_ImageOrientationPatient, 0);
    const auto column = vectorAt(orientation, DCM_ImageOrientationPatient, 3);
    absent = !position && !row;
    if (!position || !row || !column)
        return "it does not say where in the patient it lies (Image Position and Orientation Patient)";
    if (std::abs(length(*row) - 1) > kDirectionTolerance || std::abs(length(*column) - 1) > kDirectionTolerance ||
        std::abs(dot(*row, *column)) > kDirectionTolerance)
        return "its rows and columns are not orthogonal (Image Orientation Patient)";
    if (std::max({std::abs(position->x), std::abs(position->y), std::abs(position->z)}) > kFarthest_mm)
        return "it lies more than 10 m from the origin, where no scanner reaches (Image Position Patient)";
    slice.position_mm = Point3{} + *position;
    slice.row = normalized(*row);
    slice.column = normalized(*column - slice.row * dot(slice.row, *column));
    const Dataset measures = groups.group(DCM_PixelMeasuresSequence);
    const auto row_mm = measures.number(DCM_PixelSpacing, 0), pixel_mm = measures.number(DCM_PixelSpacing, 1);
    if (!row_mm || !pixel_mm || *row_mm <= 0 || *pixel_mm <= 0)
        return "the size of its pixels is not said (Pixel Spacing)";
    if (std::min(*row_mm, *pixel_mm) < kSmallestPixel_mm || std::max(*row_mm, *pixel_mm) > kLargestPixel_mm)
        return "its pixels have a size that no scanner has (Pixel Spacing)";
    slice.row_mm = *row_mm;
    slice.pixel_mm = *pixel_mm;
    slice.thickness_mm = measures.number(DCM_SliceThickness).value_or(0);
    return {};
}

std::string upper(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return text;
}

/// The names under which writers mean Hounsfield units; US is "unspecified".
bool meansHounsfield(const std::string& type)
{
    const std::string name = upper(type);
    return name.empty() || name == "HU" || name == "US" || name.starts_with("HOUNSFIELD") ||
           name.starts_with("HOUNDSFIELD");
}

/// Whether one of the values, which backslashes part, is among these.
bool hasValueOf(const std::string& values, const std::set<std::string>& wanted)
{
    std::size_t from = 0;
    while (from <= values.size()) {
        const std::size_t to = std::min(values.find('\\', from), values.size());
        if (wanted.contains(upper(values.substr(from, to - from))))
            return true;
        from = to + 1;
    }
    return false;
}

/// Maps of blood flow, volume and the like, and of materials: numbers of their own, with a slope and an intercept too.
bool isParametricMap(const std::string& image_type)
{
    static const std::set<std::string> kMaps{"CBF",           "CBV",          "MTT",          "TTP",
                                             "TMAX",          "PBF",          "PBV",          "PERFUSION",
                                             "PERFUSION_MAP", "RHO_Z",        "ZEFF",         "EFF_ATOMIC_NUM",
                                             "BLOOD_FLOW",    "BLOOD_VOLUME", "FLOW_EXTRACT", "PERMEABILITY"};
    return hasValueOf(image_type, kMaps);
}

/// Fills slope and intercept; returns what is wrong with them.
std::string readDensities(const Groups& groups, Slice& slice, std::set<std::string>& repairs)
{
    const Dataset transformation = groups.group(DCM_PixelValueTransformationSequence);
    const auto slope = transformation.number(DCM_RescaleSlope);
    const auto intercept = transformation.number(DCM_RescaleIntercept);
    if (!slope || !intercept)
        return "its densities are unknown (no Rescale Slope and Intercept)";
    if (*slope == 0)
        return "its densities are unknown (Rescale Slope is 0)";
    const std::string type = joined(transformation.values(DCM_RescaleType), 1);
    if (std::abs(*slope) > kLargestSlope || std::abs(*intercept) > kLargestIntercept_hu)
        return "its densities are none that a body has (Rescale Slope and Intercept)";
    if (upper(type) == "US")
        repairs.insert("Rescale Type unspecified (US): taken as HU");
    if (!meansHounsfield(type))
        return "its values are no CT densities (Rescale Type " + type + ")";
    slice.slope = *slope;
    slice.intercept = *intercept;
    return {};
}

/// A signal has no unit: slopes and intercepts only make slices of one series comparable, and where they are not said
/// the values are as the scanner wrote them. Fills both; returns what is wrong with them.
std::string readSignal(const Groups& groups, Slice& slice)
{
    const Dataset transformation = groups.group(DCM_PixelValueTransformationSequence);
    slice.slope = transformation.number(DCM_RescaleSlope).value_or(1);
    slice.intercept = transformation.number(DCM_RescaleIntercept).value_or(0);
    if (slice.slope <= 0 || slice.slope > kLargestSlope || std::abs(slice.intercept) > kLargestIntercept_hu)
        return "its signal cannot be told (Rescale Slope and Intercept)";
    return {};
}

/// Of MR: numbers of their own, and phases.
bool isMrMap(const std::string& image_type)
{
    static const std::set<std::string> kMaps{
        "ADC",    "EADC",   "TRACEW",      "FA",          "PHASE",        "PHASE MAP",
        "P",      "R",      "I",           "VELOCITY",    "VELOCITY MAP", "T1 MAP",
        "T2 MAP", "R2 MAP", "T2_STAR MAP", "R2_STAR MAP", "FAT_FRACTION", "B0 MAP"};
    return hasValueOf(image_type, kMaps);
}

bool usesDecimalCommas(const Groups& groups)
{
    const Dataset measures = groups.group(DCM_PixelMeasuresSequence);
    const Dataset transformation = groups.group(DCM_PixelValueTransformationSequence);
    return groups.group(DCM_PlanePositionSequence).hasDecimalComma(DCM_ImagePositionPatient) ||
           groups.group(DCM_PlaneOrientationSequence).hasDecimalComma(DCM_ImageOrientationPatient) ||
           measures.hasDecimalComma(DCM_PixelSpacing) || measures.hasDecimalComma(DCM_SliceThickness) ||
           transformation.hasDecimalComma(DCM_RescaleSlope) || transformation.hasDecimalComma(DCM_RescaleIntercept);
}

void readKind(const Dataset& dataset, const Groups& groups, bool multi_frame, bool signal, Slice& slice)
{
    constexpr std::size_t kImageTypeValues = 4;
    const Dataset type = groups.group(signal ? DCM_MRImageFrameTypeSequence : DCM_CTImageFrameTypeSequence);
    slice.image_type = joined(type.values(type.has(DCM_FrameType) ? DCM_FrameType : DCM_ImageType), kImageTypeValues);
    slice.kernel = joined(groups.group(DCM_CTReconstructionSequence).values(DCM_ConvolutionKernel), 2);
    if (!multi_frame) {
        slice.acquisition = joined(dataset.values(DCM_AcquisitionNumber), 1);
        if (signal)  // two echoes, or a moment after another, of one place
            slice.phase = joined(dataset.values(DCM_EchoTime), 1) + "/" +
                          joined(dataset.values(DCM_TemporalPositionIdentifier), 1);
        return;
    }
    const Dataset content = groups.group(DCM_FrameContentSequence);
    if (const auto number = content.integer(DCM_FrameAcquisitionNumber))
        slice.acquisition = std::to_string(*number);
    slice.phase = content.text(DCM_StackID);
    if (const auto index = content.integer(DCM_TemporalPositionIndex))
        slice.phase.append("/").append(std::to_string(*index));
}

}  // namespace

Planes readPlanes(const Dataset& dataset, int frames, Quantity quantity)
{
    const bool signal = quantity == Quantity::signal;
    Planes planes;
    const bool multi_frame =
        dataset.has(DCM_SharedFunctionalGroupsSequence) || dataset.has(DCM_PerFrameFunctionalGroupsSequence);
    if (multi_frame && dataset.itemCount(DCM_PerFrameFunctionalGroupsSequence) != unsigned(frames)) {
        planes.why = "it has another number of frames than of frame descriptions";
        return planes;
    }
    if (frames > kMostFrames) {
        planes.why = "it has more than " + std::to_string(kMostFrames) + " frames";
        return planes;
    }
    if (!multi_frame && frames != 1) {
        planes.why = "it has several frames, but does not say where each lies";
        return planes;
    }
    const auto shared = dataset.item(DCM_SharedFunctionalGroupsSequence);
    const std::vector<Dataset> own = dataset.items(DCM_PerFrameFunctionalGroupsSequence);
    for (int frame = 0; frame < frames; ++frame) {
        const Groups groups(dataset, shared, multi_frame ? std::optional(own.at(std::size_t(frame))) : std::nullopt);
        Slice slice;
        slice.frame = frame;
        planes.why = readGeometry(groups, slice, planes.without_geometry);
        if (planes.why.empty())
            planes.why = signal ? readSignal(groups, slice) : readDensities(groups, slice, planes.repairs);
        if (planes.why.empty() && usesDecimalCommas(groups))
            planes.repairs.insert("decimal commas read as points");
        if (!planes.why.empty()) {
            planes.slices.clear();
            return planes;
        }
        readKind(dataset, groups, multi_frame, signal, slice);
        if (signal ? isMrMap(slice.image_type) : isParametricMap(slice.image_type)) {
            planes.why = std::string("its values are no ") + (signal ? "MR signal" : "CT densities") + " (Image Type " +
                         slice.image_type + ")";
            planes.slices.clear();
            return planes;
        }
        planes.slices.push_back(std::move(slice));
    }
    return planes;
}

}  // namespace vicon::ingest
