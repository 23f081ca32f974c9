#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::ingest {

/// The forms in which another program may give a lumen.
enum class MaskForm { segmentation_object, nifti, nrrd, meta_image };
/// "DICOM SEG", "NIfTI", "NRRD", "MetaImage".
std::string nameOf(MaskForm form);

/// A lumen as another program wrote it.
struct MaskFile {
    MaskForm form = MaskForm::nifti;
    std::string sha256;  ///< of the file; of a header with the voxels in another file, of both
    /// 1 where the label is, else 0. Cropped to it, with a voxel around as far as the file's lattice goes. The lattice
    /// is the file's own: in LPS mm, axes in any order and direction, also left-handed.
    InsideVolume mask;
    Point3 lattice_middle_mm;            ///< of the file's whole lattice
    int label = 0;                       ///< whose voxels these are
    std::string frame_of_reference_uid;  ///< of a DICOM SEG; other forms have none
    std::vector<std::string> notes;      ///< what a person should know of how it was read
};

/// Reads a DICOM SEG, a NIfTI-1 (.nii, .nii.gz), an NRRD or a MetaImage (.mha, .mhd); which of them the content tells.
/// The file is a stranger's: its header is held against limits and the file's length before memory is asked for, no
/// library but DCMTK sees it, and that only what whyNotToRead() lets pass. What lies nowhere certain in the patient is
/// refused.
/// @param label the one to take; nothing: the only one that there is
/// @param largest_mvoxel a lattice of more million voxels is refused
/// Throws Error{not_found}, Error{bad_input} with what is wrong, Error{wrong_use} when a label must be chosen or is not
/// there, Error{no_memory}, Error{cancelled}.
MaskFile readMask(const std::filesystem::path& file, std::optional<int> label, double largest_mvoxel,
                  Progress& progress);

}  // namespace vicon::ingest
