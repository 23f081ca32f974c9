#include <filesystem>

#include "commitment_dataset.h"
#include "helper.h"
#include "loose_files.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/commitment.h"
#include "vicon/ingest/delivery.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr int kKept = 0;  // beside the failure reasons

/// Whether a file holds this object, or the reason against a commitment to it.
int judgeFile(const fs::path& file, const ObjectName& object)
{
    const OutboxObject there = outboxObject(file);
    if (there.sop_uid != object.sop_uid)
        return kNoSuchObject;
    return there.sop_class == object.sop_class ? kKept : kClassConflict;
}

/// Of a file that the store knows by its hash.
int judgeKnown(const fs::path& file, const std::string& sha256, const ObjectName& object)
{
    try {
        return sha256OfFile(file) == sha256 ? judgeFile(file, object) : kProcessingFailure;
    } catch (const Error&) {
        return kProcessingFailure;
    }
}

int judgeLoose(const fs::path& file, const ObjectName& object)
{
    try {
        return whyNotToRead(file).empty() ? judgeFile(file, object) : kProcessingFailure;
    } catch (const Error&) {
        return kProcessingFailure;
    }
}

int judge(CaseStore& store, LooseFiles& loose, const ObjectName& object)
{
    int reason = kNoSuchObject;
    if (const auto instance = store.findInstance(object.sop_uid))
        reason = judgeKnown(store.scanFolder(instance->case_id, instance->scan_id) / "dicom" / instance->file,
                            instance->sha256, object);
    else if (const auto report = findKeptReport(store, object.sop_uid))
        reason = judgeKnown(keptReportsFolder(store) / report->file, report->sha256, object);
    for (const fs::path& file : loose.of(object.sop_uid))
        if (reason != kKept)
            reason = judgeLoose(file, object);
    return reason;
}

}  // namespace

CommitmentReport commitTo(CaseStore& store, const CommitmentDemand& demand, const Progress& wanted)
{
    CommitmentReport report{demand.transaction_uid, {}, {}};
    // The second time for what the import moved while it was looked for.
    LooseFiles first_look(store.folder()), second_look(store.folder());
    for (const ObjectName& object : demand.objects) {
        wanted.check();
        int reason = judge(store, first_look, object);
        if (reason != kKept)
            reason = judge(store, second_look, object);
        if (reason == kKept)
            report.committed.push_back(object);
        else
            report.failed.push_back({object, reason});
    }
    return report;
}

}  // namespace vicon::ingest
