#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/ingest/sender.h"

namespace vicon::ingest {

/// What to look for; an empty field matches everything. Text may hold DICOM's wildcards * and ?.
struct StudyQuery {
    std::string patient_id;
    std::string patient_name;
    /// YYYYMMDD or YYYY-MM-DD, or a range of two such dates with "-" between, with either end left out
    std::string dates;
    std::string accession_number;
    std::string study_uid;
    std::string modality = "CT";  ///< that some series of the study has
    std::string description;      ///< of the study; in any case or not, as the peer matches
    std::string
        series_description;  ///< that some series of the study has, in any case; each study is asked for its own
};

/// A study as the peer describes it; UTF-8, empty where the peer says nothing.
struct FoundStudy {
    std::string study_uid, patient_id, patient_name, birth_date, date, time, description, accession_number, modalities;
    int series = -1;  ///< -1: the peer does not say
    int images = -1;
};

/// Whether a date that a peer gave is a day, as DICOM writes it, and can be asked for.
bool isDicomDate(const std::string& date);

/// Whether a text names one study, series or object, as UIDs do; zeros in front are some archives' way.
bool isLikeUid(const std::string& text);

/// Asks a peer for studies (C-FIND, study root), in order of date, then UID.
/// @throws Error{wrong_use} for dates that are none, Error{peer} when no association can be made, or the peer refuses
/// or does not answer; Error{cancelled}
std::vector<FoundStudy> findStudies(const Peer& peer, const StudyQuery& query, const std::string& our_ae_title,
                                    Progress& progress);

/// A series as the peer describes it; UTF-8, empty where the peer says nothing.
struct FoundSeries {
    std::string uid, modality, description, body_part;
    int images = -1;  ///< -1: the peer does not say
};

/// The series of a study, in order of their UIDs. Throws as findStudies().
std::vector<FoundSeries> describeSeries(const Peer& peer, const std::string& study_uid, const std::string& our_ae_title,
                                        Progress& progress);

/// The series of a study that have this modality: their Series Instance UIDs, sorted. Throws as findStudies().
std::vector<std::string> findSeries(const Peer& peer, const std::string& study_uid, const std::string& modality,
                                    const std::string& our_ae_title, Progress& progress);

/// The objects of a series: their SOP Instance UIDs, sorted. Throws as findStudies().
std::vector<std::string> findObjects(const Peer& peer, const std::string& study_uid, const std::string& series_uid,
                                     const std::string& our_ae_title, Progress& progress);

/// What a peer sent, or says that it sent.
struct RetrieveResult {
    int completed = 0;
    int failed = 0;                    ///< at least one for a series that was refused as a whole
    std::vector<std::string> reasons;  ///< why a series was refused; the others were fetched
};

/// Fetches series over the association that asks for them (C-GET, study root); no port has to be open here. CT images,
/// secondary captures and structured reports in every encoding, kept as they come. The files lie in `folder`, which is
/// made private. Objects of `have` (SOP Instance UIDs), and those that an earlier try left whole in the folder, are not
/// fetched.
/// @throws Error{peer} when no association can be made, or it breaks: what came lies in the folder, and the same call
///         goes on; Error{store}, Error{cancelled}
RetrieveResult getSeries(const Peer& peer, const std::string& study_uid, const std::vector<std::string>& series_uids,
                         const std::filesystem::path& folder, const std::string& our_ae_title, Progress& progress,
                         const std::set<std::string>& have = {});

/// Has a peer send series to the listener `destination_ae_title` (C-MOVE, study root), which the peer must know and
/// which must be listening: see Receiver. Objects of `have` (SOP Instance UIDs) are not asked for, so that a retrieval
/// that failed half-way goes on with what is missing. Throws Error{peer}, Error{cancelled}.
RetrieveResult moveSeries(const Peer& peer, const std::string& study_uid, const std::vector<std::string>& series_uids,
                          const std::string& destination_ae_title, const std::string& our_ae_title, Progress& progress,
                          const std::set<std::string>& have = {});

}  // namespace vicon::ingest
