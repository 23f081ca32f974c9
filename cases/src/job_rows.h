#pragma once

#include <soci/soci.h>

#include <optional>
#include <string>

namespace vicon {

/// The database's clock, which all processes share: seconds since the epoch.
double secondsIn(soci::session& sql);

/// A scan's row in the queue's table, within a transaction of the caller.

/// The counter of how far, in thousandths, workers that stopped without a word had got with the job.
std::string furthestName(const std::string& case_id, const std::string& scan_id);

/// Adds a job, or puts a finished one back into the queue, for its sender's next turn.
/// @param sender who sent its images; none: as it was
void enqueueJob(soci::session& sql, const std::string& case_id, const std::string& scan_id,
                std::optional<std::string> sender = {});
/// Takes it out of the queue unless it is done.
void withdrawJob(soci::session& sql, const std::string& case_id, const std::string& scan_id);
void removeJob(soci::session& sql, const std::string& case_id, const std::string& scan_id);

}  // namespace vicon
