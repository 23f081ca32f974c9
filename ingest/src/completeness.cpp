#include "vicon/ingest/completeness.h"

#include <algorithm>
#include <map>
#include <set>

#include "loose_files.h"
#include "study_key.h"
#include "vicon/core/error.h"
#include "vicon/ingest/query.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// An archive that is off must not hold every study up for its time-out.
constexpr auto kLeftAlone = std::chrono::seconds(60);

/// Objects, by the series that they belong to.
using Objects = std::map<std::string, std::set<std::string>>;

Objects objectsIn(CaseStore& store, const std::string& study_uid, const std::vector<fs::path>& files)
{
    Objects objects;
    for (const fs::path& file : files)
        if (const ObjectUids uids = uidsOf(file); uids.study == study_uid)
            objects[uids.series].insert(uids.object);
    if (const auto known = store.findCaseByStudy(study_uid))
        for (const ScanRecord& scan : store.scans(known->id))
            if (const auto arriving = objects.find(scan.series.uid); arriving != objects.end())
                for (const InstanceRecord& instance : store.instances(known->id, scan.id))
                    arriving->second.insert(instance.sop_uid);
    return objects;
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
    CaseStore store(place_);
    NoProgress quiet;
    const std::string study_uid = uidsOf(files.front()).study;
    const Objects here = objectsIn(store, study_uid, files);
    int missing = 0;
    try {
        for (const FoundSeries& series : describeSeries(peer_, study_uid, our_ae_title_, quiet)) {
            const auto arriving = here.find(series.uid);
            if (arriving == here.end() || (series.images >= 0 && std::size_t(series.images) <= arriving->second.size()))
                continue;
            LooseFiles loose(store.folder());
            for (const std::string& uid : findObjects(peer_, study_uid, series.uid, our_ae_title_, quiet))
                missing += arriving->second.contains(uid) || !loose.of(uid).empty() ? 0 : 1;
        }
    } catch (const Error&) {
        ask_again_ = std::chrono::steady_clock::now() + kLeftAlone;
        throw;
    }
    return missing;
}

}  // namespace vicon::ingest
