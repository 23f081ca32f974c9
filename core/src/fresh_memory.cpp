#include "vicon/core/fresh_memory.h"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>

namespace vicon {
namespace {

// Not in pages of 2 MiB: on a virtual machine those come from memory that the host took back, at three times the cost.
constexpr std::size_t kPage = 4096;
constexpr std::size_t kPart = 2U << 20;
constexpr std::size_t kLarge = 8U << 20;  // less is brought in sooner than a thread starts
constexpr unsigned kMostThreads = 4;      // more wait for each other in the kernel

}  // namespace

void touchPages(void* begin, std::size_t bytes)
{
    if (bytes < kLarge)
        return;
    auto* first = static_cast<volatile char*>(begin);
    std::atomic<std::size_t> next = 0;
    const auto touch = [&] {
        for (std::size_t part = next.fetch_add(kPart); part < bytes; part = next.fetch_add(kPart))
            for (std::size_t n = part; n < std::min(part + kPart, bytes); n += kPage)
                first[n] = 0;
    };
    std::vector<std::thread> others;
    try {
        while (others.size() + 1 < std::min(kMostThreads, std::thread::hardware_concurrency()))
            others.emplace_back(touch);
    } catch (const std::system_error&) {  // without more threads this one does it all
    }
    touch();
    for (std::thread& other : others)
        other.join();
}

}  // namespace vicon
