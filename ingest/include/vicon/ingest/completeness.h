#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/ingest/peer.h"

namespace vicon::ingest {

/// Asks an archive whether all objects of a study that arrives have arrived: of the series that have begun, and of all
/// others of their modality, CT or MR. One thread at a time.
class Completeness {
public:
    /// @param peer the archive
    Completeness(StorePlace place, Peer peer, std::string our_ae_title);

    /// How many objects the archive has of the study that these files belong to, and that lie nowhere here: neither in
    /// a case, nor among the files, nor in quarantine. Throws Error{peer} when it does not answer; it is then left
    /// alone for a while, as long as that 0.
    int missing(const std::vector<std::filesystem::path>& files);

private:
    StorePlace place_;
    Peer peer_;
    std::string our_ae_title_;
    std::chrono::steady_clock::time_point ask_again_;
};

}  // namespace vicon::ingest
