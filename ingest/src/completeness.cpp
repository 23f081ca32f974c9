#include "vicon/ingest/completeness.h"

#include <algorithm>
#include <map>
#include <set>

#include "loose_files.h"
#include "study_key.h"
#include "vicon/cases/store_presence.h"
#include "vicon/core/error.h"
#include "vicon/ingest/query.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// An archive that is off must not hold every study up for its time-out.
constexpr auto kLeftAlone = std::chrono::seconds(60);

/// Objects, by the series that they belong to.
using Objects = std::map<std::string, std::set<std::string>>;

Objects objectsAmong(const std::string& study_uid, const std::vector<fs::path>& files)
{
    Objects objects;
    for (const fs::path& file : files)
        if (const ObjectUids uids = uidsOf(file); uids.study == study_uid)
            objects[uids.series].insert(uids.object);
    return objects;
}

void addKnown(Objects& objects, CaseStore& store, const std::string& study_uid)
{
    if (const auto known = store.findCaseByStudy(study_uid))
        for (const ScanRecord& scan : store.scans(known->id))
            for (const InstanceRecord& instance : store.instances(known->id, scan.id))
                objects[scan.series.uid].insert(instance.sop_uid);
}

/// The series that the study is waited for with: those that have begun to arrive, and where images do, all of their
/// modality, since one may not have begun yet.
std::vector<FoundSeries> awaited(std::vector<FoundSeries> series, const Objects& arriving)
{
    std::set<std::string> modalities;
    for (const FoundSeries& one : series)
        if (arriving.contains(one.uid) && (one.modality == "CT" || one.modality == "MR"))
            modalities.insert(one.modality);
    std::erase_if(series, [&](const FoundSeries& one) {
        return !arriving.contains(one.uid) && !modalities.contains(one.modality);
    });
    return series;
}

}  // namespace

Completeness::Completeness(StorePlace place, Peer peer, std::string our_ae_title)
    : place_(std::move(place)), peer_(std::move(peer)), our_ae_title_(std::move(our_ae_title))
{
}

int Completeness::missing(const std::vector<fs::path>& files)
{
    if (files.empty() || std::chrono::steady_clock::now() < ask_again_)
        return 0;
    CaseStore store = openAgain(place_);
    NoProgress quiet;
    const std::string study_uid = uidsOf(files.front()).study;
    const Objects arriving = objectsAmong(study_uid, files);
    Objects here = arriving;
    addKnown(here, store, study_uid);
    int missing = 0;
    try {
        for (const FoundSeries& series : awaited(describeSeries(peer_, study_uid, our_ae_title_, quiet), arriving)) {
            const std::set<std::string>& known = here[series.uid];
            if (series.images >= 0 && std::size_t(series.images) <= known.size())
                continue;
            LooseFiles loose(store.folder());
            for (const std::string& uid : findObjects(peer_, study_uid, series.uid, our_ae_title_, quiet))
                missing += known.contains(uid) || !loose.of(uid).empty() ? 0 : 1;
        }
    } catch (const Error&) {
        ask_again_ = std::chrono::steady_clock::now() + kLeftAlone;
        throw;
    }
    return missing;
}

}  // namespace vicon::ingest
