#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/records.h"

namespace vicon::ingest {

/// What the images of a scan say of why and how it was made. Texts are UTF-8, empty where nothing is said.
struct AcquisitionFacts {
    std::string reason;    ///< for the requested procedure; else what the procedure is called
    std::string contrast;  ///< the agent, into a vein or the bowel
    /// Dose length product: the mean CTDIvol of the images times the length that they cover. Nothing where an image has
    /// none. The scanner's own figure is a little higher: it counts the turns before the first and after the last
    /// image.
    std::optional<double> dose_mgy_cm;
};

/// Reads the headers of a scan's images; those that cannot be read say nothing.
/// @param folder where they lie
AcquisitionFacts acquisitionFacts(const std::filesystem::path& folder, const std::vector<InstanceRecord>& instances);

}  // namespace vicon::ingest
