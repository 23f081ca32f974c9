#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "vicon/ingest/commitment.h"
#include "vicon/ingest/query.h"
#include "vicon/ingest/sender.h"

/// What the functions of the same names do, for a peer that is reached by DICOMweb; they throw the same.
namespace vicon::ingest::web {

std::vector<FoundStudy> findStudies(const Peer& peer, const StudyQuery& query, Progress& progress);
std::vector<FoundSeries> describeSeries(const Peer& peer, const std::string& study_uid, Progress& progress);
std::vector<std::string> findObjects(const Peer& peer, const std::string& study_uid, const std::string& series_uid,
                                     Progress& progress);
/// Whether it answers a query.
void echo(const Peer& peer);

/// @param here SOP Instance UIDs that are not fetched
RetrieveResult getSeries(const Peer& peer, const std::string& study_uid, const std::vector<std::string>& series_uids,
                         const std::filesystem::path& folder, const std::set<std::string>& here, Progress& progress);

SendResult storeFiles(const Peer& peer, const std::vector<std::filesystem::path>& files, Progress& progress,
                      const OnStored& on_stored);

/// What a peer has of an object that was sent to it.
enum class Kept {
    whole,
    changed,
    missing,
    unsaid,  ///< it gives nothing back
};
/// Reads it back and compares it, element by element; the file's meta header does not count. Throws Error{peer} when
/// the peer does not answer, Error{cancelled}.
Kept readBack(const Peer& peer, const std::filesystem::path& file, Progress& progress);

}  // namespace vicon::ingest::web
