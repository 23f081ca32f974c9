#include "vicon/ingest/commitment.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include "association.h"
#include "commitment_dataset.h"
#include "vicon/dicom/dicom_setup.h"

namespace vicon::ingest {
namespace {

/// The peer's answer, where it comes over the association that asked.
std::optional<CommitmentReport> awaitAnswer(PeerScu& scu, double wait_s)
{
    const int seconds = int(std::ceil(wait_s));
    if (seconds <= 0)
        return std::nullopt;
    DcmDataset* received = nullptr;
    Uint16 event = 0;
    const OFCondition came = scu.handleEVENTREPORTRequest(received, event, seconds);
    const std::unique_ptr<DcmDataset> dataset(received);
    if (came.bad() || !dataset)
        return std::nullopt;  // it comes over another association, or is asked for again
    return commitmentReportFrom(*dataset);
}

void offerCommitment(PeerScu& scu, T_ASC_SC_ROLE role)
{
    OFList<OFString> syntaxes;
    for (const char* syntax : {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax})
        syntaxes.push_back(syntax);
    scu.addPresentationContext(UID_StorageCommitmentPushModelSOPClass, syntaxes, role);
    // Some peers refuse the whole association when they take nothing of what is offered.
    scu.addPresentationContext(UID_VerificationSOPClass, syntaxes);
}

[[noreturn]] void refused(const std::string& what, const Peer& peer, Uint16 status)
{
    char code[32];
    std::snprintf(code, sizeof code, "status %04x", status);
    peerFailed(what, peer, makeOFCondition(OFM_dcmnet, status, OF_error, code));
}

}  // namespace

CommitmentRequest requestCommitment(const Peer& peer, const std::string& transaction_uid,
                                    const std::vector<ObjectName>& objects, const std::string& our_ae_title,
                                    double wait_s, std::optional<CommitmentReport>& answer)
{
    setUpDicom();
    PeerScu scu;
    configure(scu, peer, our_ae_title);
    offerCommitment(scu, ASC_SC_ROLE_DEFAULT);
    scu.useNetwork(peer);
    const OFCondition agreed = scu.negotiateAssociation();
    if (agreed == NET_EC_NoAcceptablePresentationContexts)
        return CommitmentRequest::not_offered;
    if (agreed.bad())
        peerFailed("no association with the peer", peer, agreed);
    const auto context = scu.findPresentationContextID(UID_StorageCommitmentPushModelSOPClass, "");
    if (context == 0) {
        scu.releaseAssociation();
        return CommitmentRequest::not_offered;
    }
    DcmDataset request;
    fillRequest(request, transaction_uid, objects);
    Uint16 status = 0;
    const OFCondition asked =
        scu.sendACTIONRequest(context, UID_StorageCommitmentPushModelSOPInstance, kRequestCommitment, &request, status);
    if (asked.bad())
        peerFailed("the peer did not take the request for commitment", peer, scu.reasonOf(asked));
    if (status != STATUS_Success)
        refused("the peer refused the request for commitment", peer, status);
    answer = awaitAnswer(scu, wait_s);
    scu.releaseAssociation();
    return CommitmentRequest::taken;
}

void reportCommitment(const Peer& peer, const CommitmentReport& report, const std::string& our_ae_title)
{
    setUpDicom();
    PeerScu scu;
    configure(scu, peer, our_ae_title);
    offerCommitment(scu, ASC_SC_ROLE_SCP);
    connect(scu, peer);
    const auto context = scu.findPresentationContextID(UID_StorageCommitmentPushModelSOPClass, "", ASC_SC_ROLE_SCP);
    if (context == 0)
        peerFailed("the peer takes no reports on storage commitment", peer, NET_EC_NoAcceptablePresentationContexts);
    DcmDataset dataset;
    const int event = fillReport(dataset, report);
    Uint16 status = 0;
    const OFCondition told =
        scu.sendEVENTREPORTRequest(context, UID_StorageCommitmentPushModelSOPInstance, Uint16(event), &dataset, status);
    if (told.bad())
        peerFailed("the peer did not take the report on its request for commitment", peer, scu.reasonOf(told));
    if (status != STATUS_Success)
        refused("the peer refused the report on its request for commitment", peer, status);
    scu.releaseAssociation();
}

}  // namespace vicon::ingest
