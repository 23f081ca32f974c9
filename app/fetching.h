#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "vicon/core/progress.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/query.h"

namespace vicon::app {

struct Fetched {
    ingest::RetrieveResult result;
    ingest::ImportReport report;
    bool by_listener = false;  ///< a running listener imports what comes
    bool whole = false;        ///< everything was there before
};

/// Fetches series of a study by C-GET and imports them; goes on where an earlier try stopped. Throws as
/// ingest::getSeries() and ingest::importPaths().
Fetched fetchByGet(Context& context, const std::string& study_uid, const ingest::Peer& peer,
                   const std::vector<std::string>& series, Progress& progress);

}  // namespace vicon::app
