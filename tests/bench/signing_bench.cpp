// How long it takes from 'sign' until an archive (Orthanc) has everything and has committed to keep it.
//   vicon_signing_bench STORE CASE [REPEATS]
// Works on a copy of the store. A signed report is amended first. Each round's row: the command's time, and the time
// from its start to the last commitment.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "delivering_listener.h"
#include "orthanc.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/sender.h"

using namespace vicon;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::seconds(120);
constexpr auto kBetweenLooks = std::chrono::milliseconds(20);

double secondsSince(Clock::time_point begin)
{
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Throws Error{wrong_use} with what the command printed when it fails.
void run(const std::string& arguments)
{
    const auto result = support::runVicon(arguments);
    if (result.exit_code != 0)
        throw Error(ErrorCode::wrong_use, result.output, "vicon " + arguments);
}

bool allCommitted(CaseStore& store, const std::string& case_id)
{
    const auto counts = countDeliveries(store, case_id);
    return !counts.empty() && counts.begin()->first == DeliveryState::committed && counts.size() == 1;
}

bool isSigned(CaseStore& store, const std::string& case_id)
{
    const ReportState state = reportStatus(store, case_id).state;
    return state == ReportState::final || state == ReportState::amended;
}

struct Round {
    double signed_s = 0, committed_s = 0;
};

Round measure(CaseStore& store, const std::string& case_id, const std::string& options, bool amended)
{
    if (amended)
        run("amend " + case_id + " --reason benchmark" + options);
    const auto begin = Clock::now();
    run("sign " + case_id + options);
    Round round{.signed_s = secondsSince(begin)};
    while (!allCommitted(store, case_id)) {
        if (Clock::now() - begin > kPatience)
            throw Error(ErrorCode::peer, "not everything was committed", case_id);
        std::this_thread::sleep_for(kBetweenLooks);
    }
    round.committed_s = secondsSince(begin);
    return round;
}

int bench(const fs::path& store_path, const std::string& case_id, int repeats)
{
    const support::TemporaryFolder folder;
    const fs::path copy = folder / "store", config = folder / "c.toml";
    fs::copy(store_path, copy, fs::copy_options::recursive);
    const int port = test::freePort();
    const test::Orthanc orthanc(folder / "orthanc", port);
    replaceFile(config, support::deliveringConfig(port, orthanc.peer().port));
    if (!orthanc.answers())
        throw Error(ErrorCode::peer, "Orthanc does not answer");
    const support::DeliveringListener listener(copy, config);
    const std::string options = " --store " + copy.string() + " --config " + config.string();
    CaseStore store(copy);
    std::printf("%zu findings\n%8s %12s %14s\n", findings(store, case_id).size(), "round", "signed (s)",
                "committed (s)");
    for (int n = 1; n <= repeats; ++n) {
        const bool is_signed = n > 1 || isSigned(store, case_id);
        const Round round = measure(store, case_id, options, is_signed);
        std::printf("%8d %12.2f %14.2f\n", n, round.signed_s, round.committed_s);
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv)
try {
    if (argc != 3 && argc != 4) {
        std::fprintf(stderr, "usage: vicon_signing_bench STORE CASE [REPEATS]\n");
        return 2;
    }
    return bench(argv[1], argv[2], argc == 4 ? std::atoi(argv[3]) : 5);
} catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
