#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid/brick_grid.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// Fronts that run through the inside voxels at unit speed: the first-order upwind solution of |grad T| = 1 between
/// 6-neighbours. Voxels wait in buckets half a voxel wide instead of a heap and are corrected when a better value
/// turns up later, so the fixed point is that of fast marching. Every voxel also carries a label.
class LumenFront {
public:
    // Definitions: what stands where no time, or no label, can.
    static constexpr float kOutsideTime = -1;
    static constexpr float kUnreached = std::numeric_limits<float>::max();
    static constexpr std::uint16_t kNoLabel = 0;

    enum class Labels {
        ignore,  ///< labels are neither asked nor given
        adopt,   ///< a voxel takes the label of the neighbour that its front comes from
        fixed,   ///< labels stay, and a front passes only between labels that differ by at most kSpan
    };
    static constexpr int kSpan = 2;  ///< labels: a front may leave its stretch for the next one and that after it

    /// Throws Error{no_memory}. `inside` must outlive the front. Voxels are told by their offsets in it.
    explicit LumenFront(const InsideVolume& inside);

    /// Makes all inside voxels unreached again; labels stay.
    void restart();
    /// Lets a front start from an inside voxel, unless one that is earlier has passed it.
    void seed(std::size_t voxel, float time_mm);
    void seed(std::size_t voxel, float time_mm, std::uint16_t label);
    /// Lets fronts of lower labels run ahead by so much a label, for seeds that are labelled along a path: then what is
    /// at work at one time lies together, and is in a cache. The outcome is the same but for ties.
    void runAheadByLabel(float ahead_mm) { ahead_mm_ = ahead_mm; }
    /// Runs until nothing moves. Labels::adopt overwrites labels of the voxels it reaches.
    void run(Labels labels);
    /// Goes on over edges and corners of voxels, which the 6-neighbour front does not pass, as far as that leads.
    void runOverCorners(Labels labels);

    /// Inside voxels that no front has reached, in order.
    std::vector<std::uint32_t> unreached() const;
    /// The unreached voxels 26-connected to an unreached one, in the order they were found.
    std::vector<std::uint32_t> componentOf(std::uint32_t voxel);

    const Grid& grid() const { return inside_.grid; }
    /// When a voxel was reached, mm; kOutsideTime, kUnreached.
    float timeAt(std::size_t voxel) const { return time_[placeOf(voxel)]; }
    /// The label of an inside voxel, kNoLabel where none was given.
    std::uint16_t labelAt(std::size_t voxel) const { return label_.empty() ? kNoLabel : label_[placeOf(voxel)]; }
    /// The times of all voxels. Throws Error{no_memory}.
    FieldVolume times() const;
    /// The labels of all voxels, kNoLabel outside. Throws Error{no_memory}.
    std::vector<std::uint16_t> labels() const;

private:
    /// An upwind neighbour along one axis: the earlier of the two.
    struct Upwind {
        float time;
        std::uint32_t axis;
    };
    float solveEikonal(std::array<Upwind, 3> up) const;
    std::uint32_t placeOf(std::size_t voxel) const { return bricks_.placeOf(inside_.grid.indexOf(voxel)); }
    template <Labels labels>
    void fetch(std::uint32_t place) const;
    template <Labels labels>
    void drain();
    template <Labels labels>
    void relax(std::uint32_t place, std::size_t bucket);
    void seedPlace(std::uint32_t place, float time_mm);
    template <class T>
    void spread(const std::vector<T>& at_place, std::vector<T>& voxels) const;
    void push(std::uint32_t place, std::size_t not_before);
    void setTime(std::uint32_t place, float time_mm)
    {
        reached_count_ += time_[place] == kUnreached;
        time_[place] = time_mm;
    }
    std::size_t bucketOf(std::uint32_t place) const
    {
        const float behind_mm = ahead_mm_ > 0 ? ahead_mm_ * float(label_[place]) : 0;
        return std::size_t((time_[place] + behind_mm) * per_bucket_);
    }

    const InsideVolume& inside_;
    BrickGrid bricks_;
    std::vector<float> time_;           ///< at each place
    std::vector<std::uint16_t> label_;  ///< at each place; empty before the first
    std::array<float, 3> spacing_;      ///< mm
    std::array<float, 3> per_square_;   ///< 1 over the spacing's square, 1/mm^2
    float tolerance_mm_;
    float per_bucket_;
    float ahead_mm_ = 0;
    std::vector<std::vector<std::uint32_t>> buckets_;  ///< of places
    std::size_t inside_count_ = 0, reached_count_ = 0;
    std::vector<bool> seen_;  ///< of componentOf(), all false between calls
};

/// The inside voxel whose centre is nearest to a point. Throws Error{bad_input} when there is none.
std::size_t nearestInside(const InsideVolume& inside, Point3 point);

}  // namespace vicon::steps
