#pragma once

#include <map>
#include <memory>

#include "measurement_groups.h"
#include "vicon/cases/given_lumen.h"
#include "vicon/report/report_objects.h"

class DcmFileFormat;

namespace vicon::report {

struct ShownScans::Parts {
    MarkerImages findings;
    std::vector<Centreline> centrelines;
    std::map<std::string, std::unique_ptr<DcmFileFormat>> lumens;  ///< by the scan's id; without patient and version
};

/// The lumen of a scan on the planes of its images, as Segmentation; nothing where no image shows any of it.
/// @param given where it came from; absent: VICON found it
std::unique_ptr<DcmFileFormat> drawLumen(const ScanRecord& scan, const std::vector<ImagePlane>& images,
                                         const std::filesystem::path& scan_folder,
                                         const std::optional<LumenOrigin>& given);

}  // namespace vicon::report
