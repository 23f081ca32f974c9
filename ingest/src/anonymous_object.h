#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <string>

#include "pseudonyms.h"

namespace vicon::ingest {

/// Why an object is not written: it may hold text in its pixels, or is no CT image; empty where it is.
std::string whyNotAnonymous(DcmDataset& dataset);

/// What stands in an object's place in the database, for one that lacks it.
struct NewUids {
    std::string study, series, object;
};

/// Leaves of an object what DICOM PS3.15's basic profile lets stay, see anonymousFateOf(), and says that it did so.
void makeAnonymous(DcmDataset& dataset, const Pseudonyms& pseudonyms, const NewUids& uids);

}  // namespace vicon::ingest
