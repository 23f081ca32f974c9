#include "vicon/viewer/model/scan_coverage.h"

#include <algorithm>
#include <cstring>

namespace vicon::viewer {
namespace {

/// FNV-1a of the areas' bytes: two surfaces with the same triangles in the same order, and no others, agree.
std::uint64_t checksum(const std::vector<float>& areas)
{
    std::uint64_t sum = 14695981039346656037U;
    for (const float area : areas) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &area, sizeof bits);
        sum = (sum ^ bits) * 1099511628211U;
    }
    return sum;
}

}  // namespace

ScanCoverage::ScanCoverage(std::vector<float> areas_mm2)
    : coverage_({}), earlier_(areas_mm2.size(), 0), surface_(checksum(areas_mm2))
{
    coverage_ = Coverage(std::move(areas_mm2));
}

void ScanCoverage::see(const std::vector<std::uint32_t>& triangles)
{
    const std::lock_guard lock(mutex_);
    coverage_.see(triangles);
}

void ScanCoverage::show(std::vector<std::uint32_t> triangles, double now_s, double least_s)
{
    std::sort(triangles.begin(), triangles.end());
    {
        const std::lock_guard lock(mutex_);
        std::vector<double> since_s(triangles.size(), now_s);
        std::size_t before = 0;
        for (std::size_t n = 0; n < triangles.size(); ++n) {
            while (before < on_screen_.size() && on_screen_[before] < triangles[n])
                ++before;
            if (before < on_screen_.size() && on_screen_[before] == triangles[n])
                since_s[n] = since_s_[before];
        }
        on_screen_ = std::move(triangles);
        since_s_ = std::move(since_s);
    }
    stillShown(now_s, least_s);
}

void ScanCoverage::stillShown(double now_s, double least_s)
{
    constexpr double kRounding_s = 1e-9;
    const std::lock_guard lock(mutex_);
    std::vector<std::uint32_t> long_enough;
    for (std::size_t n = 0; n < on_screen_.size(); ++n)
        if (now_s - since_s_[n] >= least_s - kRounding_s)
            long_enough.push_back(on_screen_[n]);
    coverage_.see(long_enough);
}

void ScanCoverage::forget()
{
    const std::lock_guard lock(mutex_);
    on_screen_.clear();
    since_s_.clear();
    coverage_.forget();
    std::fill(earlier_.begin(), earlier_.end(), std::uint8_t(0));
}

void ScanCoverage::beginPass()
{
    const std::lock_guard lock(mutex_);
    for (std::size_t n = 0; n < earlier_.size(); ++n)
        earlier_[n] = coverage_.seen(n) ? 1 : 0;
}

double ScanCoverage::fraction() const
{
    const std::lock_guard lock(mutex_);
    return coverage_.fraction();
}

double ScanCoverage::seenArea_mm2() const
{
    const std::lock_guard lock(mutex_);
    return coverage_.seenArea_mm2();
}

Coverage ScanCoverage::coverage() const
{
    const std::lock_guard lock(mutex_);
    return coverage_;
}

std::vector<std::uint8_t> ScanCoverage::seenTriangles() const
{
    const std::lock_guard lock(mutex_);
    return coverage_.seenTriangles();
}

std::vector<std::uint8_t> ScanCoverage::earlier() const
{
    const std::lock_guard lock(mutex_);
    return earlier_;
}

std::string ScanCoverage::header() const
{
    return "vicon-seen 1 " + std::to_string(coverage_.triangleCount()) + " " + std::to_string(surface_) + "\n";
}

std::string ScanCoverage::packed() const
{
    const std::lock_guard lock(mutex_);
    std::string bytes = header();
    const std::size_t begin = bytes.size();
    bytes.resize(begin + (coverage_.triangleCount() + 7) / 8, '\0');
    for (std::size_t n = 0; n < coverage_.triangleCount(); ++n)
        if (coverage_.seen(n))
            bytes[begin + n / 8] = char(std::uint8_t(bytes[begin + n / 8]) | 1U << (n % 8));
    return bytes;
}

bool ScanCoverage::unpack(std::string_view bytes)
{
    {
        const std::lock_guard lock(mutex_);
        const std::string wanted = header();
        const std::size_t count = coverage_.triangleCount();
        if (bytes.substr(0, wanted.size()) != wanted || bytes.size() != wanted.size() + (count + 7) / 8)
            return false;
        bytes.remove_prefix(wanted.size());
        std::vector<std::uint32_t> seen;
        for (std::size_t n = 0; n < count; ++n)
            if (std::uint8_t(bytes[n / 8]) >> (n % 8) & 1U)
                seen.push_back(std::uint32_t(n));
        coverage_.see(seen);
    }
    beginPass();
    return true;
}

}  // namespace vicon::viewer
