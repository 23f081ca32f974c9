#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <functional>
#include <string>

namespace vicon::test {

/// What every file that comes in may cost at most, however it was made.
inline constexpr double kMostSeconds = 5;
inline constexpr double kMostMegabytes = 512;

/// Does the work and expects it to stay within the limits above. Processor time of this program is counted and of its
/// children that ended meanwhile, not time by the clock: other programs may be busy. Memory is the most that was held
/// at once; sanitizers hold more by themselves.
inline void expectBearable(const std::function<void()>& work, const std::string& of)
{
    const auto seconds = [] {
        double sum = 0;
        for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
            rusage used{};
            ::getrusage(who, &used);
            for (const timeval& t : {used.ru_utime, used.ru_stime})
                sum += double(t.tv_sec) + double(t.tv_usec) / 1e6;
        }
        return sum;
    };
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    const double before_s = seconds();
    work();
    EXPECT_LT(seconds() - before_s, kMostSeconds) << of;
#if !defined(__SANITIZE_ADDRESS__)
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) {
            EXPECT_LT(std::stod(line.substr(6)) / 1024, kMostMegabytes) << of;
        }
#endif
}

}  // namespace vicon::test
