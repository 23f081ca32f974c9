#pragma once

#include <string>
#include <vector>

#include "vicon/cases/records.h"
#include "vicon/core/progress.h"
#include "vicon/ingest/query.h"

namespace vicon::ingest {

/// A step of a procedure that a department's system has scheduled; UTF-8, empty where it says nothing.
struct ScheduledStep {
    Patient patient;
    std::string study_uid, accession_number, referring_physician;
    std::string procedure_id, procedure;  ///< as it was requested
    std::string reason;                   ///< for the request
    std::string modality, station;        ///< where it is done: AE title
    std::string date, time, description;
};

/// Asks a peer for scheduled steps (C-FIND, modality worklist), in order of date, then accession number. The query's
/// dates are those of the step's start. Throws as findStudies().
std::vector<ScheduledStep> findScheduledSteps(const Peer& peer, const StudyQuery& query,
                                              const std::string& our_ae_title, Progress& progress);

}  // namespace vicon::ingest
