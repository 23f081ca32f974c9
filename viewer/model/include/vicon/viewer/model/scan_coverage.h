#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "vicon/viewer/model/coverage.h"

namespace vicon::viewer {

/// What of a scan's wall a reader has seen, in passes: what was seen before the present pass is what a reader wants
/// painted, for on the way back the wall in view would otherwise be painted the moment it is looked at. May be used
/// from several threads at once.
class ScanCoverage {
public:
    /// @param areas_mm2 of the surface's triangles, in order
    explicit ScanCoverage(std::vector<float> areas_mm2);

    void see(const std::vector<std::uint32_t>& triangles);
    /// These triangles are in the picture on the screen, and no others. Those that were on it for `least_s` without a
    /// break count as seen.
    /// @param now_s of any clock that runs on
    void show(std::vector<std::uint32_t> triangles, double now_s, double least_s);
    /// What was shown last is on the screen still.
    void stillShown(double now_s, double least_s);
    void forget();
    /// What has been seen by now counts as earlier from here on: the reader turned about, or looks elsewhere.
    void beginPass();

    double fraction() const;
    double seenArea_mm2() const;
    /// As it is now.
    Coverage coverage() const;
    /// Of each triangle, 1 where it is seen by now; else 0.
    std::vector<std::uint8_t> seenTriangles() const;
    /// Of each triangle, 1 where it was seen before the present pass; else 0.
    std::vector<std::uint8_t> earlier() const;

    /// A few bytes to be kept: a bit a triangle.
    std::string packed() const;
    /// Takes back what packed() gave, as seen earlier. False, and nothing changed, when the bytes are those of another
    /// surface or damaged.
    bool unpack(std::string_view bytes);

private:
    std::string header() const;

    mutable std::mutex mutex_;
    Coverage coverage_;
    std::vector<std::uint8_t> earlier_;
    std::vector<std::uint32_t> on_screen_;  // ascending
    std::vector<double> since_s_;           // of those
    std::uint64_t surface_ = 0;             // a checksum of the areas
};

}  // namespace vicon::viewer
