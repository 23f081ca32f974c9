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
    std::vector<ImageObject> strangers;
    for (Arrival& arrival : arrivals) {
        ImageObject& object = arrival.object;
        if (contradict(stored_.record.patient, object.patient)) {
            strangers.push_back(std::move(object));
            continue;
        }
        const auto recorded = context_.store.findInstance(object.sop_uid);
        const auto here = objects_.find(object.sop_uid);
        const std::string first = recorded ? recorded->sha256 : here != objects_.end() ? here->second.sha256 : "";
        if (!first.empty() && first != object.sha256 && !isSameAsStored(object, recorded)) {
            refuse(object, arrival.shown, "the same SOP Instance UID with other content is stored; the first is kept");
            continue;
        }
        if (recorded && first != object.sha256)
            object.sha256 = first;  // the same object with another meta header
        if (here != objects_.end())
            continue;
        addWhatIsNotKnown(stored_.record.patient, object.patient);
        shown_[object.sop_uid] = arrival.shown;
        const std::string uid = object.sop_uid;
        objects_[uid] = std::move(object);
    }
    quarantine(context_, stored_.record, strangers);
}

/// The same object that came over another way has another meta header.
bool StudyObjects::isSameAsStored(const ImageObject& object, const std::optional<InstanceRecord>& recorded) const
{
    const auto here = objects_.find(object.sop_uid);
    if (here != objects_.end())
        return isSameObject(object.file, here->second.file);
    return recorded && isSameObject(object.file,
                                    imageFolder(context_.store, recorded->case_id, recorded->scan_id) / recorded->file);
}

void StudyObjects::refuse(const ImageObject& object, const std::string& shown, const std::string& why)
{
    context_.report.not_stored.push_back(object.file);
    context_.reporter.object(ImportLine::Kind::refused, shown, object.series.uid, why, stored_.record.id);
    addNote(notes_[object.series.uid].refused, noteOf(object.sop_uid, why));
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
