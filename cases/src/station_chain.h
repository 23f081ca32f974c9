#pragma once

#include <array>
#include <vector>

#include "landmarks.h"
#include "profile_features.h"
#include "vicon/cases/station_map.h"

namespace vicon {

/// The chain: probabilities of every station of the second scan, and of the speed there, at every step along the first.
class StationChain {
public:
    static constexpr double kStep_mm = 10;  ///< along the first centreline
    static constexpr int kReach_mm = 130;   ///< to either side of the landmarks' place

    StationChain(const ColonProfile& from, const ColonProfile& to);
    /// Whether there is any way through.
    bool passes() const;
    /// Whether the clearance of both scans is known, so that folds were compared.
    bool seesWall() const;
    /// Where it passes.
    StationMap map() const;

private:
    static constexpr int kSlowest = 5, kFastest = 15;  // mm of the second centreline to a step
    static constexpr int kSpeeds = kFastest - kSlowest + 1;
    using Speeds = std::array<float, kSpeeds>;

    static Speeds spread(const Speeds& before, bool free);
    std::size_t columns() const { return 2 * std::size_t(kReach_mm) + 1; }
    std::size_t cell(std::size_t node, int station) const
    {
        return node * columns() + std::size_t(station - lowest_[node]);
    }
    bool has(std::size_t node, int station) const
    {
        return station >= lowest_[node] && station < lowest_[node] + int(columns());
    }
    double nodeAt(std::size_t node) const { return from_.length_mm * double(node) / double(nodes_ - 1); }
    void placeWindows(const std::vector<LandmarkPair>& marks);
    void holdMarks(const std::vector<LandmarkPair>& marks);
    /// What speaks for the step from `station` on at a speed: features of both against each other.
    float evidence(std::size_t node, int station, int speed) const;
    /// What the features of two places say of their being one: a factor.
    float likenessOf(long here, long there) const;
    /// Compares the places along the first centreline with those within reach of the second.
    void compare();
    bool freeAt(std::size_t node, int station) const;
    void forward();
    void backward();
    StationInterval intervalAt(std::size_t node) const;

    const ColonProfile &from_, &to_;
    ProfileFeatures here_, there_;
    std::size_t nodes_;
    std::vector<int> lowest_;      // station of a node's first column
    std::vector<float> hold_;      // what the landmarks say, by cell
    std::vector<float> likeness_;  // of each sample along the first centreline, with every station it may lie at
    std::vector<Speeds> ahead_;    // forward probabilities, by cell
    std::vector<Speeds> behind_;   // backward ones
};

}  // namespace vicon
