#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>

namespace vicon::ingest {

/// Lets bytes pass at a rate that several associations share, each waiting its turn. For several threads.
class Pace {
public:
    /// @param mb_per_s 0: without a limit
    explicit Pace(double mb_per_s) : bytes_per_s_(mb_per_s * 1e6) {}
    /// Waits until so many bytes more may have been taken.
    void take(std::size_t bytes);

private:
    double bytes_per_s_;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point free_from_;
};

}  // namespace vicon::ingest
