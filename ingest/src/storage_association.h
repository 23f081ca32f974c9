#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/scpthrd.h>

#include <filesystem>
#include <memory>
#include <string>

#include "caller_rules.h"
#include "incoming.h"
#include "message_watch.h"
#include "pace.h"
#include "vicon/ingest/receiver.h"

namespace vicon::ingest {

class CommitmentDesk;

/// What every association of a receiver shares.
struct StorageService {
    const ReceiverOptions& options;
    const CallerRules& rules;
    Incoming& incoming;
    CommitmentDesk& desk;
    Pace& pace;
    const Receiver::Handlers& handlers;
    ReceiverCounts& counts;
};

/// What a peer may have of what it asks for.
struct Services {
    DcmSCPConfig config;
    bool none = true;
    std::string why_not_stored;  ///< it asks to, and its roles do not let it; else empty
};

/// Serves one association: C-ECHO, C-STORE, and storage commitment, asked for or reported.
class StorageAssociation : public DcmThreadSCP {
public:
    struct From {
        std::string host;
        int socket;
        bool secure;       ///< it came by TLS
        const Peer* peer;  ///< who it is by the configuration; null: nobody that it knows
        Pace* pace;        ///< the peer's own; may be null
        std::shared_ptr<const MessageWatch> watch;
    };
    StorageAssociation(const StorageService& service, From from) : service_(service), from_(std::move(from)) {}

    /// Takes the association over. `crowded`: it is refused, because too many are served.
    void serve(T_ASC_Association* association, bool crowded);

protected:
    OFBool checkCalledAETitleAccepted(const OFString& called) override;
    OFBool checkCallingAETitleAccepted(const OFString& calling) override;
    void refuseAssociation(DcmRefuseReasonType reason) override;
    void notifyAssociationAcknowledge() override;
    void notifyRECEIVEProgress(unsigned long bytes) override;
    OFCondition handleIncomingCommand(T_DIMSE_Message* message, const DcmPresentationContextInfo& context) override;

private:
    /// Nothing where the message has none.
    OFCondition receiveDataset(T_DIMSE_DataSetType type, T_ASC_PresentationContextID& id,
                               std::unique_ptr<DcmDataset>& dataset);
    OFCondition takeReport(const T_DIMSE_N_EventReportRQ& request, const DcmPresentationContextInfo& context);
    Uint16 takeIn(const T_DIMSE_N_EventReportRQ& request, DcmDataset* dataset);
    OFCondition takeDemand(const T_DIMSE_N_ActionRQ& request, const DcmPresentationContextInfo& context);
    Uint16 takeIn(const T_DIMSE_N_ActionRQ& request, DcmDataset* dataset, CommitmentDemand& demand,
                  std::string& number);
    bool awaitsAnswer() const;
    bool reportHere(T_ASC_PresentationContextID context, const CommitmentDemand& demand, const std::string& number,
                    OFCondition& over);
    std::string whyNoPlace() const;
    void endWithoutRoom(unsigned long bytes);
    OFCondition drain(T_DIMSE_C_StoreRQ& request, T_ASC_PresentationContextID context);
    OFCondition receive(T_DIMSE_C_StoreRQ& request, T_ASC_PresentationContextID context, Uint16& status);
    std::string sender() const;
    void tellOfEnd(double took_s);

    const StorageService& service_;
    const From from_;
    std::string calling_, refused_, not_granted_;
    Services services_;
    T_ASC_Association* association_ = nullptr;
    unsigned long bytes_ = 0;  ///< of the message that is being received
    std::filesystem::path folder_;
    int count_ = 0;
};

}  // namespace vicon::ingest
