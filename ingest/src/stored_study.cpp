#include "stored_study.h"

#include <tbb/parallel_for.h>

#include <utility>
#include <vector>

#include "inspect.h"
#include "vicon/cases/reader_input.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

CaseRecord knownOrNewCase(CaseStore& store, const Patient& patient, const Study& study)
{
    if (auto known = store.findCaseByStudy(study.uid))
        return std::move(*known);
    CaseRecord made{CaseStore::caseIdFor(study.uid), patient, study, {}, nowUtc()};
    if (store.findCase(made.id))
        throw Error(ErrorCode::internal, "two studies have the same case id", made.id, "report this");
    return made;
}

}  // namespace

fs::path imageFolder(const CaseStore& store, const std::string& case_id, const std::string& scan_id)
{
    return store.scanFolder(case_id, scan_id) / "dicom";
}

void StoredStudy::hold(const std::map<std::string, ImageObject>& usable)
{
    std::set<std::string> series;
    for (const auto& [uid, instance] : recorded)
        if (!usable.contains(uid)) {
            missing[instance.scan_id].push_back(uid);
            series.insert(scans.at(instance.scan_id).series.uid);
        }
    for (const auto& [id, scan] : scans)
        if (missing.contains(id) ||
            (series.contains(scan.series.uid) && id != CaseStore::scanIdFor(scan.series.uid + kLater)))
            held.insert(id);
}

StoredStudy loadStoredStudy(const ImportContext& context, const Patient& patient, const Study& study)
{
    StoredStudy found;
    found.record = knownOrNewCase(context.store, patient, study);
    std::vector<std::pair<InstanceRecord, fs::path>> stored;
    for (ScanRecord& scan : context.store.scans(found.record.id)) {
        for (InstanceRecord& instance : context.store.instances(found.record.id, scan.id)) {
            fs::path file = imageFolder(context.store, found.record.id, scan.id) / instance.file;
            found.recorded[instance.sop_uid] = instance;
            stored.emplace_back(std::move(instance), std::move(file));
        }
        if (hasReaderInput(context.store, scan))
            found.with_reader_input.insert(scan.id);
        found.scans[scan.id] = std::move(scan);
    }
    std::vector<Inspection> inspected(stored.size());
    tbb::parallel_for(std::size_t(0), stored.size(),
                      [&](std::size_t n) { inspected[n] = inspectFile(stored[n].second, context.options); });
    for (std::size_t n = 0; n < stored.size(); ++n) {
        const InstanceRecord& instance = stored[n].first;
        if (inspected[n].verdict != Inspection::Verdict::image) {
            found.unusable[instance.sop_uid] = inspected[n].reason;
            continue;  // lost or damaged in the store, or not to be read just now: an arrival of it mends it
        }
        inspected[n].object.sha256 = instance.sha256;
        inspected[n].object.sop_uid = instance.sop_uid;
        found.home[instance.sop_uid] = {instance.scan_id, instance.file};
        found.objects[instance.sop_uid] = std::move(inspected[n].object);
    }
    return found;
}

}  // namespace vicon::ingest
