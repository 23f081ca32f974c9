#include "vicon/ingest/query.h"

#include <algorithm>
#include <tuple>

#include "dataset.h"
#include "find.h"
#include "pattern.h"
#include "web_peer.h"

namespace vicon::ingest {
namespace {

constexpr FindModel kStudyRoot{UID_FINDStudyRootQueryRetrieveInformationModel,
                               "the peer answers no queries of study root"};

FoundStudy studyFrom(DcmDataset& match)
{
    const Dataset d(match);
    FoundStudy study;
    study.study_uid = d.text(DCM_StudyInstanceUID);
    study.patient_id = d.text(DCM_PatientID);
    study.patient_name = d.personName(DCM_PatientName);
    study.birth_date = d.text(DCM_PatientBirthDate);
    study.date = d.text(DCM_StudyDate);
    study.time = d.text(DCM_StudyTime);
    study.description = d.text(DCM_StudyDescription);
    study.accession_number = d.text(DCM_AccessionNumber);
    study.modalities = d.text(DCM_ModalitiesInStudy);
    study.series = d.integer(DCM_NumberOfStudyRelatedSeries).value_or(-1);
    study.images = d.integer(DCM_NumberOfStudyRelatedInstances).value_or(-1);
    return study;
}

std::vector<FoundStudy> findByDimse(const Peer& peer, const StudyQuery& query, const std::string& our_ae_title,
                                    Progress& progress)
{
    DcmDataset keys;
    put(keys, DCM_SpecificCharacterSet, "ISO_IR 192");
    put(keys, DCM_QueryRetrieveLevel, "STUDY");
    put(keys, DCM_PatientID, query.patient_id);
    put(keys, DCM_PatientName, query.patient_name);
    put(keys, DCM_StudyDate, dicomDates(query.dates));
    put(keys, DCM_AccessionNumber, query.accession_number);
    put(keys, DCM_StudyInstanceUID, query.study_uid);
    put(keys, DCM_ModalitiesInStudy, query.modality);
    put(keys, DCM_StudyDescription, query.description);
    askFor(keys,
           {DCM_PatientBirthDate, DCM_StudyTime, DCM_NumberOfStudyRelatedSeries, DCM_NumberOfStudyRelatedInstances});
    std::vector<FoundStudy> studies;
    find(peer, kStudyRoot, keys, our_ae_title, progress,
         [&](DcmDataset& match) { studies.push_back(studyFrom(match)); });
    std::sort(studies.begin(), studies.end(), [](const FoundStudy& a, const FoundStudy& b) {
        return std::tie(a.date, a.time, a.study_uid) < std::tie(b.date, b.time, b.study_uid);
    });
    return studies;
}

}  // namespace

bool isLikeUid(const std::string& text)
{
    constexpr std::size_t kLongest = 64;
    return !text.empty() && text.size() <= kLongest && text.find_first_not_of("0123456789.") == std::string::npos;
}

std::vector<FoundStudy> findStudies(const Peer& peer, const StudyQuery& query, const std::string& our_ae_title,
                                    Progress& progress)
{
    std::vector<FoundStudy> studies =
        peer.web ? web::findStudies(peer, query, progress) : findByDimse(peer, query, our_ae_title, progress);
    if (query.series_description.empty())
        return studies;
    // No peer has to match it where studies are asked for.
    std::erase_if(studies, [&](const FoundStudy& study) {
        const auto series = describeSeries(peer, study.study_uid, our_ae_title, progress);
        return std::none_of(series.begin(), series.end(),
                            [&](const FoundSeries& one) { return isLike(one.description, query.series_description); });
    });
    return studies;
}

std::vector<FoundSeries> describeSeries(const Peer& peer, const std::string& study_uid, const std::string& our_ae_title,
                                        Progress& progress)
{
    if (peer.web)
        return web::describeSeries(peer, study_uid, progress);
    DcmDataset keys;
    put(keys, DCM_SpecificCharacterSet, "ISO_IR 192");
    put(keys, DCM_QueryRetrieveLevel, "SERIES");
    put(keys, DCM_StudyInstanceUID, study_uid);
    askFor(keys, {DCM_SeriesInstanceUID, DCM_Modality, DCM_SeriesDescription, DCM_BodyPartExamined,
                  DCM_NumberOfSeriesRelatedInstances});
    std::vector<FoundSeries> series;
    find(peer, kStudyRoot, keys, our_ae_title, progress, [&](DcmDataset& match) {
        const Dataset d(match);
        series.push_back({d.text(DCM_SeriesInstanceUID), d.text(DCM_Modality), d.text(DCM_SeriesDescription),
                          d.text(DCM_BodyPartExamined), d.integer(DCM_NumberOfSeriesRelatedInstances).value_or(-1)});
    });
    std::sort(series.begin(), series.end(), [](const auto& a, const auto& b) { return a.uid < b.uid; });
    return series;
}

std::vector<std::string> findSeries(const Peer& peer, const std::string& study_uid, const std::string& modality,
                                    const std::string& our_ae_title, Progress& progress)
{
    std::vector<std::string> uids;
    for (const FoundSeries& series : describeSeries(peer, study_uid, our_ae_title, progress))
        if (modality.empty() || series.modality == modality)
            uids.push_back(series.uid);
    return uids;
}

std::vector<std::string> findObjects(const Peer& peer, const std::string& study_uid, const std::string& series_uid,
                                     const std::string& our_ae_title, Progress& progress)
{
    if (peer.web)
        return web::findObjects(peer, study_uid, series_uid, progress);
    DcmDataset keys;
    put(keys, DCM_QueryRetrieveLevel, "IMAGE");
    put(keys, DCM_StudyInstanceUID, study_uid);
    put(keys, DCM_SeriesInstanceUID, series_uid);
    askFor(keys, {DCM_SOPInstanceUID});
    std::vector<std::string> objects;
    find(peer, kStudyRoot, keys, our_ae_title, progress,
         [&](DcmDataset& match) { objects.push_back(Dataset(match).text(DCM_SOPInstanceUID)); });
    std::sort(objects.begin(), objects.end());
    return objects;
}

}  // namespace vicon::ingest
