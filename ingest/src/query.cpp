#include "vicon/ingest/query.h"

#include <algorithm>
#include <functional>
#include <regex>
#include <tuple>

#include "association.h"
#include "dataset.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"

namespace vicon::ingest {
namespace {

void put(DcmDataset& keys, const DcmTagKey& tag, const std::string& value)
{
    if (const OFCondition done = keys.putAndInsertString(tag, value.c_str()); done.bad())
        throw Error(ErrorCode::wrong_use, std::string("the query cannot be written (") + done.text() + ")", value);
}

void askFor(DcmDataset& keys, std::initializer_list<DcmTagKey> tags)
{
    for (const DcmTagKey& tag : tags)
        if (!keys.tagExists(tag))
            keys.insertEmptyElement(tag);
}

/// A C-FIND that stops when told to, and hands every match over as it comes.
class Finding : public DcmSCU {
public:
    Finding(Progress& progress, std::function<void(DcmDataset&)> on_match)
        : progress_(progress), on_match_(std::move(on_match))
    {
    }
    Uint16 last_status = 0;

    OFCondition handleFINDResponse(const T_ASC_PresentationContextID context, QRResponse* response,
                                   OFBool& wait_for_next) override
    {
        last_status = response->m_status;
        if (response->m_dataset && DICOM_PENDING_STATUS(response->m_status))
            on_match_(*response->m_dataset);
        if (progress_.cancelled())
            sendCANCELRequest(context);
        return DcmSCU::handleFINDResponse(context, response, wait_for_next);
    }

private:
    Progress& progress_;
    std::function<void(DcmDataset&)> on_match_;
};

void find(const Peer& peer, DcmDataset& keys, const std::string& our_ae_title, Progress& progress,
          std::function<void(DcmDataset&)> on_match)
{
    setUpDicom();
    progress.check();
    Finding scu(progress, std::move(on_match));
    configure(scu, peer, our_ae_title);
    OFList<OFString> syntaxes;
    for (const char* syntax : {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax})
        syntaxes.push_back(syntax);
    scu.addPresentationContext(UID_FINDStudyRootQueryRetrieveInformationModel, syntaxes);
    connect(scu, peer);
    const auto context = scu.findPresentationContextID(UID_FINDStudyRootQueryRetrieveInformationModel, "");
    if (context == 0)
        peerFailed("the peer answers no queries of study root", peer, NET_EC_NoAcceptablePresentationContexts);
    const OFCondition answered = scu.sendFINDRequest(context, &keys, nullptr);
    progress.check();
    if (answered.bad())
        peerFailed("the query broke off", peer, answered);
    if (scu.last_status != STATUS_Success)
        peerFailed("the peer refused the query", peer,
                   makeOFCondition(OFM_dcmnet, scu.last_status, OF_error, DU_cfindStatusString(scu.last_status)));
    scu.releaseAssociation();
}

bool isDay(const std::string& date)
{
    const int month = std::stoi(date.substr(4, 2)), day = std::stoi(date.substr(6, 2));
    return month >= 1 && month <= 12 && day >= 1 && day <= 31;
}

/// A day or a range as DICOM writes it. Throws Error{wrong_use}.
std::string dicomDates(const std::string& text)
{
    if (text.empty())
        return {};
    static const std::regex kDates(R"((\d{4}-?\d{2}-?\d{2})?(-)?(\d{4}-?\d{2}-?\d{2})?)");
    std::smatch parts;
    const bool understood = std::regex_match(text, parts, kDates) && (parts[1].matched || parts[3].matched) &&
                            (parts[2].matched || !parts[1].matched || !parts[3].matched);
    std::string dates[2];
    for (const int n : {0, 1}) {
        dates[n] = understood ? parts[n == 0 ? 1 : 3].str() : "";
        std::erase(dates[n], '-');
    }
    if (!understood || (!dates[0].empty() && !isDay(dates[0])) || (!dates[1].empty() && !isDay(dates[1])))
        throw Error(ErrorCode::wrong_use, "neither a date nor a range of dates", "'" + text + "'",
                    "write 2024-01-10, or 2024-01-01-2024-01-31 with an end left out");
    return dates[0] + parts[2].str() + dates[1];
}

FoundStudy studyFrom(DcmDataset& match)
{
    const Dataset d(match);
    FoundStudy study;
    study.study_uid = d.raw(DCM_StudyInstanceUID);
    study.patient_id = d.text(DCM_PatientID);
    study.patient_name = d.personName(DCM_PatientName);
    study.birth_date = d.raw(DCM_PatientBirthDate);
    study.date = d.raw(DCM_StudyDate);
    study.time = d.raw(DCM_StudyTime);
    study.description = d.text(DCM_StudyDescription);
    study.accession_number = d.text(DCM_AccessionNumber);
    study.modalities = d.raw(DCM_ModalitiesInStudy);
    study.series = d.integer(DCM_NumberOfStudyRelatedSeries).value_or(-1);
    study.images = d.integer(DCM_NumberOfStudyRelatedInstances).value_or(-1);
    return study;
}

}  // namespace

std::vector<FoundStudy> findStudies(const Peer& peer, const StudyQuery& query, const std::string& our_ae_title,
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
    askFor(keys, {DCM_PatientBirthDate, DCM_StudyTime, DCM_StudyDescription, DCM_NumberOfStudyRelatedSeries,
                  DCM_NumberOfStudyRelatedInstances});
    std::vector<FoundStudy> studies;
    find(peer, keys, our_ae_title, progress, [&](DcmDataset& match) { studies.push_back(studyFrom(match)); });
    std::sort(studies.begin(), studies.end(), [](const FoundStudy& a, const FoundStudy& b) {
        return std::tie(a.date, a.time, a.study_uid) < std::tie(b.date, b.time, b.study_uid);
    });
    return studies;
}

std::vector<std::string> findSeries(const Peer& peer, const std::string& study_uid, const std::string& modality,
                                    const std::string& our_ae_title, Progress& progress)
{
    DcmDataset keys;
    put(keys, DCM_QueryRetrieveLevel, "SERIES");
    put(keys, DCM_StudyInstanceUID, study_uid);
    put(keys, DCM_Modality, modality);
    askFor(keys, {DCM_SeriesInstanceUID});
    std::vector<std::string> series;
    find(peer, keys, our_ae_title, progress, [&](DcmDataset& match) {
        const Dataset d(match);
        // A peer may ignore what it cannot match on.
        if (modality.empty() || d.raw(DCM_Modality) == modality)
            series.push_back(d.raw(DCM_SeriesInstanceUID));
    });
    std::sort(series.begin(), series.end());
    return series;
}

std::vector<std::string> findObjects(const Peer& peer, const std::string& study_uid, const std::string& series_uid,
                                     const std::string& our_ae_title, Progress& progress)
{
    DcmDataset keys;
    put(keys, DCM_QueryRetrieveLevel, "IMAGE");
    put(keys, DCM_StudyInstanceUID, study_uid);
    put(keys, DCM_SeriesInstanceUID, series_uid);
    askFor(keys, {DCM_SOPInstanceUID});
    std::vector<std::string> objects;
    find(peer, keys, our_ae_title, progress,
         [&](DcmDataset& match) { objects.push_back(Dataset(match).raw(DCM_SOPInstanceUID)); });
    std::sort(objects.begin(), objects.end());
    return objects;
}

}  // namespace vicon::ingest
