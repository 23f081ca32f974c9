// Storage commitment over an association that a peer opened: its requests, and its reports on ours.
#include <poll.h>

#include <memory>

#include "commitment_dataset.h"
#include "commitment_desk.h"
#include "storage_association.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

/// A peer that goes on, or ends the association, does so at once; one that is silent waits for the answer.
constexpr int kSilenceMilliseconds = 300;
constexpr Uint16 kFirstMessage = 1;

bool isPushModel(const std::string& sop_class)
{
    return sop_class == UID_StorageCommitmentPushModelSOPClass;
}

}  // namespace

OFCondition StorageAssociation::receiveDataset(T_DIMSE_DataSetType type, T_ASC_PresentationContextID& id,
                                               std::unique_ptr<DcmDataset>& dataset)
{
    if (type == DIMSE_DATASET_NULL)
        return EC_Normal;
    DcmDataset* received = nullptr;
    const OFCondition came = receiveDIMSEDataset(&id, &received);
    dataset.reset(received);
    return came;
}

/// The report is taken in before it is answered with success: an archive that did not reach us reports again. DCMTK's
/// own answer leaves out what the request named, which Orthanc takes for an error.
OFCondition StorageAssociation::takeReport(const T_DIMSE_N_EventReportRQ& request,
                                           const DcmPresentationContextInfo& context)
{
    T_ASC_PresentationContextID id = context.presentationContextID;
    std::unique_ptr<DcmDataset> dataset;
    if (const OFCondition came = receiveDataset(request.DataSetType, id, dataset); came.bad())
        return came;
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
    if (!service_.handlers.on_commitment || !dataset || !isPushModel(request.AffectedSOPClassUID))
        return STATUS_N_NoSuchSOPClass;
    try {
        service_.handlers.on_commitment(commitmentReportFrom(*dataset));
        return STATUS_N_Success;
    } catch (const std::exception& e) {
        service_.incoming.trouble("a report on storage commitment of " + sender() + " was not taken: " + e.what());
        return STATUS_N_ProcessingFailure;
    }
}

OFCondition StorageAssociation::takeDemand(const T_DIMSE_N_ActionRQ& request, const DcmPresentationContextInfo& context)
{
    T_ASC_PresentationContextID id = context.presentationContextID;
    std::unique_ptr<DcmDataset> dataset;
    if (const OFCondition came = receiveDataset(request.DataSetType, id, dataset); came.bad())
        return came;
    CommitmentDemand demand;
    std::string number;
    const Uint16 status = takeIn(request, dataset.get(), demand, number);
    const OFCondition answered = sendACTIONResponse(id, request.MessageID, request.RequestedSOPClassUID,
                                                    request.RequestedSOPInstanceUID, status);
    if (number.empty())
        return answered;
    OFCondition over = answered;
    if (answered.bad() || !awaitsAnswer() || !reportHere(id, demand, number, over))
        service_.desk.putBack(number);
    return over;
}

Uint16 StorageAssociation::takeIn(const T_DIMSE_N_ActionRQ& request, DcmDataset* dataset, CommitmentDemand& demand,
                                  std::string& number)
{
    if (!isPushModel(request.RequestedSOPClassUID) || !service_.desk.isOpen())
        return STATUS_N_NoSuchSOPClass;
    if (std::string(request.RequestedSOPInstanceUID) != UID_StorageCommitmentPushModelSOPInstance)
        return STATUS_N_NoSuchSOPInstance;
    if (request.ActionTypeID != kRequestCommitment)
        return STATUS_N_NoSuchAction;
    try {
        if (!dataset)
            return STATUS_N_InvalidArgumentValue;
        demand = commitmentDemandFrom(*dataset);
        if (!isStoreOf(folder_.parent_path()))
            throw Error(ErrorCode::store, kStoreIsGone);
        number = service_.desk.take(calling_, from_.host, demand);
        return STATUS_N_Success;
    } catch (const Error& e) {
        service_.incoming.trouble("a request for commitment of " + sender() + " was refused: " + e.what());
        return e.code() == ErrorCode::bad_input   ? STATUS_N_InvalidArgumentValue
               : e.code() == ErrorCode::no_memory ? STATUS_N_ResourceLimitation
                                                  : STATUS_N_ProcessingFailure;
    } catch (const std::exception& e) {
        service_.incoming.trouble("a request for commitment of " + sender() + " was refused: " + e.what());
        return STATUS_N_ProcessingFailure;
    }
}

bool StorageAssociation::awaitsAnswer() const
{
    if (ASC_dataWaiting(association_, 0))
        return false;
    pollfd watched{from_.socket, POLLIN | POLLRDHUP, 0};
    return ::poll(&watched, 1, kSilenceMilliseconds) == 0;
}

/// @param over how it went with the association
bool StorageAssociation::reportHere(T_ASC_PresentationContextID context, const CommitmentDemand& demand,
                                    const std::string& number, OFCondition& over)
{
    try {
        const CommitmentReport report = service_.desk.answer(demand);
        DcmDataset dataset;
        const int event = fillReport(dataset, report);
        Uint16 status = 0;
        over = sendEVENTREPORTRequest(context, UID_StorageCommitmentPushModelSOPInstance, kFirstMessage, Uint16(event),
                                      &dataset, status);
        if (over.bad() || status != STATUS_Success)
            return false;
        service_.desk.close(number);
        return true;
    } catch (const std::exception& e) {
        service_.incoming.trouble("a request for commitment of " + sender() + " waits: " + e.what());
        return false;
    }
}

}  // namespace vicon::ingest
