#include "vicon/ingest/watched_studies.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon::ingest {

WatchedStudies::WatchedStudies(const fs::path& store, const std::string& peer)
{
    constexpr std::size_t kDigits = 16;  // a peer's name may hold what no file name may
    const fs::path folder = store / "watch";
    makePrivateFolder(folder);
    file_ = folder / (sha256(peer).substr(0, kDigits) + ".json");
    const fs::path lock = fs::path(file_).replace_extension(".lock");
    lock_ = openOrMake(lock);
    if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        ::close(lock_);
        throw Error(ErrorCode::store, "another program watches this peer for this store", peer, "stop it");
    }
    read();
}

WatchedStudies::~WatchedStudies()
{
    ::close(lock_);
}

void WatchedStudies::read()
{
    if (!fs::exists(file_))
        return;
    try {
        const auto all = nlohmann::json::parse(readFile(file_));
        for (const auto& [uid, seen] : all.items())
            seen_[uid] = {seen.at("date"), seen.at("images"), seen.at("fetched"),
                          seen.value("priors", seen.at("fetched") >= 0)};  // lists did not always say so
    } catch (const nlohmann::json::exception&) {
        ::close(lock_);
        throw Error(ErrorCode::store, "the list of studies that were seen is damaged", file_.string(),
                    "remove it: what the store has is not fetched again");
    }
}

void WatchedStudies::write() const
{
    nlohmann::json all = nlohmann::json::object();
    for (const auto& [uid, seen] : seen_)
        all[uid] = {{"date", seen.date}, {"images", seen.images}, {"fetched", seen.fetched}, {"priors", seen.priors}};
    replaceFile(file_, all.dump());
}

bool WatchedStudies::note(const std::string& study_uid, const std::string& date, int images)
{
    const auto [entry, is_new] = seen_.try_emplace(study_uid, Seen{date, images});
    Seen& seen = entry->second;
    if (!is_new && seen.images == images)
        return seen.fetched < images;
    seen.images = images;
    write();
    return false;
}

void WatchedStudies::markFetched(const std::string& study_uid, int images)
{
    seen_[study_uid].fetched = images;
    write();
}

bool WatchedStudies::awaitsFetch(const std::string& study_uid) const
{
    const auto found = seen_.find(study_uid);
    return found != seen_.end() && found->second.fetched < 0;
}

bool WatchedStudies::awaitsPriors(const std::string& study_uid) const
{
    const auto found = seen_.find(study_uid);
    return found != seen_.end() && found->second.fetched >= 0 && !found->second.priors;
}

void WatchedStudies::markPriorsFetched(const std::string& study_uid)
{
    seen_[study_uid].priors = true;
    write();
}

std::string WatchedStudies::newestDate() const
{
    std::string newest;
    for (const auto& [uid, seen] : seen_)
        newest = std::max(newest, seen.date);
    return newest;
}

}  // namespace vicon::ingest
