#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctagkey.h>

#include <optional>
#include <string>
#include <vector>

namespace vicon::ingest {

/// What becomes of an attribute in an anonymous object; of those that are not listed: removed.
enum class AnonymousFate {
    keep,   ///< it describes the picture; of a sequence: its items, by the same list
    uid,    ///< another one, the same for the same
    time,   ///< earlier, see anonymousMoments()
    empty,  ///< must be there, may be empty
    dummy,  ///< must be there with some value
};

/// By DICOM PS3.15 table E.1-1, which says what must go: kept is only what a CT image needs to be read and measured.
std::optional<AnonymousFate> anonymousFateOf(const DcmTagKey& tag);

/// A date and the time of that day.
struct DateAndTime {
    DcmTagKey date, time;
};
const std::vector<DateAndTime>& anonymousMoments();
/// Attributes that hold both.
const std::vector<DcmTagKey>& anonymousDateTimes();
/// What an object of this class must have, if only empty.
const std::vector<DcmTagKey>& requiredOfAnonymous(const std::string& sop_class);

}  // namespace vicon::ingest
