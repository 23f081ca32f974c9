#include "scan_assembly.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "acquisition.h"
#include "scan_reader.h"

namespace vicon::ingest {
namespace {

using Members = std::vector<const ImageObject*>;

/// Rounds of giving objects that share their frames with others to scans of their own. Scanners part a stack at the end
/// of an object: one round. Only a series made to harm needs more than some.
constexpr int kMostRounds = 16;

AssembledScan fixedScan(const ImportContext& context, const StoredStudy& stored, const std::string& scan_id,
                        const Members& members)
{
    context.progress.check();
    const ScanRecord& record = stored.scans.at(scan_id);
    AssembledScan scan;
    scan.fixed = true;
    scan.fixed_because = stored.with_reader_input.contains(scan_id) ? "which was marked or reported before"
                                                                    : "of which stored images cannot be used";
    scan.stack = splitSeries(members, comparePixels(context.progress)).front();
    scan.plan = planStack(scan.stack, context.options);
    scan.objects = members;
    scan.record = record;
    return scan;
}

std::set<const ImageObject*> objectsOf(const Stack& stack)
{
    std::set<const ImageObject*> objects;
    for (const auto* refs : {&stack.slices, &stack.copies})
        for (const SliceRef& ref : *refs)
            objects.insert(ref.object);
    return objects;
}

/// The id of a stack that is not fixed.
std::string freeScanId(const StoredStudy& stored, std::string key)
{
    std::string id = CaseStore::scanIdFor(key);
    while (stored.isFixed(id))
        id = CaseStore::scanIdFor(key += kLater);
    return id;
}

/// Says that a series was split, and what tells this part from the others.
void saySplit(AssembledScan& scan, std::size_t stacks)
{
    if (stacks < 2)
        return;
    std::string traits;
    for (const std::string& trait : scan.stack.told_apart)
        traits += (traits.empty() ? "" : ", ") + trait;
    scan.plan.repairs.push_back("one series holds " + std::to_string(stacks) + " acquisitions; this one: " + traits);
}

AssembledScan newScan(const ImportContext& context, const StoredStudy& stored, const std::string& key, Stack stack)
{
    AssembledScan scan;
    const std::set<const ImageObject*> of_stack = objectsOf(stack);
    scan.plan = planStack(stack, context.options);
    scan.objects.assign(of_stack.begin(), of_stack.end());
    std::sort(scan.objects.begin(), scan.objects.end(),
              [](const auto* a, const auto* b) { return a->sop_uid < b->sop_uid; });
    scan.record.case_id = stored.record.id;
    scan.record.id = freeScanId(stored, key + stack.key);
    scan.stack = std::move(stack);
    return scan;
}

/// Makes scans of the stacks that share no multi-frame object with a larger one: of an object the largest stack is
/// used. @return the objects that are in none of them
Members addSeparateScans(const ImportContext& context, const StoredStudy& stored, const std::string& key,
                         const Members& members, std::vector<AssembledScan>& scans)
{
    std::set<const ImageObject*> seen, taken;
    std::vector<Stack> stacks = splitSeries(members, comparePixels(context.progress));
    for (Stack& stack : stacks) {
        context.progress.check();
        const std::set<const ImageObject*> of_stack = objectsOf(stack);
        const bool shared = std::any_of(of_stack.begin(), of_stack.end(),
                                        [&](const ImageObject* object) { return seen.contains(object); });
        seen.insert(of_stack.begin(), of_stack.end());
        if (shared)
            continue;
        taken.insert(of_stack.begin(), of_stack.end());
        scans.push_back(newScan(context, stored, key, std::move(stack)));
        saySplit(scans.back(), stacks.size());
    }
    Members rest;
    std::copy_if(members.begin(), members.end(), std::back_inserter(rest),
                 [&](const ImageObject* object) { return !taken.contains(object); });
    return rest;
}

void sayUnused(AssembledScan& scan)
{
    std::size_t frames = 0;
    for (const ImageObject* object : scan.objects)
        frames += object->slices.size();
    if (const std::size_t unused = frames - scan.stack.slices.size() - scan.stack.copies.size(); unused > 0)
        scan.plan.repairs.push_back(std::to_string(unused) + " frames that belong to another stack are not used");
}

void addScansOfSeries(const ImportContext& context, const StoredStudy& stored, const std::string& series_uid,
                      const Members& members, std::vector<AssembledScan>& scans)
{
    std::size_t told = scans.size();
    std::string key = series_uid;
    Members rest = members;
    for (int round = 0; !rest.empty() && round < kMostRounds; ++round) {
        rest = addSeparateScans(context, stored, key, rest, scans);
        for (; told < scans.size(); ++told) {
            scans[told].is_part = round > 0;
            sayUnused(scans[told]);
        }
        key += "|rest";
    }
}

bool isUsable(const AssembledScan& scan)
{
    return scan.plan.refused.empty();
}

/// Says of a series that it is refused, or kept until something speaks for more.
/// @return whether it may be a scan
bool roleByItself(AssembledScan& scan, std::size_t min_slices)
{
    if (scan.fixed)
        return isUsable(scan) && scan.record.role == ScanRole::scan;
    scan.record.role = isUsable(scan) ? ScanRole::kept : ScanRole::refused;
    const std::size_t slices = scan.stack.slices.size();
    if (!isUsable(scan))
        return false;
    if (scan.is_part) {  // not the whole of what was taken: a person has to look
        scan.record.ingest["kept_because"] = "its images share a stack with those of another scan";
        return false;
    }
    if (slices >= min_slices)
        return true;
    scan.record.ingest["kept_because"] = std::to_string(slices) + (slices == 1 ? " slice" : " slices") +
                                         ", fewer than the " + std::to_string(min_slices) + " of a scan";
    return false;
}

void keepBeside(AssembledScan& scan, const AssembledScan& other)
{
    scan.record.ingest["kept_because"] = "another reconstruction of the acquisition of series " +
                                         std::to_string(other.stack.slices.front().object->series.number) +
                                         (other.fixed ? ", " + other.fixed_because : "");
    scan.record.ingest["reconstruction_of"] = other.record.id;
}

/// Of the reconstructions of one acquisition one becomes the scan.
void chooseRoles(std::vector<AssembledScan>& scans, const ImportOptions& options)
{
    std::vector<Reconstruction> usable;
    std::vector<AssembledScan*> owners;
    for (AssembledScan& scan : scans)
        if (roleByItself(scan, std::size_t(options.min_slices))) {
            usable.push_back({&scan.stack, &scan.plan});
            owners.push_back(&scan);
        }
    const std::vector<std::size_t> chosen = chooseScans(usable);
    std::map<std::size_t, const AssembledScan*> fixed;  // by what would be chosen were they not fixed
    for (std::size_t n = 0; n < chosen.size(); ++n)
        if (owners[n]->fixed)
            fixed.try_emplace(chosen[n], owners[n]);
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        if (owners[n]->fixed)
            continue;
        const auto stays = fixed.find(chosen[n]);
        if (stays != fixed.end())
            keepBeside(*owners[n], *stays->second);
        else if (chosen[n] != n)
            keepBeside(*owners[n], *owners[chosen[n]]);
        else
            owners[n]->record.role = ScanRole::scan;
    }
}

}  // namespace

std::vector<AssembledScan> assembleScans(const ImportContext& context, const StoredStudy& stored,
                                         const std::map<std::string, ImageObject>& objects)
{
    std::map<std::string, Members> series, fixed;
    for (const auto& [uid, object] : objects) {
        const auto recorded = stored.recorded.find(uid);
        if (recorded != stored.recorded.end() && stored.isFixed(recorded->second.scan_id))
            fixed[recorded->second.scan_id].push_back(&object);
        else
            series[object.series.uid].push_back(&object);
    }
    std::vector<AssembledScan> scans;
    for (const auto& [scan_id, members] : fixed)
        scans.push_back(fixedScan(context, stored, scan_id, members));
    for (const auto& [series_uid, members] : series)
        addScansOfSeries(context, stored, series_uid, members, scans);
    chooseRoles(scans, context.options);
    return scans;
}

}  // namespace vicon::ingest
