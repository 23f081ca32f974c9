#include "find.h"

#include <regex>

#include "association.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"

namespace vicon::ingest {
namespace {

/// More than anybody reads, or one study or day has; what a peer without an end would fill memory with.
constexpr int kMostMatches = 100'000;

/// A C-FIND that stops when told to, and hands every match over as it comes.
class Finding : public PeerScu {
public:
    Finding(Progress& progress, std::function<void(DcmDataset&)> on_match)
        : progress_(progress), on_match_(std::move(on_match))
    {
    }
    Uint16 last_status = 0;
    int matches = 0;

    OFCondition handleFINDResponse(const T_ASC_PresentationContextID context, QRResponse* response,
                                   OFBool& wait_for_next) override
    {
        last_status = response->m_status;
        if (DICOM_PENDING_STATUS(response->m_status) && ++matches > kMostMatches)
            return EC_IllegalCall;
        if (response->m_dataset && DICOM_PENDING_STATUS(response->m_status))
            on_match_(*response->m_dataset);
        if (progress_.cancelled())
            sendCANCELRequest(context);
        return DcmSCU::handleFINDResponse(context, response, wait_for_next);
    }

private:
    Progress& progress_;
    std::function<void(DcmDataset&)> on_match_;
};

bool isDay(const std::string& date)
{
    const int month = std::stoi(date.substr(4, 2)), day = std::stoi(date.substr(6, 2));
    return month >= 1 && month <= 12 && day >= 1 && day <= 31;
}

}  // namespace

bool isDicomDate(const std::string& date)
{
    constexpr std::size_t kDigits = 8;
    return date.size() == kDigits && date.find_first_not_of("0123456789") == std::string::npos && isDay(date);
}

void put(DcmItem& keys, const DcmTagKey& tag, const std::string& value)
{
    if (const OFCondition done = keys.putAndInsertString(tag, value.c_str()); done.bad())
        throw Error(ErrorCode::wrong_use, std::string("the query cannot be written (") + done.text() + ")", value);
}

void askFor(DcmItem& keys, std::initializer_list<DcmTagKey> tags)
{
    for (const DcmTagKey& tag : tags)
        if (!keys.tagExists(tag))
            keys.insertEmptyElement(tag);
}

std::string dicomDates(const std::string& text)
{
    if (text.empty())
        return {};
    static const std::regex kDates(R"((\d{4}-?\d{2}-?\d{2})?(-)?(\d{4}-?\d{2}-?\d{2})?)");
    std::smatch parts;
    const bool understood = std::regex_match(text, parts, kDates) && (parts[1].matched || parts[3].matched) &&
                            (parts[2].matched || !parts[1].matched || !parts[3].matched);
    std::string dates[2];
    for (const int n : {0, 1}) {
        dates[n] = understood ? parts[n == 0 ? 1 : 3].str() : "";
        std::erase(dates[n], '-');
    }
    if (!understood || (!dates[0].empty() && !isDay(dates[0])) || (!dates[1].empty() && !isDay(dates[1])))
        throw Error(ErrorCode::wrong_use, "neither a date nor a range of dates", "'" + text + "'",
                    "write 2024-01-10, or 2024-01-01-2024-01-31 with an end left out");
    return dates[0] + parts[2].str() + dates[1];
}

void find(const Peer& peer, const FindModel& model, DcmDataset& keys, const std::string& our_ae_title,
          Progress& progress, const std::function<void(DcmDataset&)>& on_match)
{
    setUpDicom();
    progress.check();
    Finding scu(progress, on_match);
    configure(scu, peer, our_ae_title);
    OFList<OFString> syntaxes;
    for (const char* syntax : {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax})
        syntaxes.push_back(syntax);
    scu.addPresentationContext(model.uid, syntaxes);
    connect(scu, peer);
    const auto context = scu.findPresentationContextID(model.uid, "");
    if (context == 0)
        peerFailed(model.without, peer, NET_EC_NoAcceptablePresentationContexts);
    const OFCondition answered = scu.sendFINDRequest(context, &keys, nullptr);
    progress.check();
    if (scu.matches > kMostMatches)
        throw Error(ErrorCode::peer, "more than " + std::to_string(kMostMatches) + " match", nameOf(peer),
                    "ask for less at a time, as by dates");
    if (answered.bad())
        peerFailed("the query broke off", peer, scu.reasonOf(answered));
    if (scu.last_status != STATUS_Success)
        peerFailed("the peer refused the query", peer,
                   makeOFCondition(OFM_dcmnet, scu.last_status, OF_error, DU_cfindStatusString(scu.last_status)));
    scu.releaseAssociation();
}

}  // namespace vicon::ingest
