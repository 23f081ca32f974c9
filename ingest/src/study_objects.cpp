#include "study_objects.h"

#include <tbb/parallel_for.h>

#include <chrono>
#include <mutex>
#include <new>

#include "pixels.h"
#include "quarantine.h"
#include "same_object.h"
#include "scan_reader.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/patient_match.h"

namespace vicon::ingest {
namespace {

/// How long the objects of one import are proven. The rest is taken unproven: whoever processes it can be told to stop,
/// and the other studies that came in do not wait for it. A study of a thousand RLE slices takes some seconds.
constexpr std::chrono::minutes kLongestProof{2};

/// A limit of the time that objects are proven, and what ends it before. For several threads at once.
class Proof {
public:
    explicit Proof(const ImportContext& context) : context_(context) {}
    /// Throws Error{cancelled}.
    bool isOver()
    {
        const std::lock_guard lock(telling_);
        context_.progress.check();
        return std::chrono::steady_clock::now() > end_;
    }
    bool isTooLarge(const ImageObject& object) const
    {
        constexpr double kMillion = 1e6;
        return double(object.slices.size()) * object.pixels.rows * object.pixels.columns >
               context_.options.largest_volume_mvoxel * kMillion;
    }

private:
    const ImportContext& context_;
    std::mutex telling_;
    const std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now() + kLongestProof;
};

/// Why an object's pixels cannot be had; empty where they can.
std::string whyUndecodable(const ImageObject& object, Proof& proof)
{
    if (proof.isTooLarge(object))
        return "its volume would be larger than import.largest_volume_mvoxel allows";
    try {
        FrameDecoder decoder(object);
        for (const Slice& slice : object.slices) {
            if (proof.isOver())
                return {};
            decoder.densities(slice);
        }
        return {};
    } catch (const Error& e) {
        if (e.code() != ErrorCode::bad_input)
            throw;
        return e.what();
    } catch (const std::bad_alloc&) {
        return "its pixels need more memory than there is";
    }
}

}  // namespace

void StudyObjects::admit(std::vector<Arrival> arrivals)
{
    forgetDamaged(arrivals);
    std::vector<ImageObject> strangers;
    for (Arrival& arrival : arrivals) {
        ImageObject& object = arrival.object;
        if (contradict(stored_.record.patient, object.patient)) {
            strangers.push_back(std::move(object));
            continue;
        }
        if (const std::string why = whyNotTaken(object); !why.empty()) {
            refuse(object, arrival.shown, why);
            continue;
        }
        if (objects_.contains(object.sop_uid))
            continue;
        addWhatIsNotKnown(stored_.record.patient, object.patient);
        shown_[object.sop_uid] = arrival.shown;
        const std::string uid = object.sop_uid;
        objects_[uid] = std::move(object);
    }
    tellReplaced();
    quarantine(context_, stored_.record, strangers);
}

/// A file that is no longer what was stored counts as lost as soon as its object comes again.
void StudyObjects::forgetDamaged(const std::vector<Arrival>& arrivals)
{
    std::vector<const InstanceRecord*> again;
    for (const Arrival& arrival : arrivals)
        if (stored_.home.contains(arrival.object.sop_uid))
            again.push_back(&stored_.recorded.at(arrival.object.sop_uid));
    std::vector<Recorded> found(again.size());
    tbb::parallel_for(std::size_t(0), again.size(), [&](std::size_t n) { found[n] = stateOf(*again[n]); });
    for (std::size_t n = 0; n < again.size(); ++n) {
        if (found[n] != Recorded::lost)
            continue;
        objects_.erase(again[n]->sop_uid);
        stored_.home.erase(again[n]->sop_uid);
        stored_.unusable[again[n]->sop_uid] = "its file is not what was stored";
    }
}

/// Why an object is refused for what is there under its UID; empty where it is taken, or is there already.
std::string StudyObjects::whyNotTaken(const ImageObject& object)
{
    constexpr const char* kOther = "the same SOP Instance UID with other content is stored; the first is kept";
    if (const auto here = objects_.find(object.sop_uid); here != objects_.end())
        return here->second.sha256 == object.sha256 || isSameObject(object.file, here->second.file) ? "" : kOther;
    const auto recorded = context_.store.findInstance(object.sop_uid);
    if (!recorded || recorded->sha256 == object.sha256)
        return {};
    const Recorded state = stateOf(*recorded);
    if (state == Recorded::unreadable)
        return "the same SOP Instance UID is stored, and its file cannot be read now";
    // The same object that came over another way has another meta header.
    if (recorded->case_id != stored_.record.id ||
        (state == Recorded::whole && !isSameObject(object.file, fileOf(*recorded))))
        return kOther;
    if (state == Recorded::lost)
        ++replaced_[object.series.uid];
    return {};
}

std::filesystem::path StudyObjects::fileOf(const InstanceRecord& recorded) const
{
    return imageFolder(context_.store, recorded.case_id, recorded.scan_id) / recorded.file;
}

StudyObjects::Recorded StudyObjects::stateOf(const InstanceRecord& recorded) const
{
    const std::filesystem::path file = fileOf(recorded);
    try {
        if (!std::filesystem::exists(file))
            return Recorded::lost;
        return sha256OfFile(file) == recorded.sha256 ? Recorded::whole : Recorded::lost;
    } catch (const Error&) {
        return Recorded::unreadable;
    } catch (const std::filesystem::filesystem_error&) {
        return Recorded::unreadable;
    }
}

void StudyObjects::tellReplaced() const
{
    for (const auto& [series, count] : replaced_)
        context_.reporter.line({ImportLine::Kind::repaired, series,
                                std::to_string(count) +
                                    " stored images were lost or damaged; what came with their SOP Instance UIDs "
                                    "takes their place",
                                stored_.record.id, ""});
}

void StudyObjects::refuse(const ImageObject& object, const std::string& shown, const std::string& why)
{
    context_.report.not_stored.push_back(object.file);
    context_.reporter.object(ImportLine::Kind::refused, shown, object.series.uid, why, stored_.record.id);
    addNote(notes_[object.series.uid].refused, noteOf(object.sop_uid, why));
}

void StudyObjects::refuseAllBut(const std::set<const ImageObject*>& taken)
{
    for (const auto& [uid, object] : objects_)
        if (const auto shown = shown_.find(uid); shown != shown_.end() && !taken.contains(&object))
            refuse(object, shown->second, "its frames are shared out among too many other images");
}

void StudyObjects::dropUndecodable()
{
    std::map<std::string, std::size_t> slices;
    for (const auto& [uid, object] : objects_)
        slices[object.series.uid] += object.slices.size();
    std::vector<const ImageObject*> to_prove;
    for (const auto& [uid, object] : objects_)
        if (shown_.contains(uid) &&
            (object.doubtful || slices[object.series.uid] < std::size_t(context_.options.min_slices)))
            to_prove.push_back(&object);
    std::vector<std::string> why(to_prove.size());
    Proof proof(context_);
    tbb::parallel_for(std::size_t(0), to_prove.size(),
                      [&](std::size_t n) { why[n] = whyUndecodable(*to_prove[n], proof); });
    for (std::size_t n = 0; n < to_prove.size(); ++n) {
        if (why[n].empty())
            continue;
        const std::string uid = to_prove[n]->sop_uid;
        refuse(*to_prove[n], shown_[uid], why[n]);
        objects_.erase(uid);
    }
}

}  // namespace vicon::ingest
