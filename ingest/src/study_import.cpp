#include "study_import.h"

#include <algorithm>
#include <set>

#include "case_flags.h"
#include "scan_description.h"
#include "stored_files.h"
#include "vicon/cases/reader_input.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/description_file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::ingest {
namespace {

/// Of several the one that a later import of the same objects finds as well.
std::string senderOf(const AssembledScan& scan)
{
    std::string sender;
    for (const ImageObject* object : scan.objects)
        if (!object->sender.empty() && (sender.empty() || object->sender < sender))
            sender = object->sender;
    return sender;
}

}  // namespace

void StudyImport::run(std::vector<Arrival> arrivals, std::map<std::string, SeriesNotes>& notes)
{
    stored_ = loadStoredStudy(context_, arrivals.front().object.patient, arrivals.front().object.study);
    StudyObjects objects(context_, stored_, notes);
    objects.admit(std::move(arrivals));
    objects.dropUndecodable();
    stored_.hold(objects.all());
    scans_ = assembleScans(context_, stored_, objects.all());
    std::set<const ImageObject*> taken;
    for (const AssembledScan& scan : scans_)
        taken.insert(scan.objects.begin(), scan.objects.end());
    objects.refuseAllBut(taken);
    for (AssembledScan& scan : scans_)
        describe(scan, notes);
    for (const AssembledScan& scan : scans_)
        store(scan);
    tellMissing();
    removeEmptied();
    flagSharedId(context_, stored_.record);
}

void StudyImport::describe(AssembledScan& scan, const std::map<std::string, SeriesNotes>& notes) const
{
    if (!scan.fixed) {
        scan.record.series = seriesOf(scan.stack);
        json& ingest = scan.record.ingest;
        ingest["geometry"] = describeGeometry(scan.stack, scan.plan);
        ingest["repairs"] = describeRepairs(scan.objects, scan.plan);
        ingest["lossy"] = scan.record.series.lossy;
        if (const std::string sender = senderOf(scan); !sender.empty())
            ingest[kIngestSender] = sender;
        const auto old = stored_.scans.find(scan.record.id);
        scan.record.created = old == stored_.scans.end() ? nowUtc() : old->second.created;
    }
    addNotes(scan, notes);
}

/// What was said about single objects stays said, in whichever import they came.
void StudyImport::addNotes(AssembledScan& scan, const std::map<std::string, SeriesNotes>& notes) const
{
    json& ingest = scan.record.ingest;
    const auto old = stored_.scans.find(scan.record.id);
    const auto now = notes.find(scan.record.series.uid);
    for (const char* list : {"refused", "set_aside"}) {
        const bool refused = list == std::string("refused");
        json said = json::array(), of_scan = json::array();
        if (old != stored_.scans.end() && old->second.ingest.contains(list))
            for (const json& entry : old->second.ingest[list]) {
                if (entry.contains("object"))
                    addNote(said, entry);
                else if (scan.fixed)
                    of_scan.push_back(entry);
            }
        if (now != notes.end())
            for (const json& entry : refused ? now->second.refused : now->second.set_aside)
                addNote(said, entry);
        if (!scan.fixed && !scan.plan.refused.empty() && refused)
            of_scan.push_back({{"why", scan.plan.refused}});
        std::sort(said.begin(), said.end());
        ingest[list] = std::move(of_scan);
        ingest[list].insert(ingest[list].end(), said.begin(), said.end());
    }
}

void StudyImport::store(const AssembledScan& scan)
{
    std::vector<FileCopy> copies;
    std::vector<fs::path> moved;
    std::vector<InstanceRecord> instances;
    for (const ImageObject* object : scan.objects) {
        const auto home = stored_.home.find(object->sop_uid);
        const bool in_place = home != stored_.home.end() && home->second.scan_id == scan.record.id;
        const std::string name = in_place ? home->second.file : fileNameFor(object->sop_uid);
        instances.push_back({object->sop_uid, stored_.record.id, scan.record.id, object->sha256, name});
        if (in_place)
            continue;
        copies.push_back({object->file, name});
        const auto old = stored_.recorded.find(object->sop_uid);
        if (old != stored_.recorded.end() && old->second.scan_id != scan.record.id)
            moved.push_back(imageFolder(context_.store, stored_.record.id, old->second.scan_id) / old->second.file);
    }
    const Changes changes = changesOf(scan, instances, !copies.empty());
    if (!copies.empty())
        copyDurably(imageFolder(context_.store, stored_.record.id, scan.record.id), copies, context_.progress);
    const std::string flag = record(scan, instances, changes);
    for (const fs::path& file : moved) {
        std::error_code ignored;
        fs::remove(file, ignored);
    }
    tell(scan, !scan.fixed && (changes.grew || changes.role));
    if (!flag.empty())
        tellFlag(context_, stored_.record.id, flag);
}

StudyImport::Changes StudyImport::changesOf(const AssembledScan& scan, const std::vector<InstanceRecord>& instances,
                                            bool has_copies) const
{
    const auto stored_here = std::count_if(stored_.home.begin(), stored_.home.end(),
                                           [&](const auto& entry) { return entry.second.scan_id == scan.record.id; });
    const auto old = stored_.scans.find(scan.record.id);
    Changes changes;
    changes.grew = has_copies || std::size_t(stored_here) != scan.objects.size();
    changes.role = old == stored_.scans.end() || old->second.role != scan.record.role;
    changes.hashes = std::any_of(instances.begin(), instances.end(), [&](const InstanceRecord& instance) {
        const auto recorded = stored_.recorded.find(instance.sop_uid);
        return recorded == stored_.recorded.end() || recorded->second.sha256 != instance.sha256;
    });
    return changes;
}

std::string StudyImport::record(const AssembledScan& scan, const std::vector<InstanceRecord>& instances,
                                const Changes& changes)
{
    CaseStore& store = context_.store;
    const std::string &case_id = stored_.record.id, &scan_id = scan.record.id;
    const auto old = stored_.scans.find(scan_id);
    const bool new_words = changes.role || changes.hashes || old->second.ingest != scan.record.ingest ||
                           json(old->second.series) != json(scan.record.series);
    std::string flag = scan.fixed || !changes.grew ? "" : flagForLateScan(context_, stored_, scans_, scan);
    if (!flag.empty())
        stored_.record.flags.push_back(flag);  // saved with the scan: no kill parts them
    if (new_words || (changes.grew && !scan.fixed))
        store.addScan(
            stored_.record, scan.record, instances,
            !scan.fixed && scan.record.role == ScanRole::scan && (changes.grew || changes.role),
            [&] { requireNoReaderInput(scan); }, flag);
    else if (!scan_files::isDescribedBy(store.scanFolder(case_id, scan_id), store.describeScan(case_id, scan_id)))
        store.writeScanFile(case_id, scan_id);  // killed between the commit and the copy
    return flag;
}

/// A reader may have worked on the scan since this import began.
void StudyImport::requireNoReaderInput(const AssembledScan& scan) const
{
    const auto old = stored_.scans.find(scan.record.id);
    if (!scan.fixed && old != stored_.scans.end() && hasReaderInput(context_.store, old->second))
        throw Error(ErrorCode::database, "a reader marked this scan while its images were imported; nothing was saved",
                    stored_.record.id + "/" + scan.record.id, "import them again");
}

void StudyImport::tell(const AssembledScan& scan, bool changed) const
{
    using Kind = ImportLine::Kind;
    ImportReport& report = context_.report;
    const ScanRecord& record = scan.record;
    const bool refused = record.role == ScanRole::refused;
    Kind kind = record.role == ScanRole::scan ? Kind::stored : refused ? Kind::refused : Kind::kept;
    if (refused)
        report.refused += int(scan.objects.size());
    else if (!changed)
        kind = Kind::unchanged;
    if (kind == Kind::stored)
        ++report.scans_stored;
    else if (kind == Kind::kept)
        ++report.images_kept;
    else if (kind == Kind::unchanged)
        ++report.scans_unchanged;
    if (stored_.missing.contains(record.id))
        return;  // its plan is that of the rest
    const std::string text = refused ? scan.plan.refused : describeInWords(record, scan.plan);
    context_.reporter.line({kind, record.series.uid, text, stored_.record.id, record.id});
    if (!refused && changed)
        for (const json& repair : record.ingest["repairs"])
            context_.reporter.line(
                {Kind::repaired, record.series.uid, repair.get<std::string>(), stored_.record.id, record.id});
}

/// What the store cannot give any more, or not just now, is said each time.
void StudyImport::tellMissing() const
{
    for (const auto& [scan_id, uids] : stored_.missing) {
        const auto why = stored_.unusable.find(uids.front());
        context_.report.refused += int(uids.size());
        context_.reporter.line({ImportLine::Kind::refused, stored_.scans.at(scan_id).series.uid,
                                std::to_string(uids.size()) + " of its stored images cannot be used (" +
                                    (why == stored_.unusable.end() ? "lost" : why->second) +
                                    "); the scan stays as it is",
                                stored_.record.id, scan_id});
    }
}

/// Scans of which all objects belong to other scans now.
void StudyImport::removeEmptied() const
{
    std::set<std::string> in_use;
    for (const AssembledScan& scan : scans_)
        in_use.insert(scan.record.id);
    for (const auto& old : stored_.scans)
        if (!stored_.isFixed(old.first) && !in_use.contains(old.first))
            context_.store.removeScan(stored_.record.id, old.first);
}

}  // namespace vicon::ingest
