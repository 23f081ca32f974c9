#include <algorithm>
#include <iterator>
#include <map>

#include "association.h"
#include "helper.h"
#include "image_classes.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/ingest/query.h"
#include "web_peer.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Slices, and what CT scanners put into series of modality CT for their dose pages.
std::vector<const char*> imageKinds()
{
    std::vector<const char*> kinds(kCtClasses.begin(), kCtClasses.end());
    kinds.insert(kinds.end(), kMrClasses.begin(), kMrClasses.end());
    kinds.push_back(UID_SecondaryCaptureImageStorage);
    return kinds;
}
/// What series of modality SR hold; import sets aside what is no measurement report.
const char* const kReports[] = {UID_Comprehensive3DSRStorage,  UID_ComprehensiveSRStorage, UID_EnhancedSRStorage,
                                UID_ExtensibleSRStorage,       UID_BasicTextSRStorage,     UID_ColonCADSRStorage,
                                UID_XRayRadiationDoseSRStorage};
const char* const kReportSyntaxes[] = {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax,
                                       UID_DeflatedExplicitVRLittleEndianTransferSyntax};
/// Each in a context of its own, so that a peer can send what it keeps as it keeps it.
const char* const kSyntaxes[] = {
    UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax,
    UID_BigEndianExplicitTransferSyntax,    UID_DeflatedExplicitVRLittleEndianTransferSyntax,
    UID_JPEGProcess14SV1TransferSyntax,     UID_JPEGProcess14TransferSyntax,
    UID_JPEGLSLosslessTransferSyntax,       UID_JPEG2000LosslessOnlyTransferSyntax,
    UID_RLELosslessTransferSyntax,          UID_JPEG2000TransferSyntax,
    UID_JPEGLSLossyTransferSyntax,          UID_JPEGProcess1TransferSyntax,
    UID_JPEGProcess2_4TransferSyntax};

/// C-GET and C-MOVE: tells of what has come, and stops when told to.
class Retrieving : public PeerScu {
public:
    Retrieving(Progress& progress, std::size_t series_done, std::size_t series)
        : progress_(progress), done_(series_done), series_(series)
    {
    }
    Uint16 last_status = 0;
    RetrieveResult result;

    OFCondition handleCGETResponse(const T_ASC_PresentationContextID context, RetrieveResponse* response,
                                   OFBool& go_on) override
    {
        note(context, *response);
        return DcmSCU::handleCGETResponse(context, response, go_on);
    }
    OFCondition handleMOVEResponse(const T_ASC_PresentationContextID context, RetrieveResponse* response,
                                   OFBool& go_on) override
    {
        note(context, *response);
        return DcmSCU::handleMOVEResponse(context, response, go_on);
    }

private:
    void note(T_ASC_PresentationContextID context, const RetrieveResponse& response)
    {
        last_status = response.m_status;
        result.completed = response.m_numberOfCompletedSubops + response.m_numberOfWarningSubops;
        result.failed = response.m_numberOfFailedSubops;
        const double all = result.completed + result.failed + response.m_numberOfRemainingSubops;
        const double here = all > 0 ? (result.completed + result.failed) / all : 0;
        progress_.report((double(done_) + here) / double(series_), "retrieving");
        if (progress_.cancelled())
            sendCANCELRequest(context);
    }

    Progress& progress_;
    std::size_t done_, series_;
};

void fillKeys(DcmDataset& keys, const std::string& study_uid, const std::string& series_uid)
{
    keys.putAndInsertString(DCM_QueryRetrieveLevel, "SERIES");
    keys.putAndInsertString(DCM_StudyInstanceUID, study_uid.c_str());
    keys.putAndInsertString(DCM_SeriesInstanceUID, series_uid.c_str());
}

/// Takes one series over an association of its own, so that one that fails leaves the others.
/// @param request sends the request in the context and returns how it went
template <class Prepare, class Request>
RetrieveResult retrieveOne(Retrieving& scu, const Peer& peer, const char* model, const std::string& our_ae_title,
                           Progress& progress, Prepare prepare, Request request)
{
    progress.check();
    configure(scu, peer, our_ae_title);
    OFList<OFString> syntaxes;
    for (const char* syntax : {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax})
        syntaxes.push_back(syntax);
    scu.addPresentationContext(model, syntaxes);
    prepare();
    connect(scu, peer);
    const auto context = scu.findPresentationContextID(model, "");
    if (context == 0)
        peerFailed("the peer does not offer this way of retrieving", peer, NET_EC_NoAcceptablePresentationContexts);
    const OFCondition done = request(context);
    progress.check();
    if (done.bad())
        peerFailed("the transfer broke off after " + std::to_string(scu.result.completed) + " objects", peer,
                   scu.reasonOf(done));
    // B000: some of the objects failed, which the counts tell.
    if (scu.last_status != STATUS_Success && !DICOM_WARNING_STATUS(scu.last_status)) {
        scu.result.failed = std::max(scu.result.failed, 1);
        scu.result.reasons.push_back(std::string("the peer refused a series (") +
                                     DU_cmoveStatusString(scu.last_status) + ")");
    }
    scu.releaseAssociation();
    return scu.result;
}

void offerAlone(PeerScu& scu, const char* kind, const char* syntax)
{
    OFList<OFString> alone;
    alone.push_back(syntax);
    scu.addPresentationContext(kind, alone, ASC_SC_ROLE_SCP);
}

void offerObjects(PeerScu& scu)
{
    for (const char* kind : imageKinds())
        for (const char* syntax : kSyntaxes)
            offerAlone(scu, kind, syntax);
    for (const char* kind : kReports)
        for (const char* syntax : kReportSyntaxes)
            offerAlone(scu, kind, syntax);
}

/// SOP Instance UIDs of what an earlier try left. The last one may be half there, and is removed.
std::set<std::string> objectsIn(const fs::path& folder)
{
    std::map<fs::path, fs::file_time_type> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files[entry.path()] = entry.last_write_time();
    const auto last =
        std::max_element(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (last != files.end()) {
        fs::remove(last->first);
        files.erase(last);
    }
    std::set<std::string> uids;
    for (const auto& [file, time] : files) {
        if (!whyNotToRead(file).empty())  // is asked for again
            continue;
        DcmMetaInfo meta;
        OFString uid;
        if (meta.loadFile(file.c_str()).good() && meta.findAndGetOFString(DCM_MediaStorageSOPInstanceUID, uid).good())
            uids.insert(uid.c_str());
    }
    return uids;
}

/// What to ask for: the whole series where nothing of it is here, else what is missing, some at a time.
std::vector<DcmDataset> requestsFor(const Peer& peer, const std::string& study_uid, const std::string& series_uid,
                                    const std::set<std::string>& here, const std::string& our_ae_title,
                                    Progress& progress)
{
    constexpr std::size_t kAtOnce = 100;  // a list of so many UIDs stays below the 64 kB of a short length
    std::vector<DcmDataset> requests(1);
    fillKeys(requests.front(), study_uid, series_uid);
    if (here.empty())
        return requests;
    const std::vector<std::string> objects = findObjects(peer, study_uid, series_uid, our_ae_title, progress);
    std::vector<std::string> missing;
    std::copy_if(objects.begin(), objects.end(), std::back_inserter(missing),
                 [&](const std::string& uid) { return !here.contains(uid); });
    if (missing.size() == objects.size() && !objects.empty())
        return requests;
    requests.clear();
    for (std::size_t from = 0; from < missing.size(); from += kAtOnce) {
        std::string uids;
        for (std::size_t n = from; n < std::min(from + kAtOnce, missing.size()); ++n)
            uids += (uids.empty() ? "" : "\\") + missing[n];
        DcmDataset& keys = requests.emplace_back();
        fillKeys(keys, study_uid, series_uid);
        keys.putAndInsertString(DCM_QueryRetrieveLevel, "IMAGE");
        keys.putAndInsertString(DCM_SOPInstanceUID, uids.c_str());
    }
    return requests;
}

void add(RetrieveResult& all, const RetrieveResult& one)
{
    all.completed += one.completed;
    all.failed += one.failed;
    all.reasons.insert(all.reasons.end(), one.reasons.begin(), one.reasons.end());
}

}  // namespace

RetrieveResult getSeries(const Peer& peer, const std::string& study_uid, const std::vector<std::string>& series_uids,
                         const fs::path& folder, const std::string& our_ae_title, Progress& progress,
                         const std::set<std::string>& have)
{
    setUpDicom();
    makePrivateFolder(folder);
    std::set<std::string> here = objectsIn(folder);
    here.insert(have.begin(), have.end());
    if (peer.web)
        return web::getSeries(peer, study_uid, series_uids, folder, here, progress);
    RetrieveResult all;
    for (std::size_t n = 0; n < series_uids.size(); ++n) {
        for (DcmDataset& keys : requestsFor(peer, study_uid, series_uids[n], here, our_ae_title, progress)) {
            Retrieving scu(progress, n, series_uids.size());
            scu.setStorageMode(DCMSCU_STORAGE_BIT_PRESERVING);
            scu.setStorageDir(folder.c_str());
            const RetrieveResult one = retrieveOne(
                scu, peer, UID_GETStudyRootQueryRetrieveInformationModel, our_ae_title, progress,
                [&] { offerObjects(scu); },
                [&](T_ASC_PresentationContextID context) { return scu.sendCGETRequest(context, &keys, nullptr); });
            add(all, one);
        }
    }
    return all;
}

RetrieveResult moveSeries(const Peer& peer, const std::string& study_uid, const std::vector<std::string>& series_uids,
                          const std::string& destination_ae_title, const std::string& our_ae_title, Progress& progress,
                          const std::set<std::string>& have)
{
    setUpDicom();
    if (peer.web)
        throw Error(ErrorCode::wrong_use, "by DICOMweb nothing is moved", nameOf(peer), "retrieve with --method get");
    RetrieveResult all;
    for (std::size_t n = 0; n < series_uids.size(); ++n) {
        for (DcmDataset& keys : requestsFor(peer, study_uid, series_uids[n], have, our_ae_title, progress)) {
            Retrieving scu(progress, n, series_uids.size());
            const RetrieveResult one = retrieveOne(
                scu, peer, UID_MOVEStudyRootQueryRetrieveInformationModel, our_ae_title, progress, [] {},
                [&](T_ASC_PresentationContextID context) {
                    return scu.sendMOVERequest(context, destination_ae_title.c_str(), &keys, nullptr);
                });
            add(all, one);
        }
    }
    return all;
}

}  // namespace vicon::ingest
