#pragma once

#include "vicon/viewer/model/submarine.h"

namespace vicon::viewer {

/// `pose` with its view turned as it is steered.
Pose withViewTurned(const Pose& pose, const Steering& steering, double angle_rad);

/// Free flight of a cavity: no path and no exit, the potential of the wall alone (thesis, section 3.3). Steered by the
/// user, pushed off the wall, and never nearer to it than the camera's radius, wherever it starts with that room.
/// Moves in ticks of Submarine::kTick_s.
class FreeFlight {
public:
    /// The wall pushes what is nearer: a camera that is let go backs off so far. No case recorded: by the forces'
    /// balance full thrust brings the eye to 4 mm at 30 mm/s and to 2.7 mm at the most.
    static constexpr double kWallReach_mm = 8;

    /// The lumen's voxels must outlive it.
    explicit FreeFlight(const Lumen& lumen) : lumen_(lumen) {}

    void stop() { velocity_mm_s_ = {}; }
    /// @param speed_mm_s at full thrust, far from the wall
    void tick(Pose& pose, const Steering& steering, double speed_mm_s);
    /// Moves the eye at once, as far as the wall lets it.
    void moveBy(Pose& pose, Vector3 way_mm);

private:
    Vector3 pushOffWall(Point3 eye_mm) const;
    void backOff(Point3& eye_mm) const;

    Lumen lumen_;
    Vector3 velocity_mm_s_;
};

}  // namespace vicon::viewer
