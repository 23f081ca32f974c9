#pragma once

namespace vicon::viewer {

/// How coarse peeled pictures are while the eye moves, so that at least ten a second are shown: one ray for a square of
/// so many pixels a side, from what the rays of the pictures before took on this machine.
class PeelingPace {
public:
    static constexpr int kCoarsest = 6;

    /// @param first_s what a ray is thought to take before one was cast: 0.2 s for 300 x 300, a slow machine
    explicit PeelingPace(double first_s = 2.2e-6) : ray_s_(first_s) {}

    /// Pixels a side of a ray's square, 1 to kCoarsest, for a picture of this size.
    int coarseFor(int width, int height) const;
    /// A picture of this size took so long with that coarseness.
    void tell(int width, int height, int coarse, double seconds);

private:
    double ray_s_;
};

}  // namespace vicon::viewer
