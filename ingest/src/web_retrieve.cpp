#include <algorithm>
#include <fstream>
#include <optional>

#include "vicon/core/error.h"
#include "web_object.h"
#include "web_peer.h"

namespace fs = std::filesystem;

namespace vicon::ingest::web {
namespace {

constexpr const char* kPart = ".part";

/// A file that is being written; it gets its name when it is whole, and is gone otherwise.
class ArrivingFile {
public:
    explicit ArrivingFile(fs::path file) : file_(std::move(file)), out_(part(), std::ios::binary) {}
    ~ArrivingFile()
    {
        std::error_code is_whole;
        fs::remove(part(), is_whole);
    }
    ArrivingFile(const ArrivingFile&) = delete;
    ArrivingFile& operator=(const ArrivingFile&) = delete;
    void add(std::string_view bytes)
    {
        out_.write(bytes.data(), std::streamsize(bytes.size()));
        requireWritten();
    }
    void finish()
    {
        out_.close();
        requireWritten();
        fs::rename(part(), file_);
    }

private:
    fs::path part() const { return file_.string() + kPart; }
    void requireWritten() const
    {
        if (!out_)
            throw Error(ErrorCode::store, "what comes from the peer cannot be written", file_.parent_path().string(),
                        "make room");
    }
    fs::path file_;
    std::ofstream out_;
};

/// Names of files for what comes into a folder.
class NextFile {
public:
    explicit NextFile(fs::path folder) : folder_(std::move(folder)) {}
    fs::path operator()()
    {
        fs::path file;
        do
            file = folder_ / ("web-" + std::to_string(number_++) + ".dcm");
        while (fs::exists(file));
        return file;
    }

private:
    fs::path folder_;
    int number_ = 1;
};

/// What became of one request.
void note(RetrieveResult& all, const FetchedObjects& fetched, std::size_t asked)
{
    all.completed += fetched.count;
    all.failed += std::max(0, int(asked) - fetched.count);
    if (!fetched.answer.good())
        all.reasons.push_back("the peer refused " + std::to_string(asked) + " objects (" + statusOf(fetched.answer) +
                              ")");
    else if (fetched.count < int(asked))
        all.reasons.push_back("the peer sent " + std::to_string(fetched.count) + " of " + std::to_string(asked) +
                              " objects");
}

}  // namespace

RetrieveResult getSeries(const Peer& peer, const std::string& study_uid, const std::vector<std::string>& series_uids,
                         const fs::path& folder, const std::set<std::string>& here, Progress& progress)
{
    WebClient client(peer, progress);
    NextFile next_file(folder);
    RetrieveResult all;
    for (std::size_t n = 0; n < series_uids.size(); ++n) {
        const std::string path = "/studies/" + uidInPath(study_uid) + "/series/" + uidInPath(series_uids[n]);
        const std::vector<std::string> objects = findObjects(peer, study_uid, series_uids[n], progress);
        std::vector<std::string> missing;
        std::copy_if(objects.begin(), objects.end(), std::back_inserter(missing),
                     [&](const std::string& uid) { return !here.contains(uid); });
        std::optional<ArrivingFile> file;
        int came = 0;
        const MultipartReader::Parts parts{
            [&] { file.emplace(next_file()); }, [&](std::string_view bytes) { file->add(bytes); },
            [&] {
                file->finish();
                file.reset();
                const double part = std::min(1.0, double(++came) / double(std::max<std::size_t>(1, missing.size())));
                progress.report((double(n) + part) / double(series_uids.size()), "retrieving");
            }};
        if (missing.size() == objects.size() && !objects.empty()) {
            note(all, fetchObjects(client, path, parts), missing.size());
            continue;
        }
        for (const std::string& uid : missing)
            note(all, fetchObjects(client, path + "/instances/" + uidInPath(uid), parts), 1);
    }
    return all;
}

}  // namespace vicon::ingest::web
