#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/scpthrd.h>

#include <filesystem>
#include <string>

#include "caller_rules.h"
#include "incoming.h"
#include "vicon/ingest/receiver.h"

namespace vicon::ingest {

/// What every association of a receiver shares.
struct StorageService {
    const ReceiverOptions& options;
    const CallerRules& rules;
    Incoming& incoming;
    const Receiver::Handlers& handlers;
};

/// Serves one association: C-ECHO, C-STORE, and N-EVENT-REPORT of storage commitment.
class StorageAssociation : public DcmThreadSCP {
public:
    StorageAssociation(const StorageService& service, std::string host) : service_(service), host_(std::move(host)) {}

    /// Takes the association over. `crowded`: it is refused, because too many are served.
    void serve(T_ASC_Association* association, bool crowded);

protected:
    OFBool checkCalledAETitleAccepted(const OFString& called) override;
    OFBool checkCallingAETitleAccepted(const OFString& calling) override;
    OFCondition handleIncomingCommand(T_DIMSE_Message* message, const DcmPresentationContextInfo& context) override;

private:
    OFCondition takeReport(const T_DIMSE_N_EventReportRQ& request, const DcmPresentationContextInfo& context);
    Uint16 takeIn(const T_DIMSE_N_EventReportRQ& request, DcmDataset* dataset);
    OFCondition receive(T_DIMSE_C_StoreRQ& request, T_ASC_PresentationContextID context, Uint16& status);
    std::string sender() const;

    const StorageService& service_;
    std::string host_, calling_, refused_;
    std::filesystem::path folder_;
    int count_ = 0;
};

}  // namespace vicon::ingest
