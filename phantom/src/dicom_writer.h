#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::phantom {

/// What all series of a study have in common.
struct StudyHeader {
    std::uint64_t key = 0;  ///< that its identifiers follow from
    std::string study_uid;
    std::string patient_name, patient_id, birth_date, sex;
    std::string date, accession_number, study_id;
    std::string description = "CT COLONOGRAPHY", body_part = "COLON", protocol = "COLONOGRAPHY";
};

struct SeriesHeader {
    int number = 1;
    std::string uid;
    std::string description;
    std::string patient_position;
    std::string modality = "CT";  ///< or "MR": the values are a signal, without slope and intercept
};

/// Writes one CT or MR image per slice, under file names in no order; explicit little endian.
void writeSeries(const std::filesystem::path& folder, const StudyHeader& study, const SeriesHeader& series,
                 const HuVolume& hu, Progress& progress);

/// Writes the scan's coronal mean as a localizer.
void writeLocalizer(const std::filesystem::path& folder, const StudyHeader& study, const SeriesHeader& series,
                    const HuVolume& hu);

/// Writes a page such as scanners attach for the dose: a secondary capture.
void writeDoseSheet(const std::filesystem::path& folder, const StudyHeader& study, const SeriesHeader& series);

}  // namespace vicon::phantom
