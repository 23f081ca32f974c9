#include "fetching.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <iterator>
#include <set>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/receiver.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

/// A folder of the store for what comes of a study. It stays until all of it was imported, so that a retrieval that
/// broke off, or was killed, goes on where it stopped. One retrieval of a study works at a time.
class ArrivalFolder {
public:
    ArrivalFolder(const fs::path& store, const std::string& study_uid)
        : path_(store / "retrieve" / CaseStore::caseIdFor(study_uid))
    {
        makePrivateFolder(path_);
        lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0)
            throw Error(ErrorCode::store, "this study is being retrieved by another program", study_uid,
                        "wait until it is done");
    }
    ~ArrivalFolder() { ::close(lock_); }
    ArrivalFolder(const ArrivalFolder&) = delete;
    ArrivalFolder& operator=(const ArrivalFolder&) = delete;
    const fs::path& path() const { return path_; }
    std::size_t files() const
    {
        return std::size_t(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }
    void remove() const
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

private:
    fs::path path_;
    int lock_ = -1;
};

std::set<std::string> storedObjects(CaseStore& store, const std::string& study_uid)
{
    std::set<std::string> uids;
    if (const auto known = store.findCaseByStudy(study_uid))
        for (const ScanRecord& scan : store.scans(known->id))
            for (const InstanceRecord& instance : store.instances(known->id, scan.id))
                uids.insert(instance.sop_uid);
    return uids;
}

}  // namespace

Fetched fetchByGet(Context& context, const std::string& study_uid, const ingest::Peer& peer,
                   const std::vector<std::string>& series, Progress& progress)
{
    CaseStore& store = context.store();
    const std::string title = context.config().get<ingest::ReceiverOptions>().ae_title;
    const ArrivalFolder arrival(store.folder(), study_uid);
    const std::set<std::string> have = storedObjects(store, study_uid);
    Fetched fetched;
    try {
        fetched.result = ingest::getSeries(peer, study_uid, series, arrival.path(), title, progress, have);
    } catch (const Error& e) {
        if (e.code() != ErrorCode::peer || arrival.files() == 0)
            throw;
        throw Error(e.code(), e.what(), study_uid,
                    "run the same again: it goes on where it stopped, " + std::to_string(arrival.files()) +
                        " objects are here");
    }
    fetched.whole = arrival.files() == 0 && !have.empty() && fetched.result.failed == 0;
    if (arrival.files() > 0)
        fetched.report =
            ingest::importPaths(store, {arrival.path()}, context.config().get<ingest::ImportOptions>(), progress);
    arrival.remove();
    return fetched;
}

}  // namespace vicon::app
