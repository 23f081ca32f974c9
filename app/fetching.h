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

/// Fetches series of a study as the peer is to be asked (Peer::retrieve) and imports them; goes on where an earlier try
/// stopped. What is moved is taken on receive.port, by the store's running listener where there is one.
/// Throws as ingest::getSeries(), ingest::moveSeries(), ingest::Receiver and ingest::importPaths().
Fetched fetchSeries(Context& context, const std::string& study_uid, const ingest::Peer& peer,
                    const std::vector<std::string>& series, Progress& progress);

/// Waits until the store's running listener has taken what lies in its folder now. Throws Error{cancelled}.
void waitForListener(Context& context, Progress& progress);

}  // namespace vicon::app
