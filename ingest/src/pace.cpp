#include "pace.h"

#include <algorithm>
#include <thread>

namespace vicon::ingest {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// So much may come at once after a pause.
constexpr auto kBurst = std::chrono::milliseconds(500);

}  // namespace

void Pace::take(std::size_t bytes)
{
    if (bytes_per_s_ <= 0)
        return;
    SteadyClock::time_point until;
    {
        const std::lock_guard lock(mutex_);
        const std::chrono::duration<double> takes(double(bytes) / bytes_per_s_);
        free_from_ = std::max(free_from_, SteadyClock::now() - kBurst) +
                     std::chrono::duration_cast<SteadyClock::duration>(takes);
        until = free_from_;
    }
    std::this_thread::sleep_until(until);
}

}  // namespace vicon::ingest
