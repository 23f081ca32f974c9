#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <functional>
#include <initializer_list>
#include <string>

#include "vicon/core/progress.h"
#include "vicon/ingest/peer.h"

namespace vicon::ingest {

/// A key of a query. Throws Error{wrong_use}.
void put(DcmItem& keys, const DcmTagKey& tag, const std::string& value);

/// What the peer shall tell, whatever it is.
void askFor(DcmItem& keys, std::initializer_list<DcmTagKey> tags);

/// A day or a range as DICOM writes it: "20240110", "20240101-". Throws Error{wrong_use}.
std::string dicomDates(const std::string& text);

/// An information model, and what to say of a peer that does not offer it.
struct FindModel {
    const char* uid;
    const char* without;
};

/// C-FIND; every match is handed over as it comes. Throws Error{peer}, Error{cancelled}.
void find(const Peer& peer, const FindModel& model, DcmDataset& keys, const std::string& our_ae_title,
          Progress& progress, const std::function<void(DcmDataset&)>& on_match);

}  // namespace vicon::ingest
