#pragma once

#include <memory>
#include <optional>
#include <string>

#include "dataset.h"

namespace vicon::ingest {

/// What is said of one image plane, as it stands; see Slice.
struct FrameSaid {
    std::optional<Vector3> origin_mm;
    std::optional<Vector3> row, column;
    std::optional<double> row_mm, pixel_mm;
    double thickness_mm = 0;
    std::optional<double> slope, intercept;
    std::string rescale_type;
    bool decimal_commas = false;  ///< in one of the numbers
    std::string image_type, kernel, acquisition, phase;
};

/// Where an object's frames say it: in their own functional groups, else the shared ones, else (plain image) in the
/// data set. What frames share is read once: it may be long, and stand behind thousands of other elements.
class FrameGroups {
public:
    /// @param signal of MR: there the types of frames stand elsewhere
    FrameGroups(const Dataset& dataset, bool signal);
    ~FrameGroups();
    FrameGroups(const FrameGroups&) = delete;
    FrameGroups& operator=(const FrameGroups&) = delete;

    /// @param own the frame's functional groups; nothing for a plain image
    FrameSaid of(const std::optional<Dataset>& own) const;

private:
    struct Groups;
    Dataset dataset_;
    bool signal_;
    std::unique_ptr<Groups> groups_;
};

}  // namespace vicon::ingest
