#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace vicon::ingest {

/// What was seen of a peer's studies, so that each is fetched once, over restarts and whatever the clocks say. Kept in
/// a file of the store; one program at a time watches a peer for it.
class WatchedStudies {
public:
    /// Throws Error{store} when another program watches this peer, or the file is damaged.
    WatchedStudies(const std::filesystem::path& store, const std::string& peer);
    ~WatchedStudies();
    WatchedStudies(const WatchedStudies&) = delete;
    WatchedStudies& operator=(const WatchedStudies&) = delete;

    /// Notes that the peer has this study, with so many images. Returns whether it is to be fetched: not yet fetched
    /// with as many, and not growing, as it has as many as when it was last noted.
    bool note(const std::string& study_uid, const std::string& date, int images);
    void markFetched(const std::string& study_uid, int images);
    /// Whether the study was noted and not fetched since.
    bool awaitsFetch(const std::string& study_uid) const;
    /// Whether the study was fetched, and its earlier studies not yet.
    bool awaitsPriors(const std::string& study_uid) const;
    void markPriorsFetched(const std::string& study_uid);
    /// The date of the newest study that was noted, YYYYMMDD; empty when none was.
    std::string newestDate() const;

private:
    struct Seen {
        std::string date;
        int images = 0;
        int fetched = -1;     ///< with so many images; -1: not yet
        bool priors = false;  ///< its earlier studies were fetched
    };
    void read();
    void write() const;

    std::filesystem::path file_;
    int lock_ = -1;
    std::map<std::string, Seen> seen_;
};

}  // namespace vicon::ingest
