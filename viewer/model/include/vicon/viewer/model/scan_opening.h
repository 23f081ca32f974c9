#pragma once

#include <optional>
#include <string>
#include <variant>

#include "vicon/core/geometry.h"

namespace vicon::viewer {

/// A scan to be opened, why, and what is shown then.
struct ScanRequest {
    std::string scan_id;
    bool read_again = false;               ///< its files were made anew, or another way through it is read
    bool redone = false;                   ///< it has a new skeleton: what is marked is placed on it anew
    bool redone_by_other = false;          ///< for another reader, who is not asked
    std::optional<std::string> marker_id;  ///< shown as soon as the scan is open
    std::optional<Point3> go_to_mm;        ///< where the eye goes, in the scan that is open already
};

// Where the eye goes in a scan that has been opened.

/// Where this reader left it; no scan was read before.
struct LastPlace {};
/// What corresponds to a place of the scan that was read before.
struct CorrespondingPlace {
    double station_mm = 0;  ///< in the scan before, when the other one was asked for
};
/// In the same scan, read again.
struct SamePlace {
    std::optional<Point3> point_mm;  ///< nothing: where the eye was
};

/// What follows when a scan is open.
struct Arrival {
    std::variant<LastPlace, CorrespondingPlace, SamePlace> place;
    std::optional<std::string> marker_id;  ///< to be shown
    bool place_markers = false;            ///< what is marked is placed on a new skeleton
    bool redone_by_other = false;          ///< to be said
};

/// The open scan as the worklist shows it.
struct ScanObserved {
    std::string scan_id;
    bool in_work = false;    ///< queued or running
    bool readable = false;   ///< done, and it can be shown
    bool made_anew = false;  ///< its files are not those that are open
    bool own_work = false;   ///< it is done again for this reader
};

/// The request to open a scan, from asking to arriving. A later request replaces one that is under way. Markers of
/// a scan that was done again are placed anew when a scan is opened next, also after requests that were given up.
class ScanOpening {
public:
    /// Where the reader leaves from.
    struct From {
        std::string scan_id;
        double station_mm = 0;
    };

    /// @param from nothing: no scan is open
    void ask(const ScanRequest& request, const std::optional<From>& from);
    /// Cancelled, or its files could not be read; the scan that is open stays.
    void giveUp();
    /// What was asked for last is open.
    Arrival opened(const std::string& scan_id);
    /// A request where the scan was done again elsewhere: it was seen in work, and has other files now.
    std::optional<ScanRequest> observed(const ScanObserved& scan);

    bool underWay() const { return asked_.has_value(); }

private:
    std::optional<ScanRequest> asked_;
    std::optional<From> from_;
    bool owes_markers_ = false;
    bool in_work_elsewhere_ = false;
};

}  // namespace vicon::viewer
