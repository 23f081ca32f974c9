#include "study_import.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>

#include "inspect.h"
#include "patient_match.h"
#include "pixels.h"
#include "same_object.h"
#include "scan_description.h"
#include "scan_reader.h"
#include "stored_files.h"
#include "text.h"
#include "vicon/cases/said_of_scan.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/description_file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::ingest {
namespace {

constexpr const char* kDicomFolder = "dicom";

void addOnce(json& list, json entry)
{
    if (std::find(list.begin(), list.end(), entry) == list.end())
        list.push_back(std::move(entry));
}

}  // namespace

void StudyImport::run(std::vector<Arrival> arrivals, std::map<std::string, SeriesNotes>& notes)
{
    openCase(arrivals.front().object.patient, arrivals.front().object.study);
    loadStored();
    admit(std::move(arrivals), notes);
    dropUndecodable(notes);
    if (objects_.empty())
        return;
    assemble();
    chooseRoles();
    for (Assembled& scan : scans_)
        describe(scan, notes);
    for (Assembled& scan : scans_)
        store(scan);
    for (const auto& old : old_scans_)
        if (!isFixed(old.first) &&
            std::none_of(scans_.begin(), scans_.end(), [&](const Assembled& s) { return s.record.id == old.first; }))
            store_.removeScan(case_.id, old.first);  // all its objects belong to other scans now
    flagSharedIds();
}

void StudyImport::openCase(const Patient& patient, const Study& study)
{
    if (auto known = store_.findCaseByStudy(study.uid)) {
        case_ = std::move(*known);
        return;
    }
    case_ = {CaseStore::caseIdFor(study.uid), patient, study, {}, nowUtc()};
    if (store_.findCase(case_.id))
        throw Error(ErrorCode::internal, "two studies have the same case id", case_.id, "report this");
}

void StudyImport::loadStored()
{
    std::vector<std::pair<InstanceRecord, fs::path>> stored;
    for (ScanRecord& scan : store_.scans(case_.id)) {
        for (InstanceRecord& instance : store_.instances(case_.id, scan.id)) {
            fs::path file = store_.scanFolder(case_.id, scan.id) / kDicomFolder / instance.file;
            scan_of_[instance.sop_uid] = scan.id;
            stored.emplace_back(std::move(instance), std::move(file));
        }
        if (isSpokenOf(store_, scan))
            fixed_.insert(scan.id);
        old_scans_[scan.id] = std::move(scan);
    }
    std::vector<Inspection> inspected(stored.size());
    tbb::parallel_for(std::size_t(0), stored.size(),
                      [&](std::size_t n) { inspected[n] = inspectFile(stored[n].second, options_); });
    for (std::size_t n = 0; n < stored.size(); ++n) {
        const InstanceRecord& instance = stored[n].first;
        if (inspected[n].verdict != Inspection::Verdict::image)
            continue;  // lost or damaged in the store: an arrival with the same bytes mends it
        inspected[n].object.sha256 = instance.sha256;
        inspected[n].object.sop_uid = instance.sop_uid;
        stored_at_[instance.sop_uid] = {instance.scan_id, instance.file};
        objects_[instance.sop_uid] = std::move(inspected[n].object);
    }
}

void StudyImport::admit(std::vector<Arrival> arrivals, std::map<std::string, SeriesNotes>& notes)
{
    std::vector<Arrival> strangers;
    for (Arrival& arrival : arrivals) {
        const ImageObject& object = arrival.object;
        if (!samePatient(case_.patient, object.patient)) {
            strangers.push_back(std::move(arrival));
            continue;
        }
        const auto recorded = store_.findInstance(object.sop_uid);
        const auto here = objects_.find(object.sop_uid);
        const std::string first = recorded ? recorded->sha256 : here != objects_.end() ? here->second.sha256 : "";
        if (!first.empty() && first != object.sha256 && !isSameAsStored(object, recorded)) {
            report_.not_stored.push_back(object.file);
            const std::string why = "the same SOP Instance UID with other content is stored; the first is kept";
            reporter_.object(ImportLine::Kind::refused, arrival.shown, object.series.uid, why, case_.id);
            addOnce(notes[object.series.uid].refused, {{"object", object.sop_uid}, {"why", why}});
            continue;
        }
        if (recorded && first != object.sha256)
            arrival.object.sha256 = first;  // the same object with another meta header
        if (here != objects_.end())
            continue;
        shown_[object.sop_uid] = arrival.shown;
        const std::string uid = object.sop_uid;
        objects_[uid] = std::move(arrival.object);
    }
    quarantine(strangers);
}

/// The same object that came over another way has another meta header.
bool StudyImport::isSameAsStored(const ImageObject& object, const std::optional<InstanceRecord>& recorded)
{
    const auto here = objects_.find(object.sop_uid);
    if (here != objects_.end())
        return isSameObject(object.file, here->second.file);
    return recorded && isSameObject(object.file, store_.scanFolder(recorded->case_id, recorded->scan_id) /
                                                     kDicomFolder / recorded->file);
}

void StudyImport::quarantine(const std::vector<Arrival>& strangers)
{
    std::map<std::string, std::vector<FileCopy>> folders;
    for (const Arrival& arrival : strangers) {
        const Patient& p = arrival.object.patient;
        const std::string who = sha256(p.id + '\n' + foldedForComparison(p.name) + '\n' + p.birth_date).substr(0, 10);
        const std::string name = sha256(arrival.object.sop_uid + arrival.object.sha256).substr(0, 32) + ".dcm";
        folders[case_.id + "/" + who].push_back({arrival.object.file, name});
    }
    for (auto& [folder, copies] : folders) {
        const fs::path target = store_.folder() / "quarantine" / folder;
        reporter_.line({ImportLine::Kind::quarantined,
                        case_.study.uid,
                        std::to_string(copies.size()) +
                            " objects of this study name another patient than its case; they lie in quarantine/" +
                            folder,
                        case_.id,
                        {}});
        report_.refused += int(copies.size());
        std::set<std::string> names;
        std::erase_if(copies, [&](const FileCopy& copy) {
            return fs::exists(target / copy.name) || !names.insert(copy.name).second;
        });
        if (copies.empty())
            continue;
        copyDurably(target, copies, progress_);
        store_.audit("quarantined", case_.id, "", folder);
    }
}

void StudyImport::dropUndecodable(std::map<std::string, SeriesNotes>& notes)
{
    std::map<std::string, std::size_t> slices;
    for (const auto& [uid, object] : objects_)
        slices[object.series.uid] += object.slices.size();
    // A scan is decoded when it is processed; what will not be processed, or looks damaged, has to be proven here.
    std::vector<const ImageObject*> small;
    for (const auto& [uid, object] : objects_)
        if (shown_.contains(uid) && (object.doubtful || slices[object.series.uid] < std::size_t(options_.min_slices)))
            small.push_back(&object);
    std::vector<std::string> why(small.size());
    tbb::parallel_for(std::size_t(0), small.size(), [&](std::size_t n) {
        try {
            FrameDecoder decoder(*small[n]);
            for (const Slice& slice : small[n]->slices)
                decoder.densities(slice);
        } catch (const Error& e) {
            if (e.code() != ErrorCode::bad_input)
                throw;
            why[n] = e.what();
        } catch (const std::bad_alloc&) {
            why[n] = "its pixels need more memory than there is";
        }
    });
    for (std::size_t n = 0; n < small.size(); ++n) {
        if (why[n].empty())
            continue;
        const std::string uid = small[n]->sop_uid, series = small[n]->series.uid;
        report_.not_stored.push_back(small[n]->file);
        reporter_.object(ImportLine::Kind::refused, shown_[uid], series, why[n], case_.id);
        addOnce(notes[series].refused, {{"object", uid}, {"why", why[n]}});
        objects_.erase(uid);
    }
}

void StudyImport::assemble()
{
    std::map<std::string, std::vector<const ImageObject*>> series, fixed;
    for (const auto& [uid, object] : objects_) {
        const auto home = scan_of_.find(uid);
        if (home != scan_of_.end() && isFixed(home->second))
            fixed[home->second].push_back(&object);
        else
            series[object.series.uid].push_back(&object);
    }
    for (const auto& [scan_id, members] : fixed)
        assembleFixed(scan_id, members);
    for (const auto& [series_uid, members] : series)
        assembleFree(series_uid, members);
}

void StudyImport::assembleFixed(const std::string& scan_id, const std::vector<const ImageObject*>& members)
{
    progress_.check();
    Assembled scan;
    scan.fixed = true;
    scan.stack = splitSeries(members, haveSamePixels).front();
    scan.plan = planStack(scan.stack, options_);
    scan.objects = members;
    scan.record = old_scans_.at(scan_id);
    scans_.push_back(std::move(scan));
}

void StudyImport::assembleFree(const std::string& series_uid, const std::vector<const ImageObject*>& members)
{
    std::set<const ImageObject*> taken;
    for (Stack& stack : splitSeries(members, haveSamePixels)) {
        progress_.check();
        std::set<const ImageObject*> of_stack;
        for (const auto* refs : {&stack.slices, &stack.copies})
            for (const SliceRef& ref : *refs)
                of_stack.insert(ref.object);
        const bool shared = std::any_of(of_stack.begin(), of_stack.end(),
                                        [&](const ImageObject* object) { return taken.contains(object); });
        if (shared) {  // several stacks in one multi-frame object: the largest is used
            scans_.back().plan.repairs.push_back(std::to_string(stack.slices.size()) +
                                                 " frames that belong to another stack are not used");
            continue;
        }
        taken.insert(of_stack.begin(), of_stack.end());
        Assembled scan;
        scan.plan = planStack(stack, options_);
        scan.objects.assign(of_stack.begin(), of_stack.end());
        std::sort(scan.objects.begin(), scan.objects.end(),
                  [](const auto* a, const auto* b) { return a->sop_uid < b->sop_uid; });
        scan.record.case_id = case_.id;
        for (std::string key = series_uid + stack.key; scan.record.id.empty() || isFixed(scan.record.id);
             key += "|later")
            scan.record.id = CaseStore::scanIdFor(key);
        scan.stack = std::move(stack);
        scans_.push_back(std::move(scan));
    }
}

void StudyImport::chooseRoles()
{
    std::vector<Reconstruction> usable;
    std::vector<Assembled*> owners;
    for (Assembled& scan : scans_) {
        const bool usable_plan = scan.plan.refused.empty();
        const std::size_t slices = scan.stack.slices.size();
        if (!scan.fixed)
            scan.record.role = usable_plan ? ScanRole::kept : ScanRole::refused;
        if (!scan.fixed && usable_plan && slices < std::size_t(options_.min_slices))
            scan.record.ingest["kept_because"] = std::to_string(slices) + (slices == 1 ? " slice" : " slices") +
                                                 ", fewer than the " + std::to_string(options_.min_slices) +
                                                 " of a scan";
        else if (usable_plan && (!scan.fixed || scan.record.role == ScanRole::scan)) {
            usable.push_back({&scan.stack, &scan.plan});
            owners.push_back(&scan);
        }
    }
    const std::vector<std::size_t> chosen = chooseScans(usable);
    std::map<std::size_t, const Assembled*> fixed;  // by what would be chosen if nobody had spoken
    for (std::size_t n = 0; n < chosen.size(); ++n)
        if (owners[n]->fixed)
            fixed.try_emplace(chosen[n], owners[n]);
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        if (owners[n]->fixed)
            continue;
        const auto marked = fixed.find(chosen[n]);
        if (marked == fixed.end() && chosen[n] == n) {
            owners[n]->record.role = ScanRole::scan;
            continue;
        }
        const Assembled& other = marked == fixed.end() ? *owners[chosen[n]] : *marked->second;
        owners[n]->record.ingest["kept_because"] =
            "another reconstruction of the acquisition of series " +
            std::to_string(other.stack.slices.front().object->series.number) +
            (marked == fixed.end() ? "" : ", which was marked or reported before");
        owners[n]->record.ingest["reconstruction_of"] = other.record.id;
    }
}

void StudyImport::describe(Assembled& scan, const std::map<std::string, SeriesNotes>& notes)
{
    if (!scan.fixed) {
        scan.record.series = seriesOf(scan.stack);
        json& ingest = scan.record.ingest;
        ingest["geometry"] = describeGeometry(scan.stack, scan.plan);
        ingest["repairs"] = describeRepairs(scan.objects, scan.plan);
        ingest["lossy"] = scan.record.series.lossy;
        const auto old = old_scans_.find(scan.record.id);
        scan.record.created = old == old_scans_.end() ? nowUtc() : old->second.created;
    }
    addNotes(scan, notes);
}

/// What was said about single objects stays said, in whichever import they came.
void StudyImport::addNotes(Assembled& scan, const std::map<std::string, SeriesNotes>& notes)
{
    json& ingest = scan.record.ingest;
    const auto old = old_scans_.find(scan.record.id);
    const auto now = notes.find(scan.record.series.uid);
    for (const char* list : {"refused", "set_aside"}) {
        json said = json::array(), of_scan = json::array();
        if (old != old_scans_.end() && old->second.ingest.contains(list))
            for (const json& entry : old->second.ingest[list]) {
                if (entry.contains("object"))
                    addOnce(said, entry);
                else if (scan.fixed)
                    of_scan.push_back(entry);
            }
        if (now != notes.end())
            for (const json& entry : list == std::string("refused") ? now->second.refused : now->second.set_aside)
                addOnce(said, entry);
        if (!scan.fixed && !scan.plan.refused.empty() && list == std::string("refused"))
            of_scan.push_back({{"why", scan.plan.refused}});
        std::sort(said.begin(), said.end());
        ingest[list] = std::move(of_scan);
        ingest[list].insert(ingest[list].end(), said.begin(), said.end());
    }
}

void StudyImport::store(Assembled& scan)
{
    const fs::path folder = store_.scanFolder(case_.id, scan.record.id) / kDicomFolder;
    std::vector<FileCopy> copies;
    std::vector<fs::path> moved;
    std::vector<InstanceRecord> instances;
    for (const ImageObject* object : scan.objects) {
        const auto home = stored_at_.find(object->sop_uid);
        const bool in_place = home != stored_at_.end() && home->second.scan_id == scan.record.id;
        const std::string name = in_place ? home->second.file : fileNameFor(object->sop_uid);
        instances.push_back({object->sop_uid, case_.id, scan.record.id, object->sha256, name});
        if (in_place)
            continue;
        copies.push_back({object->file, name});
        if (home != stored_at_.end())
            moved.push_back(object->file);
    }
    const auto old = old_scans_.find(scan.record.id);
    const auto stored_here = std::count_if(stored_at_.begin(), stored_at_.end(),
                                           [&](const auto& entry) { return entry.second.scan_id == scan.record.id; });
    const bool grew = !copies.empty() || std::size_t(stored_here) != scan.objects.size();
    const bool new_role = old == old_scans_.end() || old->second.role != scan.record.role;
    const bool new_words =
        new_role || old->second.ingest != scan.record.ingest || json(old->second.series) != json(scan.record.series);
    if (!copies.empty())
        copyDurably(folder, copies, progress_);
    const std::string flag = scan.fixed || !grew ? "" : flagFor(scan);
    if (!flag.empty())
        case_.flags.push_back(flag);  // saved with the scan: no kill parts them
    if (scan.fixed ? new_words : grew || new_words)
        store_.addScan(case_, scan.record, instances,
                       !scan.fixed && scan.record.role == ScanRole::scan && (grew || new_role),
                       [&] { requireUnspoken(scan); });
    else if (!scan_files::isDescribedBy(folder.parent_path(), store_.describeScan(case_.id, scan.record.id)))
        store_.writeScanFile(case_.id, scan.record.id);  // killed between the commit and the copy
    for (const fs::path& file : moved) {
        std::error_code ignored;
        fs::remove(file, ignored);
    }
    tell(scan, !scan.fixed && (grew || new_role));
    if (!flag.empty())
        tellFlag(case_.id, flag);
}

/// A reader may have spoken of the scan since this import began.
void StudyImport::requireUnspoken(const Assembled& scan)
{
    const auto old = old_scans_.find(scan.record.id);
    if (!scan.fixed && old != old_scans_.end() && isSpokenOf(store_, old->second))
        throw Error(ErrorCode::database, "a reader marked this scan while its images were imported; nothing was saved",
                    case_.id + "/" + scan.record.id, "import them again");
}

/// What comes after people have spoken of a case changes nothing of that, and they must hear of it; empty when nobody
/// need.
std::string StudyImport::flagFor(const Assembled& scan)
{
    if (fixed_.empty())
        return {};
    const auto same_series = std::find_if(scans_.begin(), scans_.end(), [&](const Assembled& other) {
        return other.fixed && other.record.series.uid == scan.record.series.uid;
    });
    const bool late = same_series != scans_.end();
    const std::string beside = late ? same_series->record.id : scan.record.ingest.value("reconstruction_of", "");
    const std::string series = (late ? "images of series " : "series ") + std::to_string(scan.record.series.number);
    const std::string line =
        isFixed(beside)
            ? series + " came after scan " + beside + " was marked or reported: beside it as scan " + scan.record.id
            : series + " came after this case was marked or reported: scan " + scan.record.id;
    return isNewFlag(line) ? line : "";
}

/// A flag that a person took away does not come back.
bool StudyImport::isNewFlag(const std::string& line)
{
    return std::find(case_.flags.begin(), case_.flags.end(), line) == case_.flags.end() &&
           !store_.wasFlagged(case_.id, line);
}

void StudyImport::tellFlag(const std::string& case_id, const std::string& line)
{
    store_.audit("flagged", case_id, {}, line);
    reporter_.line({ImportLine::Kind::flagged, case_id, line + "; a person must decide", case_id, {}});
}

void StudyImport::tell(const Assembled& scan, bool changed)
{
    using Kind = ImportLine::Kind;
    const ScanRecord& record = scan.record;
    const bool refused = record.role == ScanRole::refused;
    Kind kind = record.role == ScanRole::scan ? Kind::stored : refused ? Kind::refused : Kind::kept;
    if (refused)
        report_.refused += int(scan.objects.size());
    else if (!changed)
        kind = Kind::unchanged;
    if (kind == Kind::stored)
        ++report_.scans_stored;
    else if (kind == Kind::kept)
        ++report_.images_kept;
    else if (kind == Kind::unchanged)
        ++report_.scans_unchanged;
    const std::string text = refused ? scan.plan.refused : describeInWords(record, scan.plan);
    reporter_.line({kind, record.series.uid, text, case_.id, record.id});
    if (!refused && changed)
        for (const json& repair : record.ingest["repairs"])
            reporter_.line({Kind::repaired, record.series.uid, repair.get<std::string>(), case_.id, record.id});
}

void StudyImport::flagSharedIds()
{
    if (case_.patient.id.empty())
        return;
    const std::string begin = "the patient ID is also that of case ";
    const auto once = [&](const CaseRecord& flagged, const std::string& other) {
        const bool has_one = std::any_of(flagged.flags.begin(), flagged.flags.end(),
                                         [&](const std::string& flag) { return flag.starts_with(begin); });
        const std::string line = begin + other + ", with another name or birth date";
        if (has_one || store_.wasFlagged(flagged.id, line))  // a flag that a person took away does not come back
            return;
        store_.flag(flagged.id, line);
        reporter_.line({ImportLine::Kind::flagged, flagged.id, line + "; a person must decide", flagged.id, {}});
    };
    const auto self = store_.findCase(case_.id);
    if (!self)
        return;
    const std::vector<CaseRecord> namesakes = store_.findCasesByPatient(case_.patient.id);
    const auto other = std::find_if(namesakes.begin(), namesakes.end(), [&](const CaseRecord& c) {
        return c.id != case_.id && !sameNameAndBirth(c.patient, case_.patient);
    });
    if (other == namesakes.end())
        return;
    once(*self, other->id);
    once(*other, case_.id);
}

}  // namespace vicon::ingest
