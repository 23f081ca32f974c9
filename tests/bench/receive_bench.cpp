// How fast stock senders store into VICON, Orthanc and DCMTK's storescp, all in one run.
//   vicon_receive_bench FOLDER [ROUNDS]
// 430 slices of 512 x 512 by storescu with its own settings, into each in turn; storescp without Nagle's algorithm.
// Then the same slices by sixteen senders at once into VICON, against one. Medians of the rounds, and the load.
// storescp flushes nothing. A sender waits for each answer, so whoever flushes before it answers needs the time of
// storescp and that of the flushes alone: the same bytes over allocated blocks, flushed slice by slice.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <future>
#include <map>

#include "dicom_writer.h"
#include "running_listener.h"
#include "vicon/core/error.h"

using namespace vicon;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
constexpr int kSlices = 430, kSenders = 16;

/// DCMTK's own storage SCP, which keeps what comes and does no more.
class StoreScp {
public:
    explicit StoreScp(const fs::path& folder) : port_(test::freePort())
    {
        fs::create_directories(folder);
        process_ = ::fork();
        if (process_ == 0) {
            ::setenv("TCP_NODELAY", "1", 1);
            ::execlp("storescp", "storescp", "-od", folder.c_str(), std::to_string(port_).c_str(), nullptr);
            ::_exit(127);
        }
    }
    ~StoreScp()
    {
        ::kill(process_, SIGTERM);
        ::waitpid(process_, nullptr, 0);
    }
    StoreScp(const StoreScp&) = delete;
    StoreScp& operator=(const StoreScp&) = delete;
    int port() const { return port_; }

private:
    int port_;
    pid_t process_ = -1;
};

/// How long storescu takes to store a folder. Throws Error{peer} with what it said when it fails.
double secondsToStore(const fs::path& folder, const std::string& title, int port)
{
    const auto begin = Clock::now();
    const auto sent = support::runCommand("storescu -aec " + title + " localhost " + std::to_string(port) + " +sd " +
                                          folder.string() + " 2>&1");
    if (sent.exit_code != 0)
        throw Error(ErrorCode::peer, sent.output, title);
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// How long the disk takes for the slices of a folder, each written over a part of `place` and flushed.
double secondsToFlush(const fs::path& folder, const fs::path& place)
{
    constexpr off_t kPlaces = 32;
    std::vector<std::string> slices;
    for (const auto& entry : fs::directory_iterator(folder))
        slices.push_back(readFile(entry.path()));
    const int file = ::open(place.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    double seconds = 0;
    for (off_t n = 0; n < kPlaces + off_t(slices.size()); ++n) {
        const std::string& slice = slices[std::size_t(n) % slices.size()];
        const auto begin = Clock::now();
        const off_t at = n % kPlaces * off_t(slice.size());
        if (::pwrite(file, slice.data(), slice.size(), at) < 0 || ::fdatasync(file) != 0)
            throw Error(ErrorCode::store, "cannot be written", place.string());
        if (n >= kPlaces)  // before, blocks are allocated
            seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    }
    ::close(file);
    return seconds;
}

/// How long sixteen of them take together.
double secondsTogether(const fs::path& folder, int port)
{
    const auto begin = Clock::now();
    std::vector<std::future<double>> senders;
    for (int n = 0; n < kSenders; ++n)
        senders.push_back(
            std::async(std::launch::async, secondsToStore, folder / std::to_string(n), std::string("VICON"), port));
    for (auto& sender : senders)
        sender.get();
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// A study of its own for each round, so that nothing is there already: whole, and dealt to the senders.
void writeRound(const fs::path& folder, int round)
{
    test::SeriesSpec spec;
    for (std::string* uid : {&spec.study_uid, &spec.series_uid})
        *uid += "." + std::to_string(round);
    spec.rows = spec.columns = 512;
    spec.pixel_mm = spec.row_mm = 0.7;
    spec.slices = kSlices;
    const auto files = test::writeSeries(folder / "all", spec);
    for (std::size_t n = 0; n < files.size(); ++n) {
        const fs::path part = folder / "parts" / std::to_string(n % kSenders);
        fs::create_directories(part);
        fs::create_hard_link(files[n], part / files[n].filename());
    }
}

void run(const fs::path& folder, int rounds)
{
    const test::Orthanc orthanc(folder / "orthanc");
    const StoreScp storescp(folder / "storescp");
    const support::RunningListener one(folder / "one" / "store");
    const support::RunningListener many(folder / "many" / "store");
    if (!orthanc.answers() || !one.answers() || !many.answers())
        throw Error(ErrorCode::peer, "a listener did not start");
    std::map<std::string, std::vector<double>> seconds;
    for (int round = 0; round < rounds; ++round) {
        fs::remove_all(folder / "in");
        writeRound(folder / "in", round);
        const fs::path all = folder / "in" / "all";
        // What one leaves to be written is not to be the next one's to flush.
        const auto measure = [&](const std::string& name, const std::function<double()>& work) {
            ::sync();
            seconds[name].push_back(work());
        };
        measure("storescp", [&] { return secondsToStore(all, "STORESCP", storescp.port()); });
        measure("the flushes alone", [&] { return secondsToFlush(all, folder / "flushed"); });
        measure("VICON", [&] { return secondsToStore(all, "VICON", one.peer().port); });
        measure("Orthanc", [&] { return secondsToStore(all, "ORTHANC", orthanc.peer().port); });
        measure("VICON, 16 senders", [&] { return secondsTogether(folder / "in" / "parts", many.peer().port); });
    }
    const double vicon = median(seconds["VICON"]);
    std::printf("%-20s %8s %12s\n", "430 slices into", "seconds", "VICON = 1");
    for (const auto& [name, values] : seconds)
        std::printf("%-20s %8.2f %12.2f\n", name.c_str(), median(values), median(values) / vicon);
    double load = 0;
    if (::getloadavg(&load, 1) == 1)
        std::printf("load %.1f\n", load);
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        std::fprintf(stderr, "usage: vicon_receive_bench FOLDER [ROUNDS]\n");
        return 2;
    }
    try {
        for (const char* listener : {"one", "many"})
            fs::create_directories(fs::path(argv[1]) / listener);
        run(argv[1], argc > 2 ? std::atoi(argv[2]) : 3);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
