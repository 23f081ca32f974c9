// What a listener takes in does not stay in its memory.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

// Small slices, as it is their number that counts.
const int kStudies = inFull() ? 200 : 6, kSlices = inFull() ? 500 : 100;

/// What a process holds in memory, in MB.
double residentMb(pid_t process)
{
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmRSS:"))
            return std::stod(line.substr(6)) / 1024;
    return 0;
}

/// Whether all that came was imported.
bool isEmpty(const fs::path& incoming)
{
    for (const auto& entry : fs::directory_iterator(incoming))
        if (entry.is_directory() && !fs::is_empty(entry.path()))
            return false;
    return true;
}

TEST(ListenerMemory, DoesNotGrowWithWhatCame)
{
    constexpr double kMostGrowth_mb = 32;
    const TemporaryFolder folder;
    const fs::path store = folder / "store";
    // The address sanitizer, where there is one, keeps what was freed: not here, where it would be taken for growth.
    ::setenv("ASAN_OPTIONS", "quarantine_size_mb=1", 0);
    RunningListener listener(store, "--set receive.quiet_s=0");
    ASSERT_TRUE(listener.answers()) << listener.log();
    NoProgress quiet;
    double early_mb = 0, most_mb = 0;
    const int early = std::max(3, kStudies / 20);  // by then every thread and every cache has been used
    for (int n = 0; n < kStudies; ++n) {
        test::SeriesSpec spec;
        spec.study_uid += "." + std::to_string(n);
        spec.series_uid += "." + std::to_string(n);
        spec.patient_id = "P" + std::to_string(n);
        spec.slices = kSlices;
        const auto files = test::writeSeries(folder / "in", spec);
        ASSERT_TRUE(ingest::storeFiles(listener.peer(), files, "SCANNER", quiet).complete());
        ASSERT_TRUE(support::waitUntil([&] { return isEmpty(store / "incoming"); })) << listener.log();
        const double now_mb = residentMb(listener.process());
        (n < early ? early_mb : most_mb) = std::max(n < early ? early_mb : most_mb, now_mb);
        if (n % std::max(1, kStudies / 20) == 0)
            std::printf("%d instances: %.1f MB\n", (n + 1) * kSlices, now_mb);
    }
    most_mb = std::max(most_mb, residentMb(listener.process()));
    std::printf("%d instances: at most %.1f MB, %.1f after the first %d\n", kStudies * kSlices, most_mb, early_mb,
                early * kSlices);
    EXPECT_LT(most_mb, early_mb + kMostGrowth_mb);
}

}  // namespace
}  // namespace vicon::support
