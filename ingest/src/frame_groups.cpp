#include "frame_groups.h"

namespace vicon::ingest {
/// What each functional group says, as it stands.
namespace frame_group {

struct Position {
    std::optional<Vector3> origin_mm;
    bool commas = false;
};

struct Orientation {
    std::optional<Vector3> row, column;
    bool commas = false;
};

struct Measures {
    std::optional<double> row_mm, pixel_mm;
    double thickness_mm = 0;
    bool commas = false;
};

struct Transformation {
    std::optional<double> slope, intercept;
    std::string type;
    bool commas = false;
};

/// When a frame was acquired.
struct Content {
    std::string acquisition, phase;
};

/// A group of all frames. What they share, or the data set says, is read once: it may stand behind thousands of other
/// elements.
template <class Said>
class Group {
public:
    using Read = Said (*)(const Dataset& group);
    Group(const Dataset& dataset, const std::optional<Dataset>& shared, const DcmTagKey& sequence, Read read)
        : sequence_(sequence), read_(read)
    {
        const auto item = shared ? shared->item(sequence) : std::nullopt;
        common_ = read_(item ? *item : dataset);
    }
    /// @param own the frame's functional groups; nothing for a plain image
    Said of(const std::optional<Dataset>& own) const
    {
        const auto item = own ? own->item(sequence_) : std::nullopt;
        return item ? read_(*item) : common_;
    }

private:
    DcmTagKey sequence_;
    Read read_;
    Said common_;
};

}  // namespace frame_group

namespace {

using frame_group::Content, frame_group::Measures, frame_group::Orientation, frame_group::Position,
    frame_group::Transformation;

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

Position positionIn(const Dataset& group)
{
    return {vectorAt(group, DCM_ImagePositionPatient, 0), group.hasDecimalComma(DCM_ImagePositionPatient)};
}

Orientation orientationIn(const Dataset& group)
{
    return {vectorAt(group, DCM_ImageOrientationPatient, 0), vectorAt(group, DCM_ImageOrientationPatient, 3),
            group.hasDecimalComma(DCM_ImageOrientationPatient)};
}

Measures measuresIn(const Dataset& group)
{
    return {group.number(DCM_PixelSpacing, 0), group.number(DCM_PixelSpacing, 1),
            group.number(DCM_SliceThickness).value_or(0),
            group.hasDecimalComma(DCM_PixelSpacing) || group.hasDecimalComma(DCM_SliceThickness)};
}

Transformation transformationIn(const Dataset& group)
{
    return {group.number(DCM_RescaleSlope), group.number(DCM_RescaleIntercept),
            joined(group.values(DCM_RescaleType), 1),
            group.hasDecimalComma(DCM_RescaleSlope) || group.hasDecimalComma(DCM_RescaleIntercept)};
}

std::string imageTypeIn(const Dataset& group)
{
    constexpr std::size_t kImageTypeValues = 4;
    return joined(group.values(group.has(DCM_FrameType) ? DCM_FrameType : DCM_ImageType), kImageTypeValues);
}

std::string kernelIn(const Dataset& group)
{
    return joined(group.values(DCM_ConvolutionKernel), 2);
}

Content contentIn(const Dataset& group)
{
    Content content;
    if (const auto number = group.integer(DCM_FrameAcquisitionNumber))
        content.acquisition = std::to_string(*number);
    content.phase = group.text(DCM_StackID);
    if (const auto index = group.integer(DCM_TemporalPositionIndex))
        content.phase.append("/").append(std::to_string(*index));
    return content;
}

/// Of a plain image, beside its groups.
Content momentOf(const Dataset& dataset, bool signal)
{
    Content content{joined(dataset.values(DCM_AcquisitionNumber), 1), {}};
    if (signal)  // two echoes, or a moment after another, of one place
        content.phase =
            joined(dataset.values(DCM_EchoTime), 1) + "/" + joined(dataset.values(DCM_TemporalPositionIdentifier), 1);
    return content;
}

}  // namespace

struct FrameGroups::Groups {
    template <class Said>
    using Group = frame_group::Group<Said>;

    Group<Position> position;
    Group<Orientation> orientation;
    Group<Measures> measures;
    Group<Transformation> transformation;
    Group<std::string> image_type, kernel;
    Group<Content> content;

    Groups(const Dataset& dataset, const std::optional<Dataset>& shared, bool signal)
        : position(dataset, shared, DCM_PlanePositionSequence, positionIn),
          orientation(dataset, shared, DCM_PlaneOrientationSequence, orientationIn),
          measures(dataset, shared, DCM_PixelMeasuresSequence, measuresIn),
          transformation(dataset, shared, DCM_PixelValueTransformationSequence, transformationIn),
          image_type(dataset, shared, signal ? DCM_MRImageFrameTypeSequence : DCM_CTImageFrameTypeSequence,
                     imageTypeIn),
          kernel(dataset, shared, DCM_CTReconstructionSequence, kernelIn),
          content(dataset, shared, DCM_FrameContentSequence, contentIn)
    {
    }
};

FrameGroups::FrameGroups(const Dataset& dataset, bool signal)
    : dataset_(dataset),
      signal_(signal),
      groups_(std::make_unique<Groups>(dataset, dataset.item(DCM_SharedFunctionalGroupsSequence), signal))
{
}

FrameGroups::~FrameGroups() = default;

FrameSaid FrameGroups::of(const std::optional<Dataset>& own) const
{
    const Position position = groups_->position.of(own);
    const Orientation orientation = groups_->orientation.of(own);
    const Measures measures = groups_->measures.of(own);
    Transformation transformation = groups_->transformation.of(own);
    Content content = own ? groups_->content.of(own) : momentOf(dataset_, signal_);
    return {.origin_mm = position.origin_mm,
            .row = orientation.row,
            .column = orientation.column,
            .row_mm = measures.row_mm,
            .pixel_mm = measures.pixel_mm,
            .thickness_mm = measures.thickness_mm,
            .slope = transformation.slope,
            .intercept = transformation.intercept,
            .rescale_type = std::move(transformation.type),
            .decimal_commas = position.commas || orientation.commas || measures.commas || transformation.commas,
            .image_type = groups_->image_type.of(own),
            .kernel = groups_->kernel.of(own),
            .acquisition = std::move(content.acquisition),
            .phase = std::move(content.phase)};
}

}  // namespace vicon::ingest
