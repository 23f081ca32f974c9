#include "vicon/ingest/sender.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/diutil.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "association.h"
#include "dataset.h"
#include "load_data.h"
#include "outcomes.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"
#include "web_peer.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr std::size_t kMostKinds = 60;  // an association has room for 128 contexts, a kind takes one or two
struct ObjectKind {
    std::string sop_class, transfer_syntax;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 means the 0 that such an operator is compared with
    friend auto operator<=>(const ObjectKind&, const ObjectKind&) = default;
};

struct Item {
    fs::path file;
    ObjectKind kind;
};

/// Whether VICON compressed it and may unpack it here. What came in, RLE as well, is decoded in the helper alone.
bool isPackedHere(const ObjectKind& kind)
{
    return kind.sop_class == UID_SecondaryCaptureImageStorage && kind.transfer_syntax == UID_RLELosslessTransferSyntax;
}

/// The transfer syntaxes that may carry an object, by presentation context: its own alone, so that a peer that takes it
/// gets it unchanged; then any uncompressed one, but for an object of a compression that is not undone here.
std::vector<OFList<OFString>> contextsFor(const ObjectKind& kind)
{
    std::vector<OFList<OFString>> contexts(1);
    contexts.front().push_back(kind.transfer_syntax.c_str());
    if (DcmXfer(kind.transfer_syntax.c_str()).isEncapsulated() && !isPackedHere(kind))
        return contexts;
    contexts.emplace_back();
    for (const char* other : {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax})
        if (kind.transfer_syntax != other)
            contexts.back().push_back(other);
    return contexts;
}

/// Reads what each file is; what cannot be read is a failure of that file.
std::vector<Item> readKinds(const std::vector<fs::path>& files, Outcomes& outcomes)
{
    std::vector<Item> items;
    for (const fs::path& file : files) {
        DcmFileFormat format;
        const OFCondition loaded = loadData(format, file, kLargestElementInMemory);
        const auto sop_class = Dataset(*format.getDataset()).values(DCM_SOPClassUID);
        if (loaded.bad() || sop_class.empty()) {
            outcomes.add({file, false, true, loaded.bad() ? loaded.text() : "it does not say its SOP Class"});
            continue;
        }
        items.push_back({file, {sop_class.front(), DcmXfer(format.getDataset()->getOriginalXfer()).getXferID()}});
    }
    return items;
}

std::string reasonFor(const OFCondition& sent, Uint16 status)
{
    if (sent.bad())
        return sent.text();
    char code[8];
    std::snprintf(code, sizeof code, "%04x", status);
    return std::string("the peer refused it (") + DU_cstoreStatusString(status) + ", status " + code + ")";
}

/// Sends the items of one association.
class Sending {
public:
    Sending(const Peer& peer, const std::string& title, Outcomes& outcomes, Progress& progress, std::size_t total)
        : peer_(peer), title_(title), outcomes_(outcomes), progress_(progress), total_(total)
    {
    }

    void send(const std::vector<Item>& items)
    {
        PeerScu scu;
        configure(scu, peer_, title_);
        scu.setDatasetConversionMode(OFTrue);
        std::set<ObjectKind> kinds;
        for (const Item& item : items)
            if (kinds.insert(item.kind).second)
                for (const auto& syntaxes : contextsFor(item.kind))
                    scu.addPresentationContext(item.kind.sop_class.c_str(), syntaxes);
        connect(scu, peer_);
        for (const Item& item : items) {
            progress_.check();
            sendOne(scu, item);
            progress_.report(double(++done_) / double(total_), "sending");
        }
        scu.releaseAssociation();
    }

private:
    void sendOne(PeerScu& scu, const Item& item)
    {
        T_ASC_PresentationContextID context = 0;
        for (const auto& syntaxes : contextsFor(item.kind))
            for (const OFString& syntax : syntaxes)
                if (context == 0)
                    context = scu.findPresentationContextID(item.kind.sop_class.c_str(), syntax);
        if (context == 0) {
            outcomes_.add({item.file, false, true,
                           "the peer takes neither this kind of object nor its encoding (" +
                               std::string(dcmFindNameOfUID(item.kind.sop_class.c_str(), "?")) + ", " +
                               DcmXfer(item.kind.transfer_syntax.c_str()).getXferName() + ")"});
            return;
        }
        Uint16 status = 0;
        const OFCondition sent = sendTo(scu, context, item.file, status);
        const bool taken = sent.good() && isTaken(status);
        outcomes_.add(
            {item.file, taken, !taken && sent.good() && isForGood(status), taken ? "" : reasonFor(sent, status)});
        if (sent.bad() && !scu.isConnected())
            peerFailed("the association broke after " + std::to_string(outcomes_.result.sent) + " objects", peer_,
                       sent);
    }

    /// DCMTK reads a file up to its last byte, and fails at what is no element.
    static OFCondition sendTo(PeerScu& scu, T_ASC_PresentationContextID context, const fs::path& file, Uint16& status)
    {
        if (!hasBytesBehindItsEnd(file))
            return scu.sendSTORERequest(context, file.c_str(), nullptr, status);
        DcmFileFormat format;
        if (const OFCondition loaded = loadData(format, file); loaded.bad())
            return loaded;
        return scu.sendSTORERequest(context, "", format.getDataset(), status);
    }

    const Peer& peer_;
    const std::string& title_;
    Outcomes& outcomes_;
    Progress& progress_;
    std::size_t total_;
    std::size_t done_ = 0;
};

}  // namespace

bool isTaken(unsigned status)
{
    constexpr unsigned kDuplicate = 0x0111;
    return status == STATUS_Success || DICOM_WARNING_STATUS(status) || status == kDuplicate;
}

bool isForGood(unsigned status)
{
    constexpr Uint16 kGroup = 0xff00, kDatasetMismatch = 0xa900, kCannotUnderstand = 0xc000, kFirstDigit = 0xf000;
    constexpr Uint16 kNotAuthorized = 0x0124, kNoSuchClass = 0x0122;
    return (status & kGroup) == kDatasetMismatch || (status & kFirstDigit) == kCannotUnderstand ||
           status == kNotAuthorized || status == kNoSuchClass;
}

SendResult storeFiles(const Peer& peer, const std::vector<fs::path>& files, const std::string& our_ae_title,
                      Progress& progress, const OnStored& on_stored)
{
    setUpDicom();
    if (peer.web)
        return web::storeFiles(peer, files, progress, on_stored);
    SendResult result;
    Outcomes outcomes{result, on_stored};
    const std::vector<Item> items = readKinds(files, outcomes);
    Sending sending(peer, our_ae_title, outcomes, progress, std::max<std::size_t>(items.size(), 1));
    // As many items as their kinds fit into one association.
    for (std::size_t from = 0; from < items.size();) {
        std::set<ObjectKind> kinds;
        std::size_t to = from;
        for (; to < items.size(); ++to) {
            kinds.insert(items[to].kind);
            if (kinds.size() > kMostKinds)
                break;
        }
        sending.send({items.begin() + std::ptrdiff_t(from), items.begin() + std::ptrdiff_t(to)});
        from = to;
    }
    return result;
}

void echo(const Peer& peer, const std::string& our_ae_title)
{
    if (peer.web)
        return web::echo(peer);
    setUpDicom();
    PeerScu scu;
    configure(scu, peer, our_ae_title);
    OFList<OFString> syntaxes;
    syntaxes.push_back(UID_LittleEndianImplicitTransferSyntax);
    scu.addPresentationContext(UID_VerificationSOPClass, syntaxes);
    connect(scu, peer);
    if (const OFCondition answered = scu.sendECHORequest(0); answered.bad())
        peerFailed("the peer does not answer C-ECHO", peer, answered);
    scu.releaseAssociation();
}

}  // namespace vicon::ingest
