#include "vicon/ingest/mask_file.h"

#include <array>
#include <fstream>
#include <new>
#include <string_view>

#include "helper.h"
#include "mask/image_labels.h"
#include "mask/label_choice.h"
#include "mask/refusal.h"
#include "mask/segmentation_object.h"
#include "mask/voxel_stream.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// A file's first bytes, unpacked where it is gzip; fewer where it ends.
std::string beginningOf(const fs::path& file)
{
    constexpr std::size_t kLooked = 348;
    std::string bytes(kLooked, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(in.gcount()));
    if (!bytes.starts_with("\x1f\x8b"))
        return bytes;
    bytes.assign(kLooked, '\0');
    VoxelStream(file, 0, true).read(bytes.data(), bytes.size());
    return bytes;
}

std::optional<MaskForm> formOf(const std::string& bytes)
{
    const auto hasAt = [&](std::size_t place, std::string_view text) {
        return bytes.size() >= place + text.size() && bytes.compare(place, text.size(), text) == 0;
    };
    constexpr std::size_t kDicomMark = 128, kNiftiMark = 344;
    if (hasAt(kDicomMark, "DICM"))
        return MaskForm::segmentation_object;
    if (hasAt(0, "NRRD000"))
        return MaskForm::nrrd;
    if (hasAt(kNiftiMark, "n+1") || hasAt(kNiftiMark, "ni1"))
        return MaskForm::nifti;
    if (bytes.find("NDims") != std::string::npos)
        return MaskForm::meta_image;
    return std::nullopt;
}

ImageHeader readHeader(MaskForm form, const fs::path& file, double largest_mvoxel)
{
    switch (form) {
        case MaskForm::nifti:
            return readNiftiHeader(file, largest_mvoxel);
        case MaskForm::nrrd:
            return readNrrdHeader(file, largest_mvoxel);
        default:
            return readMetaImageHeader(file, largest_mvoxel);
    }
}

MaskFile readImage(MaskForm form, const fs::path& file, std::optional<int> label, double largest_mvoxel,
                   Progress& progress)
{
    const ImageHeader header = readHeader(form, file, largest_mvoxel);
    const LabelledSlices slices = readImageLabels(header, progress);
    std::map<std::int64_t, std::string> labels;
    for (const auto& [value, count] : slices.counts())
        labels[value];
    const std::int64_t chosen = chooseLabel(labels, label, file);
    MaskFile out{.form = form};
    out.label = int(chosen);
    out.mask = slices.only(chosen);
    out.lattice_middle_mm = slices.middle_mm();
    if (header.voxel_file != file)
        out.sha256 = sha256(sha256OfFile(file) + sha256OfFile(header.voxel_file));
    return out;
}

}  // namespace

std::string nameOf(MaskForm form)
{
    switch (form) {
        case MaskForm::segmentation_object:
            return "DICOM SEG";
        case MaskForm::nifti:
            return "NIfTI";
        case MaskForm::nrrd:
            return "NRRD";
        case MaskForm::meta_image:
            break;
    }
    return "MetaImage";
}

MaskFile readMask(const fs::path& file, std::optional<int> label, double largest_mvoxel, Progress& progress)
try {
    std::error_code failure;
    const fs::file_type type = fs::status(file, failure).type();
    if (type == fs::file_type::not_found)
        throw Error(ErrorCode::not_found, "no such file", file.string(), "check the name");
    if (type != fs::file_type::regular)
        throw Error(ErrorCode::not_found, failure ? "cannot be opened (" + failure.message() + ")" : "is no file",
                    file.string(), "check the name");
    const std::optional<MaskForm> form = formOf(beginningOf(file));
    if (!form)
        throw maskRefused(file, "is no mask that can be read", "give a DICOM SEG, NIfTI, NRRD or MetaImage file");
    MaskFile out = *form == MaskForm::segmentation_object
                       ? readSegmentationObject(file, label, largest_mvoxel, progress)
                       : readImage(*form, file, label, largest_mvoxel, progress);
    if (out.sha256.empty())
        out.sha256 = sha256OfFile(file);
    endIdleHelpers();
    return out;
} catch (const std::bad_alloc&) {
    throw Error(ErrorCode::no_memory, "does not fit into memory", file.string(), "close other programs");
}

}  // namespace vicon::ingest
