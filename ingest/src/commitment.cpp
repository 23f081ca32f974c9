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
std::optional<CommitmentReport> awaitAnswer(DcmSCU& scu, double wait_s)
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

}  // namespace

CommitmentRequest requestCommitment(const Peer& peer, const std::string& transaction_uid,
                                    const std::vector<ObjectName>& objects, const std::string& our_ae_title,
                                    double wait_s, std::optional<CommitmentReport>& answer)
{
    setUpDicom();
    DcmSCU scu;
    configure(scu, peer, our_ae_title);
    OFList<OFString> syntaxes;
    for (const char* syntax : {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax})
        syntaxes.push_back(syntax);
    scu.addPresentationContext(UID_StorageCommitmentPushModelSOPClass, syntaxes);
    if (const OFCondition opened = scu.initNetwork(); opened.bad())
        peerFailed("the network cannot be used", peer, opened);
    const OFCondition agreed = scu.negotiateAssociation();
    if (agreed == NET_EC_NoAcceptablePresentationContexts)
        return CommitmentRequest::not_offered;
    if (agreed.bad())
        peerFailed("no association with the peer", peer, agreed);
    const auto context = scu.findPresentationContextID(UID_StorageCommitmentPushModelSOPClass, "");
    DcmDataset request;
    fillRequest(request, transaction_uid, objects);
    Uint16 status = 0;
    const OFCondition asked =
        scu.sendACTIONRequest(context, UID_StorageCommitmentPushModelSOPInstance, kRequestCommitment, &request, status);
    if (asked.bad())
        peerFailed("the peer did not take the request for commitment", peer, asked);
    if (status != STATUS_Success) {
        char code[32];
        std::snprintf(code, sizeof code, "status %04x", status);
        peerFailed("the peer refused the request for commitment", peer,
                   makeOFCondition(OFM_dcmnet, status, OF_error, code));
    }
    answer = awaitAnswer(scu, wait_s);
    scu.releaseAssociation();
    return CommitmentRequest::taken;
}

}  // namespace vicon::ingest
