#include "association_services.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "association.h"
#include "commitment_desk.h"

namespace vicon::ingest {
namespace {

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

/// Of messages that are read as they come: what is deflated grows then, and must not.
const char* const kMessageSyntaxes[] = {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax,
                                        UID_BigEndianExplicitTransferSyntax};

bool isStorage(const std::string_view sop_class)
{
    const char* const* const begin = dcmAllStorageSOPClassUIDs;
    return std::find(begin, begin + numberOfDcmAllStorageSOPClassUIDs, sop_class) !=
           begin + numberOfDcmAllStorageSOPClassUIDs;
}

}  // namespace

std::string printableTitle(std::string title)
{
    for (char& c : title)
        if (c < ' ' || c > '~')
            c = '?';
    return title;
}

// DCMTK holds at most 128 contexts, and there are more storage classes.
Services servicesFor(const StorageService& service, const Peer* peer, const T_ASC_Association& association)
{
    const ReceiverOptions& options = service.options;
    const bool stores = !peer || peer->stores, is_sent = !peer || peer->is_sent;
    Services out;
    DcmSCPConfig& config = out.config;
    config.setAETitle(options.ae_title.c_str());
    config.setMaxReceivePDULength(kPduBytes);
    config.setHostLookupEnabled(OFFalse);
    config.setDIMSEBlockingMode(DIMSE_NONBLOCKING);
    config.setDIMSETimeout(Uint32(options.timeout_s));
    config.setACSETimeout(Uint32(options.timeout_s));
    OFList<OFString> syntaxes;
    for (const char* syntax : kTransferSyntaxes)
        syntaxes.push_back(syntax);
    OFList<OFString> plain;
    for (const char* syntax : kMessageSyntaxes)
        plain.push_back(syntax);
    std::set<std::string> offered;
    bool would_store = false;
    for (int n = 0; n < ASC_countPresentationContexts(association.params); ++n) {
        T_ASC_PresentationContext context;
        if (ASC_getPresentationContext(association.params, n, &context).bad() ||
            !offered.insert(context.abstractSyntax).second)
            continue;
        const std::string_view service_class = context.abstractSyntax;
        would_store = would_store || isStorage(service_class);
        if (service_class == UID_VerificationSOPClass || (stores && isStorage(service_class))) {
            config.addPresentationContext(context.abstractSyntax, syntaxes);
            out.none = false;
        }
        if (service_class != UID_StorageCommitmentPushModelSOPClass)
            continue;
        // An archive that reports is the provider; who asks for a commitment, the user.
        const bool reports = context.proposedRole == ASC_SC_ROLE_SCP || context.proposedRole == ASC_SC_ROLE_SCUSCP;
        if (reports ? is_sent : stores && service.desk.isOpen()) {
            config.addPresentationContext(context.abstractSyntax, plain,
                                          reports ? context.proposedRole : ASC_SC_ROLE_DEFAULT);
            out.none = false;
        }
    }
    if (out.none)  // without any, DCMTK would not answer at all
        config.addPresentationContext(UID_VerificationSOPClass, syntaxes);
    if (would_store && !stores)
        out.why_not_stored = "the roles of peer " + peer->name + " do not let it store";
    return out;
}

std::string servicesNotGranted(const T_ASC_Association& association)
{
    constexpr std::size_t kMostNamed = 3;
    std::set<std::string> granted, asked;
    for (int n = 0; n < ASC_countPresentationContexts(association.params); ++n) {
        T_ASC_PresentationContext context;
        if (ASC_getPresentationContext(association.params, n, &context).good())
            (context.resultReason == ASC_P_ACCEPTANCE ? granted : asked).insert(context.abstractSyntax);
    }
    std::erase_if(asked, [&](const std::string& service) { return granted.contains(service); });
    std::string names;
    std::size_t count = 0;
    for (const std::string& service : asked)
        if (++count <= kMostNamed)
            names += (count == 1 ? "" : ", ") + printableTitle(dcmFindNameOfUID(service.c_str(), service.c_str()));
    return names + (count > kMostNamed ? " and " + std::to_string(count - kMostNamed) + " more" : "");
}

}  // namespace vicon::ingest
