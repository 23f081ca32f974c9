#include "mask/segmentation_object.h"

#include <algorithm>
#include <map>

#include "dataset.h"
#include "helper.h"
#include "mask/frame_stack.h"
#include "mask/label_choice.h"
#include "mask/labelled_slices.h"
#include "mask/refusal.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr const char* kWriteSegAgain = "write it again as a BINARY segmentation of the scan";

/// The object, and what its functional groups say of all frames and of each.
class SegObject {
public:
    explicit SegObject(const fs::path& file) : file_(file)
    {
        setUpDicom();
        if (const std::string why = whyNotToRead(file); !why.empty())
            throw maskRefused(file, why, kWriteSegAgain);
        if (loadFile(format_, file, kLargestElementInMemory).bad())
            throw maskRefused(file, "is damaged or cut off", "copy it again");
        data_.emplace(*format_.getDataset());
        if (firstOf(data_->values(DCM_SOPClassUID)) != UID_SegmentationStorage)
            throw maskRefused(file, "is DICOM, but no segmentation", "give a DICOM SEG, NIfTI, NRRD or MetaImage file");
        const std::string type = firstOf(data_->values(DCM_SegmentationType));
        fractional_ = type == "FRACTIONAL";
        if (type != "BINARY" && !fractional_)
            throw maskRefused(file, "is neither a BINARY nor a FRACTIONAL segmentation", kWriteSegAgain);
        shared_ = data_->item(DCM_SharedFunctionalGroupsSequence);
        frames_ = data_->items(DCM_PerFrameFunctionalGroupsSequence);
    }

    const Dataset& data() const { return *data_; }
    DcmDataset& dataset() { return *format_.getDataset(); }
    bool fractional() const { return fractional_; }
    FramePlanes planes() const
    {
        FramePlanes planes{.rows = required(data_->integer(DCM_Rows)),
                           .columns = required(data_->integer(DCM_Columns))};
        if (frames_.empty() || int(frames_.size()) != data_->integer(DCM_NumberOfFrames).value_or(0))
            throw maskRefused(file_, "does not say of each frame where it lies", kWriteSegAgain);
        for (const Dataset& frame : frames_) {
            const auto [along_row, along_column] = stepsOf(frame, planes);
            constexpr double kAlike_mm = 1e-3;
            if (!planes.frames.empty() && (length(along_row - planes.column_step_mm) > kAlike_mm ||
                                           length(along_column - planes.row_step_mm) > kAlike_mm))
                throw maskRefused(file_, "its frames have different sizes or directions", kWriteSegAgain);
            planes.column_step_mm = along_row;
            planes.row_step_mm = along_column;
            planes.frames.push_back({pointOf(group(frame, DCM_PlanePositionSequence)), segmentOf(frame)});
        }
        return planes;
    }

private:
    template <class Value>
    Value required(const std::optional<Value>& value) const
    {
        if (!value)
            throw maskRefused(file_, "does not say of each frame where it lies and whose it is", kWriteSegAgain);
        return *value;
    }
    /// Of the frame itself, else of all.
    Dataset group(const Dataset& frame, const DcmTagKey& sequence) const
    {
        if (const auto own = frame.item(sequence))
            return *own;
        return required(shared_ ? shared_->item(sequence) : std::nullopt);
    }
    std::pair<Vector3, Vector3> stepsOf(const Dataset& frame, FramePlanes& planes) const
    {
        const Dataset measures = group(frame, DCM_PixelMeasuresSequence);
        const Dataset orientation = group(frame, DCM_PlaneOrientationSequence);
        std::array<double, 6> a{};
        for (std::size_t n = 0; n < a.size(); ++n)
            a[n] = required(orientation.number(DCM_ImageOrientationPatient, n));
        planes.declared_step_mm =
            measures.number(DCM_SpacingBetweenSlices).value_or(measures.number(DCM_SliceThickness).value_or(0));
        const double between_rows_mm = required(measures.number(DCM_PixelSpacing, 0));
        const double between_columns_mm = required(measures.number(DCM_PixelSpacing, 1));
        return {Vector3{a[0], a[1], a[2]} * between_columns_mm, Vector3{a[3], a[4], a[5]} * between_rows_mm};
    }
    Point3 pointOf(const Dataset& position) const
    {
        return {required(position.number(DCM_ImagePositionPatient, 0)),
                required(position.number(DCM_ImagePositionPatient, 1)),
                required(position.number(DCM_ImagePositionPatient, 2))};
    }
    int segmentOf(const Dataset& frame) const
    {
        return required(group(frame, DCM_SegmentIdentificationSequence).integer(DCM_ReferencedSegmentNumber));
    }

    fs::path file_;
    DcmFileFormat format_;
    std::optional<Dataset> data_, shared_;
    std::vector<Dataset> frames_;
    bool fractional_ = false;
};

/// Frames one behind the other: a bit a pixel, lowest first, or a byte.
class FramePixels {
public:
    FramePixels(SegObject& object, std::size_t frames, const fs::path& file)
        : pixels_(std::size_t(object.data().integer(DCM_Rows).value_or(0)) *
                  std::size_t(object.data().integer(DCM_Columns).value_or(0))),
          bits_(!object.fractional()),
          half_((object.data().integer(DCM_MaximumFractionalValue).value_or(255) + 1) / 2)
    {
        const int allocated = object.data().integer(DCM_BitsAllocated).value_or(0);
        if (allocated != (bits_ ? 1 : 8) || DcmXfer(object.dataset().getOriginalXfer()).isBigEndian())
            throw maskRefused(file, "its pixels are not stored as a segmentation's are", kWriteSegAgain);
        DcmElement* element = nullptr;
        object.dataset().findAndGetElement(DCM_PixelData, element);
        const std::size_t wanted = bits_ ? (pixels_ * frames + 7) / 8 : pixels_ * frames;
        if (!element || DcmXfer(object.dataset().getOriginalXfer()).isEncapsulated())
            throw maskRefused(file, "has no pixels, or compressed ones", "write it uncompressed");
        if (element->getLength() < wanted || element->getLength() > wanted + 1)
            throw maskRefused(file, "has more or fewer pixels than its header says", kWriteSegAgain);
        Uint16* words = nullptr;
        if (element->getUint8Array(bytes_).bad() && element->getUint16Array(words).good())
            bytes_ = reinterpret_cast<Uint8*>(words);
        if (!bytes_)
            throw maskRefused(file, "its pixels cannot be read", kWriteSegAgain);
    }
    bool at(std::size_t frame, std::size_t pixel) const
    {
        const std::size_t n = frame * pixels_ + pixel;
        return bits_ ? (bytes_[n / 8] >> n % 8 & 1U) != 0 : bytes_[n] >= half_ && half_ > 0;
    }

private:
    std::size_t pixels_;
    bool bits_;
    int half_;
    Uint8* bytes_ = nullptr;
};

/// What the object calls its segments, of those that have frames.
std::map<std::int64_t, std::string> namesOf(const SegObject& object, const FramePlanes& planes)
{
    std::map<std::int64_t, std::string> names;
    for (const SegmentFrame& frame : planes.frames)
        names[frame.segment];
    for (const Dataset& segment : object.data().items(DCM_SegmentSequence))
        if (const auto found = names.find(segment.integer(DCM_SegmentNumber).value_or(0)); found != names.end())
            found->second = segment.text(DCM_SegmentLabel);
    return names;
}

}  // namespace

MaskFile readSegmentationObject(const fs::path& file, std::optional<int> label, double largest_mvoxel,
                                Progress& progress)
{
    SegObject object(file);
    MaskFile out{.form = MaskForm::segmentation_object};
    const FramePlanes planes = object.planes();
    const FrameStack stack = stackOf(planes, largest_mvoxel, file);
    const std::int64_t chosen = chooseLabel(namesOf(object, planes), label, file);
    const FramePixels pixels(object, planes.frames.size(), file);
    LabelledSlices slices(stack.grid);
    for (std::size_t n = 0; n < planes.frames.size(); ++n) {
        progress.check();
        progress.report(double(n) / double(planes.frames.size()), "reading the mask");
        if (planes.frames[n].segment != chosen)
            continue;
        for (int j = 0; j < planes.rows; ++j)
            for (int i = 0; i < planes.columns; ++i)
                if (pixels.at(n, std::size_t(j) * std::size_t(planes.columns) + std::size_t(i)))
                    slices.set({i, j, stack.slice[n]}, chosen);
    }
    if (slices.counts().empty())
        throw maskRefused(file, "is empty: no voxel of it is marked", "look at it in the program that wrote it");
    out.label = int(chosen);
    out.mask = slices.only(chosen);
    out.lattice_middle_mm = slices.middle_mm();
    out.frame_of_reference_uid = firstOf(object.data().values(DCM_FrameOfReferenceUID));
    if (object.fractional())
        out.notes.emplace_back("its fractions were cut at one half");
    return out;
}

}  // namespace vicon::ingest
