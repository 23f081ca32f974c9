#include "storage_association.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <string_view>

#include "commitment_dataset.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr Uint32 kPduBytes = 131072;  // the largest that DCMTK receives
constexpr Uint16 kOutOfResources = STATUS_STORE_Refused_OutOfResources;

/// In order of preference where a peer offers several at once: what is not compressed first, so that nobody compresses
/// for VICON; what loses nothing before what does.
const char* const kTransferSyntaxes[] = {
    UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax,
    UID_BigEndianExplicitTransferSyntax,    UID_DeflatedExplicitVRLittleEndianTransferSyntax,
    UID_JPEGProcess14SV1TransferSyntax,     UID_JPEGProcess14TransferSyntax,
    UID_JPEGLSLosslessTransferSyntax,       UID_JPEG2000LosslessOnlyTransferSyntax,
    UID_RLELosslessTransferSyntax,          UID_JPEG2000TransferSyntax,
    UID_JPEGLSLossyTransferSyntax,          UID_JPEGProcess2_4TransferSyntax,
    UID_JPEGProcess6_8TransferSyntax,       UID_JPEGProcess10_12TransferSyntax,
    UID_JPEGProcess1TransferSyntax};

/// A title as it may stand in a log.
std::string printable(std::string title)
{
    for (char& c : title)
        if (c < ' ' || c > '~')
            c = '?';
    return title;
}

/// Why the store takes no more objects; empty when it does. The sender is told before one of them fails half-way, or
/// lands in a folder that was made anew where the store was deleted.
std::string whyNoPlace(const fs::path& incoming)
{
    constexpr std::uintmax_t kLeastFree = 32U << 20U;
    if (!fs::exists(incoming / kReceiverLock))
        return "the store is gone";
    std::error_code unknown;
    const fs::space_info space = fs::space(incoming, unknown);
    return !unknown && space.available < kLeastFree ? "the store's disk is full" : "";
}

void refuseCrowded(T_ASC_Association* association)
{
    const T_ASC_RejectParameters busy{ASC_RESULT_REJECTEDTRANSIENT, ASC_SOURCE_SERVICEPROVIDER_PRESENTATION_RELATED,
                                      ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED};
    ASC_rejectAssociation(association, &busy);
    ASC_dropSCPAssociation(association);
    ASC_destroyAssociation(&association);
}

bool isStorage(const std::string_view sop_class)
{
    const char* const* const begin = dcmAllStorageSOPClassUIDs;
    return std::find(begin, begin + numberOfDcmAllStorageSOPClassUIDs, sop_class) !=
           begin + numberOfDcmAllStorageSOPClassUIDs;
}

/// What is taken of what the peer offers: DCMTK holds at most 128 contexts, and there are more storage classes.
DcmSCPConfig configFor(const ReceiverOptions& options, const T_ASC_Association& association)
{
    DcmSCPConfig config;
    config.setAETitle(options.ae_title.c_str());
    config.setMaxReceivePDULength(kPduBytes);
    config.setHostLookupEnabled(OFFalse);
    config.setDIMSEBlockingMode(DIMSE_NONBLOCKING);
    config.setDIMSETimeout(Uint32(options.timeout_s));
    config.setACSETimeout(Uint32(options.timeout_s));
    OFList<OFString> syntaxes;
    for (const char* syntax : kTransferSyntaxes)
        syntaxes.push_back(syntax);
    std::set<std::string> offered;
    for (int n = 0; n < ASC_countPresentationContexts(association.params); ++n) {
        T_ASC_PresentationContext context;
        if (ASC_getPresentationContext(association.params, n, &context).bad() ||
            !offered.insert(context.abstractSyntax).second)
            continue;
        if (isStorage(context.abstractSyntax) || std::string_view(context.abstractSyntax) == UID_VerificationSOPClass)
            config.addPresentationContext(context.abstractSyntax, syntaxes);
    }
    if (offered.contains(UID_StorageCommitmentPushModelSOPClass))  // an archive that reports is its provider
        config.addPresentationContext(UID_StorageCommitmentPushModelSOPClass, syntaxes, ASC_SC_ROLE_SCP);
    return config;
}

}  // namespace

std::string StorageAssociation::sender() const
{
    return "'" + printable(calling_) + "' at " + host_;
}

void StorageAssociation::serve(T_ASC_Association* association, bool crowded)
{
    calling_ = association->params->DULparams.callingAPTitle;
    if (crowded) {
        service_.incoming.trouble("refused " + sender() + ": too many associations are open");
        refuseCrowded(association);
        return;
    }
    const auto begin = std::chrono::steady_clock::now();
    folder_ = service_.incoming.open();
    setSharedConfig(DcmSharedSCPConfig(configFor(service_.options, *association)));
    run(association);
    service_.incoming.close(folder_);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.1f s", took.count());
    if (!refused_.empty())
        service_.incoming.trouble("refused " + sender() + ": " + refused_);
    else if (service_.handlers.on_note)
        service_.handlers.on_note("association of " + sender() + ": " + std::to_string(count_) + " objects in " +
                                  seconds);
}

OFBool StorageAssociation::checkCalledAETitleAccepted(const OFString& called)
{
    const bool ours = service_.options.any_called_title || called == service_.options.ae_title.c_str();
    if (!ours)
        refused_ = "it calls '" + printable(called.c_str()) + "', not us";
    return ours;
}

OFBool StorageAssociation::checkCallingAETitleAccepted(const OFString& calling)
{
    const bool known = service_.rules.allows(calling.c_str(), host_);
    if (!known)
        refused_ = "receive.allow does not name it";
    return known;
}

OFCondition StorageAssociation::handleIncomingCommand(T_DIMSE_Message* message,
                                                      const DcmPresentationContextInfo& context)
{
    if (message->CommandField == DIMSE_N_EVENT_REPORT_RQ)
        return takeReport(message->msg.NEventReportRQ, context);
    if (message->CommandField != DIMSE_C_STORE_RQ)
        return DcmThreadSCP::handleIncomingCommand(message, context);
    T_DIMSE_C_StoreRQ& request = message->msg.CStoreRQ;
    Uint16 status = STATUS_Success;
    const OFCondition received = receive(request, context.presentationContextID, status);
    if (received.bad())
        return received;
    return sendSTOREResponse(context.presentationContextID, request, status);
}

/// The report is taken in before it is answered with success: an archive that did not reach us reports again. DCMTK's
/// own answer leaves out what the request named, which Orthanc takes for an error.
OFCondition StorageAssociation::takeReport(const T_DIMSE_N_EventReportRQ& request,
                                           const DcmPresentationContextInfo& context)
{
    DcmDataset* received = nullptr;
    T_ASC_PresentationContextID id = context.presentationContextID;
    if (request.DataSetType != DIMSE_DATASET_NULL)
        if (const OFCondition came = receiveDIMSEDataset(&id, &received); came.bad())
            return came;
    const std::unique_ptr<DcmDataset> dataset(received);
    T_DIMSE_Message answer{};
    answer.CommandField = DIMSE_N_EVENT_REPORT_RSP;
    T_DIMSE_N_EventReportRSP& said = answer.msg.NEventReportRSP;
    said.MessageIDBeingRespondedTo = request.MessageID;
    OFStandard::strlcpy(said.AffectedSOPClassUID, request.AffectedSOPClassUID, sizeof said.AffectedSOPClassUID);
    OFStandard::strlcpy(said.AffectedSOPInstanceUID, request.AffectedSOPInstanceUID,
                        sizeof said.AffectedSOPInstanceUID);
    said.EventTypeID = request.EventTypeID;
    said.opts = O_NEVENTREPORT_AFFECTEDSOPCLASSUID | O_NEVENTREPORT_AFFECTEDSOPINSTANCEUID | O_NEVENTREPORT_EVENTTYPEID;
    said.DataSetType = DIMSE_DATASET_NULL;
    said.DimseStatus = takeIn(request, dataset.get());
    return sendDIMSEMessage(context.presentationContextID, &answer, nullptr);
}

Uint16 StorageAssociation::takeIn(const T_DIMSE_N_EventReportRQ& request, DcmDataset* dataset)
{
    if (!service_.handlers.on_commitment || !dataset ||
        std::string(request.AffectedSOPClassUID) != UID_StorageCommitmentPushModelSOPClass)
        return STATUS_N_NoSuchSOPClass;
    try {
        service_.handlers.on_commitment(commitmentReportFrom(*dataset));
        return STATUS_N_Success;
    } catch (const std::exception& e) {
        service_.incoming.trouble("a report on storage commitment of " + sender() + " was not taken: " + e.what());
        return STATUS_N_ProcessingFailure;
    }
}

OFCondition StorageAssociation::receive(T_DIMSE_C_StoreRQ& request, T_ASC_PresentationContextID context, Uint16& status)
{
    OFCondition received = EC_Normal;
    if (const std::string why = whyNoPlace(folder_.parent_path()); !why.empty()) {
        status = kOutOfResources;
        service_.incoming.trouble("an object of " + sender() + " was refused: " + why);
        return receiveSTORERequest(request, context, "/dev/null");
    }
    const fs::path file = folder_ / (std::to_string(count_) + ".dcm");
    struct NotReceived {};
    try {
        makePrivateFolder(folder_);
        replaceFile(file, [&](const fs::path& temporary) {
            received = receiveSTORERequest(request, context, OFString(temporary.c_str()));
            if (received.bad())
                throw NotReceived{};
        });
        service_.incoming.add(folder_, file);
        ++count_;
    } catch (const NotReceived&) {
        service_.incoming.trouble("an object of " + sender() + " was not received completely: " + received.text());
    } catch (const std::exception& e) {
        status = kOutOfResources;
        service_.incoming.trouble("an object of " + sender() + " was refused: " + e.what());
    }
    return received;
}

}  // namespace vicon::ingest
