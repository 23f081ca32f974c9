#include "plane_reader.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "frame_groups.h"

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

/// Fills position and directions; returns what is wrong with them.
std::string readGeometry(const FrameSaid& frame, Slice& slice, bool& absent)
{
    const auto& position = frame.origin_mm;
    const auto &row = frame.row, &column = frame.column;
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
    const auto &row_mm = frame.row_mm, &pixel_mm = frame.pixel_mm;
    if (!row_mm || !pixel_mm || *row_mm <= 0 || *pixel_mm <= 0)
        return "the size of its pixels is not said (Pixel Spacing)";
    if (std::min(*row_mm, *pixel_mm) < kSmallestPixel_mm || std::max(*row_mm, *pixel_mm) > kLargestPixel_mm)
        return "its pixels have a size that no scanner has (Pixel Spacing)";
    slice.row_mm = *row_mm;
    slice.pixel_mm = *pixel_mm;
    slice.thickness_mm = frame.thickness_mm;
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
std::string readDensities(const FrameSaid& said, Slice& slice, std::set<std::string>& repairs)
{
    const auto &slope = said.slope, &intercept = said.intercept;
    const std::string& type = said.rescale_type;
    if (!slope || !intercept)
        return "its densities are unknown (no Rescale Slope and Intercept)";
    if (*slope == 0)
        return "its densities are unknown (Rescale Slope is 0)";
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
std::string readSignal(const FrameSaid& said, Slice& slice)
{
    slice.slope = said.slope.value_or(1);
    slice.intercept = said.intercept.value_or(0);
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
    const FrameGroups groups(dataset, signal);
    const std::vector<Dataset> all = dataset.items(DCM_PerFrameFunctionalGroupsSequence);
    for (int n = 0; n < frames; ++n) {
        FrameSaid frame = groups.of(multi_frame ? std::optional(all.at(std::size_t(n))) : std::nullopt);
        Slice slice;
        slice.frame = n;
        planes.why = readGeometry(frame, slice, planes.without_geometry);
        if (planes.why.empty())
            planes.why = signal ? readSignal(frame, slice) : readDensities(frame, slice, planes.repairs);
        if (planes.why.empty() && frame.decimal_commas)
            planes.repairs.insert("decimal commas read as points");
        if (!planes.why.empty()) {
            planes.slices.clear();
            return planes;
        }
        slice.image_type = std::move(frame.image_type);
        slice.kernel = std::move(frame.kernel);
        slice.acquisition = std::move(frame.acquisition);
        slice.phase = std::move(frame.phase);
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
