#include "storage_association.h"

#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "association_services.h"
#include "kept_name.h"
#include "structure_scan.h"
#include "study_key.h"
#include "vicon/core/file.h"
#include "vicon/core/temporary_folder.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr Uint16 kOutOfResources = STATUS_STORE_Refused_OutOfResources;

/// What is wrong with an object that was received: the status to answer with, and why.
struct Fault {
    Uint16 status = STATUS_Success;
    std::string why;
};

/// What import could not take under this name is refused at once, so that its sender knows.
Fault faultOf(const fs::path& file, const ObjectUids& uids, const T_DIMSE_C_StoreRQ& request)
{
    const Structure structure = scanStructure(file);
    if (structure.fate == Structure::Fate::refused)
        return {STATUS_STORE_Error_CannotUnderstand, structure.why};
    const bool deflated = structure.fate == Structure::Fate::odd && uids.object.empty();
    if (!deflated && uids.object != request.AffectedSOPInstanceUID)
        return {STATUS_STORE_Error_DataSetDoesNotMatchSOPClass, "its SOP Instance UID is not what was announced"};
    if (!uids.sop_class.empty() && uids.sop_class != request.AffectedSOPClassUID)
        return {STATUS_STORE_Error_DataSetDoesNotMatchSOPClass, "its SOP Class UID is not what was announced"};
    return {};
}

bool isFull(const fs::path& incoming)
{
    constexpr std::uintmax_t kLeastFree = 32U << 20U;
    std::error_code unknown;
    const fs::space_info space = fs::space(incoming, unknown);
    return !unknown && space.available < kLeastFree;
}

/// Where an object goes that is not kept. DCMTK removes the file that it could not fill: this link, not the device.
class Nowhere {
public:
    /// Throws Error{store}, std::filesystem::filesystem_error.
    Nowhere() : folder_(makeTemporaryFolder("vicon-nowhere-", ErrorCode::store))
    {
        fs::create_symlink("/dev/null", file());
    }
    ~Nowhere()
    {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    Nowhere(const Nowhere&) = delete;
    Nowhere& operator=(const Nowhere&) = delete;
    fs::path file() const { return folder_ / "object"; }

private:
    const fs::path folder_;
};

void refuseCrowded(T_ASC_Association* association)
{
    const T_ASC_RejectParameters busy{ASC_RESULT_REJECTEDTRANSIENT, ASC_SOURCE_SERVICEPROVIDER_PRESENTATION_RELATED,
                                      ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED};
    ASC_rejectAssociation(association, &busy);
    ASC_dropSCPAssociation(association);
    ASC_destroyAssociation(&association);
}

}  // namespace

std::string StorageAssociation::sender() const
{
    return "'" + printableTitle(calling_) + "' at " + from_.host;
}

void StorageAssociation::serve(T_ASC_Association* association, bool crowded)
{
    calling_ = association->params->DULparams.callingAPTitle;
    if (crowded) {
        ++service_.counts.refused_associations;
        service_.incoming.trouble("refused " + sender() + ": too many associations are open");
        refuseCrowded(association);
        return;
    }
    const auto begin = std::chrono::steady_clock::now();
    association_ = association;
    folder_ = service_.incoming.open(sender());
    services_ = servicesFor(service_, from_.peer, *association);
    setSharedConfig(DcmSharedSCPConfig(services_.config));
    try {
        run(association);
    } catch (const std::exception& e) {
        service_.incoming.trouble("an association from " + sender() + " was ended: " + e.what());
    }
    service_.incoming.close(folder_);
    tellOfEnd(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

void StorageAssociation::tellOfEnd(double took_s)
{
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.1f s", took_s);
    const std::string why = !refused_.empty()                   ? refused_
                            : !services_.why_not_stored.empty() ? services_.why_not_stored
                            : services_.none                    ? "it asks for nothing that it may have here"
                                                                : "";
    if (!from_.watch->whyEnded().empty())
        service_.incoming.trouble("an association from " + sender() + " was ended: " + from_.watch->whyEnded());
    ++(why.empty() ? service_.counts.associations : service_.counts.refused_associations);
    if (!why.empty()) {
        const std::string line = "refused " + sender() + ": " + why;
        service_.incoming.trouble(line);
        if (service_.handlers.on_refused)
            service_.handlers.on_refused(from_.host, line);
    } else if (service_.handlers.on_note)
        service_.handlers.on_note("association of " + sender() + ": " + std::to_string(count_) + " objects in " +
                                  seconds + (not_granted_.empty() ? "" : "; not served: " + not_granted_));
}

OFBool StorageAssociation::checkCalledAETitleAccepted(const OFString& called)
{
    const bool ours = service_.options.any_called_title || called == service_.options.ae_title.c_str();
    if (!ours)
        refused_ = "it calls '" + printableTitle(called.c_str()) + "', not us";
    return ours;
}

OFBool StorageAssociation::checkCallingAETitleAccepted(const OFString& calling)
{
    refused_ = service_.rules.whyRefused(calling.c_str(), from_.host);
    if (refused_.empty() && from_.peer && from_.peer->tls && !from_.secure)
        refused_ = "it is configured to speak TLS, and does not";
    if (refused_.empty() && services_.none)  // without this, DCMTK would give no reason
        refused_ = services_.why_not_stored;
    return refused_.empty();
}

/// Who asks for nothing that it may have is told so context by context, and takes its leave. A rejection would give no
/// reason.
void StorageAssociation::refuseAssociation(const DcmRefuseReasonType reason)
{
    if (reason != DCMSCP_NO_PRESENTATION_CONTEXTS)
        return DcmThreadSCP::refuseAssociation(reason);
    refused_ = "it asks for nothing that it may have here: " + servicesNotGranted(*association_);
    if (ASC_acknowledgeAssociation(association_).good())
        handleAssociation();
}

void StorageAssociation::notifyAssociationAcknowledge()
{
    not_granted_ = servicesNotGranted(*association_);
}

/// Called for every block of a data set.
void StorageAssociation::notifyRECEIVEProgress(const unsigned long bytes)
{
    constexpr unsigned long kLook = 64UL << 20U;
    const std::size_t more = bytes - std::min(bytes, bytes_);
    if (bytes / kLook > bytes_ / kLook)
        endWithoutRoom(bytes);
    bytes_ = bytes;
    service_.pace.take(more);
    if (from_.pace)
        from_.pace->take(more);
}

/// Nobody's object keeps the disk full for all others while it comes. What does not fit is drained for a while, so that
/// an honest sender hears why.
void StorageAssociation::endWithoutRoom(unsigned long bytes)
{
    constexpr unsigned long kLargest = 4UL << 30U, kDrained = 1UL << 30U;
    if (bytes < kDrained || (bytes < kLargest && !isFull(folder_.parent_path())))
        return;
    ::shutdown(from_.socket, SHUT_RD);
    service_.incoming.trouble("an object of " + sender() + " was ended after " + std::to_string(bytes >> 20U) +
                              " MB: " + (bytes < kLargest ? "the store's disk is full" : "no object is so large"));
}

OFCondition StorageAssociation::handleIncomingCommand(T_DIMSE_Message* message,
                                                      const DcmPresentationContextInfo& context)
{
    bytes_ = 0;
    if (message->CommandField == DIMSE_N_EVENT_REPORT_RQ)
        return takeReport(message->msg.NEventReportRQ, context);
    if (message->CommandField == DIMSE_N_ACTION_RQ)
        return takeDemand(message->msg.NActionRQ, context);
    if (message->CommandField != DIMSE_C_STORE_RQ)
        return DcmThreadSCP::handleIncomingCommand(message, context);
    T_DIMSE_C_StoreRQ& request = message->msg.CStoreRQ;
    Uint16 status = STATUS_Success;
    const OFCondition received = receive(request, context.presentationContextID, status);
    if (received.bad())
        return received;
    return sendSTOREResponse(context.presentationContextID, request, status);
}

/// Why the store takes no more objects of this peer; empty when it does. The sender is told before one of them fails
/// half-way, or lands in a folder that was made anew where the store was deleted.
std::string StorageAssociation::whyNoPlace() const
{
    const fs::path incoming = folder_.parent_path();
    if (!isStoreOf(incoming))
        return kStoreIsGone;
    if (isFull(incoming))
        return "the store's disk is full";
    return service_.incoming.waitingOf(sender()) >= service_.options.max_waiting
               ? "receive.max_waiting of its objects wait for the import"
               : "";
}

OFCondition StorageAssociation::drain(T_DIMSE_C_StoreRQ& request, T_ASC_PresentationContextID context)
{
    try {
        const Nowhere nowhere;
        return receiveSTORERequest(request, context, OFString(nowhere.file().c_str()));
    } catch (const std::exception&) {  // no place for a link either: the association ends
        return DIMSE_OUTOFRESOURCES;
    }
}

OFCondition StorageAssociation::receive(T_DIMSE_C_StoreRQ& request, T_ASC_PresentationContextID context, Uint16& status)
{
    OFCondition received = EC_Normal;
    if (const std::string why = whyNoPlace(); !why.empty()) {
        status = kOutOfResources;
        ++service_.counts.refused_objects;
        service_.incoming.trouble("an object of " + sender() + " was refused: " + why);
        return drain(request, context);
    }
    const std::string name = keptNameOf(request.AffectedSOPInstanceUID) + "-" + std::to_string(count_) + ".dcm";
    const fs::path temporary = folder_ / (std::string(kTemporaryPrefix) + name);
    Fault fault;
    ObjectUids uids;
    try {
        makePrivateFolder(folder_);
        received = receiveSTORERequest(request, context, OFString(temporary.c_str()));
        if (received == DIMSE_OUTOFRESOURCES) {  // all of it came, but not all could be written
            received = EC_Normal;
            fault = {kOutOfResources, "was refused: it has no room on the store's disk"};
        } else if (received.bad()) {
            fault.why = std::string("was not received completely: ") + received.text();
        } else if (fault = faultOf(temporary, uids = uidsOf(temporary), request); fault.status != STATUS_Success) {
            if (const std::string why = whyNoPlace(); !why.empty())  // its end may be missing for that
                fault = {kOutOfResources, why};
            fault.why = "was refused: " + fault.why;
        } else {
            service_.incoming.add(folder_, temporary, folder_ / name, uids.study);
        }
    } catch (const std::exception& e) {
        fault = {kOutOfResources, std::string("was refused: ") + e.what()};
    }
    status = fault.status;
    if (fault.why.empty()) {
        ++count_;
        ++service_.counts.objects;
        service_.counts.last_object_s =
            std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
        return received;
    }
    ++service_.counts.refused_objects;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    service_.incoming.trouble("an object of " + sender() + " " + fault.why);
    return received;
}

}  // namespace vicon::ingest
