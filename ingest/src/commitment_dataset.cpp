#include "commitment_dataset.h"

#include <cstdio>
#include <set>
#include <string>
#include <utility>

#include "vicon/core/error.h"
#include "vicon/ingest/query.h"

namespace vicon::ingest {
namespace {

/// Each is looked for and hashed: a study of the largest scans has a tenth.
constexpr std::size_t kMostObjects = 50000;

std::string textIn(DcmItem& item, const DcmTagKey& tag)
{
    OFString text;
    item.findAndGetOFString(tag, text);
    return text.c_str();
}

ObjectName nameIn(DcmItem& item)
{
    return {textIn(item, DCM_ReferencedSOPClassUID), textIn(item, DCM_ReferencedSOPInstanceUID)};
}

template <class Use>
void forEachItem(DcmDataset& dataset, const DcmTagKey& tag, Use use)
{
    DcmSequenceOfItems* sequence = nullptr;
    if (dataset.findAndGetSequence(tag, sequence).bad() || !sequence)
        return;
    for (DcmObject* next = sequence->nextInContainer(nullptr); next; next = sequence->nextInContainer(next))
        use(static_cast<DcmItem&>(*next));
}

DcmItem& append(DcmDataset& dataset, const DcmTagKey& sequence, const ObjectName& object)
{
    constexpr long kAppend = -2;
    DcmItem* item = nullptr;
    if (dataset.findOrCreateSequenceItem(sequence, item, kAppend).bad())
        throw Error(ErrorCode::no_memory, "a message on storage commitment cannot be written");
    item->putAndInsertString(DCM_ReferencedSOPClassUID, object.sop_class.c_str());
    item->putAndInsertString(DCM_ReferencedSOPInstanceUID, object.sop_uid.c_str());
    return *item;
}

}  // namespace

void fillRequest(DcmDataset& dataset, const std::string& transaction_uid, const std::vector<ObjectName>& objects)
{
    dataset.putAndInsertString(DCM_TransactionUID, transaction_uid.c_str());
    for (const ObjectName& object : objects)
        append(dataset, DCM_ReferencedSOPSequence, object);
}

int fillReport(DcmDataset& dataset, const CommitmentReport& report)
{
    fillRequest(dataset, report.transaction_uid, report.committed);
    for (const CommitmentReport::Failed& failed : report.failed)
        append(dataset, DCM_FailedSOPSequence, failed.object)
            .putAndInsertUint16(DCM_FailureReason, Uint16(failed.reason));
    return report.failed.empty() ? kAllCommitted : kSomeFailed;
}

CommitmentDemand commitmentDemandFrom(DcmDataset& dataset)
{
    CommitmentDemand demand{textIn(dataset, DCM_TransactionUID), {}};
    std::set<std::pair<std::string, std::string>> named;
    forEachItem(dataset, DCM_ReferencedSOPSequence, [&](DcmItem& item) {
        ObjectName object = nameIn(item);
        if (!isLikeUid(object.sop_class) || !isLikeUid(object.sop_uid))
            throw Error(ErrorCode::bad_input, "a request for commitment names an object by what is no UID");
        if (named.emplace(object.sop_class, object.sop_uid).second)
            demand.objects.push_back(std::move(object));
        if (named.size() > kMostObjects)
            throw Error(ErrorCode::no_memory,
                        "a request for commitment names more than " + std::to_string(kMostObjects) + " objects");
    });
    if (!isLikeUid(demand.transaction_uid) || demand.objects.empty())
        throw Error(ErrorCode::bad_input, "a request for commitment names no transaction or no object");
    return demand;
}

CommitmentReport commitmentReportFrom(DcmDataset& dataset)
{
    CommitmentReport report;
    report.transaction_uid = textIn(dataset, DCM_TransactionUID);
    if (report.transaction_uid.empty())
        throw Error(ErrorCode::bad_input, "a report on storage commitment names no transaction");
    forEachItem(dataset, DCM_ReferencedSOPSequence, [&](DcmItem& item) { report.committed.push_back(nameIn(item)); });
    forEachItem(dataset, DCM_FailedSOPSequence, [&](DcmItem& item) {
        Uint16 reason = 0;
        item.findAndGetUint16(DCM_FailureReason, reason);
        report.failed.push_back({nameIn(item), reason});
    });
    return report;
}

std::string textOfFailureReason(int reason)
{
    // The terms of PS3.3 C.14.1.1.
    static constexpr struct {
        int value;
        const char* text;
    } kReasons[] = {{kProcessingFailure, "processing failure"},
                    {kNoSuchObject, "no such object instance"},
                    {0x0213, "resource limitation"},
                    {0x0122, "referenced SOP class not supported"},
                    {kClassConflict, "class and instance conflict"},
                    {0x0131, "duplicate transaction UID"}};
    const char* text = "for a reason that it does not say";
    for (const auto& known : kReasons)
        if (known.value == reason)
            text = known.text;
    char code[16];
    std::snprintf(code, sizeof code, " (%04x)", unsigned(reason));
    return text + std::string(code);
}

}  // namespace vicon::ingest
