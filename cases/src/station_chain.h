#pragma once

#include <array>
#include <vector>

#include "landmarks.h"
#include "profile_features.h"
#include "station_likeness.h"
#include "vicon/cases/station_map.h"

namespace vicon {

/// The chain: probabilities of every station of the second scan, of the speed there and of the wall's turn, at every
/// step along the first.
class StationChain {
public:
    static constexpr double kStep_mm = 10;  ///< along the first centreline
    static constexpr int kReach_mm = 130;   ///< to either side of the landmarks' place

    /// Throws Error{cancelled} where `wanted` is no longer; nothing: it always is.
    StationChain(const ColonProfile& from, const ColonProfile& to, const Progress* wanted);
    /// Whether there is any way through.
    bool passes() const { return passes_; }
    /// Whether the clearance of both scans is known, so that folds were compared.
    bool seesWall() const { return !here_.value[0].empty() && !there_.value[0].empty(); }
    /// Where it passes.
    StationMap map() const;

private:
    static constexpr int kSlowest = 5, kFastest = 15;  // mm of the second centreline to a step
    static constexpr std::size_t kSpeeds = kFastest - kSlowest + 1;
    static constexpr std::size_t kColumns = 2 * std::size_t(kReach_mm) + 1;
    static constexpr std::size_t kLayer = kSpeeds * kColumns;
    /// Of one step: a layer for each turn, in it a row of columns for each speed.
    using Plane = std::vector<float>;

    /// Columns of a row that lead to columns of the next step, and by how much further these lie.
    struct Reach {
        std::size_t from, to;
        long shift;
    };
    Reach reachOf(std::size_t node, std::size_t speed) const;
    const float* holdOf(std::size_t node) const { return &hold_[node * kColumns]; }
    void holdMarks(const std::vector<LandmarkPair>& marks);
    /// What landmarks and features of both say of a step at a speed: a row of it, by column.
    std::array<float, kColumns> evidence(std::size_t node, std::size_t turn, std::size_t speed) const;
    /// Whether something is to be seen where the step begins.
    bool seenAt(std::size_t node) const;
    /// By column: 1 where nothing is to be seen, else 0.
    std::vector<float> freeAt(std::size_t node) const;
    /// From each turn to the next.
    Plane turned(const Plane& plane, std::size_t node) const;
    void forward(const Progress* wanted);
    void backward(const Progress* wanted);
    /// A step against the way.
    Plane before(std::size_t node, const Plane& behind) const;
    StationInterval intervalAt(std::size_t node, const Plane& behind);

    const ColonProfile &from_, &to_;
    ProfileFeatures here_, there_;
    std::vector<double> node_mm_;
    std::vector<int> lowest_;   // station of a node's first column
    std::vector<float> hold_;   // what the landmarks say, by node and column
    StationLikeness likeness_;  // after what it is made of
    std::vector<Plane> ahead_;  // forward probabilities, by node; let go on the way back
    std::vector<StationInterval> passed_;
    bool passes_ = true;
};

}  // namespace vicon
