#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::test {

/// A density for each point of the patient.
using Densities = std::function<double(Point3)>;

/// A CT series to write. Defaults make a valid small one; a test changes what it is about.
struct SeriesSpec {
    std::string study_uid = "1.2.826.0.1.3680043.10.1.1";
    std::string series_uid = "1.2.826.0.1.3680043.10.1.1.1";
    std::string frame_of_reference_uid = "1.2.826.0.1.3680043.10.1.1.9";
    std::string patient_id = "P1";
    std::string patient_name = "Doe^Jane";
    std::string birth_date = "19600101";
    std::string study_date = "20260102";
    std::string accession_number, referring_physician;  ///< empty: it has none
    std::string patient_position = "HFS";
    std::string modality = "CT";
    bool mr_images = false;  ///< in place of CT; without slope and intercept where they say nothing
    std::string echo_time;   ///< empty: it has none
    std::string sop_suffix;  ///< of the instances' UIDs
    std::string image_type = "ORIGINAL\\PRIMARY\\AXIAL";
    std::string kernel = "B30f";
    std::string acquisition_number = "1";
    std::string acquisition_time = "101500";
    int series_number = 2;
    double thickness_mm = 2;
    Point3 first_mm{-15, -15, -20};  ///< centre of the first pixel of the first slice
    Vector3 row{1, 0, 0};
    Vector3 column{0, 1, 0};
    Vector3 step_mm{0, 0, 2};  ///< from slice to slice
    double pixel_mm = 1;
    double row_mm = 1;
    int columns = 16;
    int rows = 16;
    int slices = 12;
    int bits_allocated = 16;
    int bits_stored = 12;
    int high_bit = 11;
    bool is_signed = false;
    double slope = 1;
    double intercept = -1024;
    std::optional<int> padding;
    Densities densities = [](Point3 p) { return 2 * p.x + 3 * p.y + 5 * p.z; };

    std::string sopUid(int slice) const { return series_uid + "." + std::to_string(slice + 1) + sop_suffix; }
    Point3 position(int slice) const { return first_mm + step_mm * slice; }
};

/// Writes the named slices of a series (all when none is named) as plain CT images, "N.dcm". Returns their files.
std::vector<std::filesystem::path> writeSeries(const std::filesystem::path& folder, const SeriesSpec& spec,
                                               const std::vector<int>& slices = {});

/// Writes the series as one Enhanced CT object, its frames in the given order.
/// @param kernels of the frames where they have one each, else spec.kernel
std::filesystem::path writeEnhanced(const std::filesystem::path& file, const SeriesSpec& spec,
                                    const std::vector<int>& order, const std::vector<std::string>& kernels = {});

}  // namespace vicon::test
