#pragma once

#include <optional>

#include "vicon/viewer/model/free_flight.h"
#include "vicon/viewer/model/submarine.h"

namespace vicon::viewer {

/// planned: along the path; guided: the submarine; free: wherever the user steers, but not through the wall.
enum class NavigationMode { planned, guided, free };

struct NavigationState {
    Pose pose;
    double station_mm = 0;
    double clearance_mm = 0;
    bool carried = false;  ///< over a collapsed or too narrow part
    bool at_end = false;   ///< of the path, in the direction of flight
};

/// Where the reading room's eye is, and how it moves. In a cavity, which has no path, it is free, pushed off the wall,
/// and no other mode is taken. Time is given by the caller in steps of any length: what is
/// reached after a time does not depend on them.
class Navigator {
public:
    static constexpr double kLeastSpeed_mm_s = 5, kMostSpeed_mm_s = 100;

    /// Everything must outlive it. Throws Error{unusable_scan} when no station of the path is wide enough.
    /// @param exit_distance nothing where `path` is none
    Navigator(const PathFrames& path, const Lumen& lumen, const std::optional<FieldView>& exit_distance);

    /// Whether a path leads through the organ.
    bool hasPath() const { return path_->isPath(); }
    NavigationMode mode() const { return mode_; }
    /// Stays at the station where the eye is; free begins with the eye as it is. Without a path: does nothing.
    void setMode(NavigationMode mode);
    Heading heading() const { return heading_; }
    void setHeading(Heading heading);
    bool looksBack() const { return look_back_; }
    /// Turns the view about without changing the way of flight; planned only.
    void setLookBack(bool on) { look_back_ = on; }
    double speed_mm_s() const { return speed_mm_s_; }
    /// Planned, on a straight way; in bends the flight is slower, so that the view turns by 90 degrees a second at
    /// most. Clamped to the least and the most.
    void setSpeed(double mm_s);
    /// 1 along the heading, -1 backwards, 0 stop; planned and guided, where it is adrift then.
    void fly(int direction) { direction_ = direction; }
    int direction() const { return direction_; }
    /// Guided and free; stays in force until the next call.
    void steer(const Steering& steering) { steering_ = steering; }
    /// Whether the reader has it fly or steers it; else it rests, or is adrift.
    bool isDriven() const { return direction_ != 0 || steering_.turns() || steering_.thrusts(); }

    /// Goes to a station at once and stops there; without a path to the home place.
    void jumpTo(double station_mm);
    /// Along the path, or without one the way it looks, as far as the wall lets it.
    void step(double mm);
    /// Without a path: moves the eye, as far as the wall lets it.
    void moveBy(Vector3 way_mm);
    /// Shows a view: free, at that pose. Where its eye is outside the lumen, the station's own view is shown instead.
    /// @param station_mm of the view; the eye alone does not tell between loops that touch
    void lookFrom(const Pose& pose, double station_mm);

    /// Where the eye is, and in which mode.
    struct Place {
        NavigationMode mode = NavigationMode::planned;
        double station_mm = 0;
        bool looks_back = false;
        Pose free;
    };
    Place place() const { return {mode_, state().station_mm, look_back_, free_}; }
    /// After lookFrom(): as it was before, at rest.
    void goBackTo(const Place& place);

    void advance(double seconds);
    NavigationState state() const;

private:
    void advancePlanned(double seconds);
    double speedAt_mm_s(double station_mm) const;
    void tickFree();
    Pose poseHere() const;
    double sign() const { return heading_ == Heading::caecum ? 1 : -1; }

    const PathFrames* path_;
    Lumen lumen_;
    LookAhead ahead_;
    std::optional<Submarine> submarine_;  ///< nothing without a path
    FreeFlight free_flight_;
    NavigationMode mode_ = NavigationMode::planned;
    Heading heading_ = Heading::caecum;
    Steering steering_;
    bool look_back_ = false;
    int direction_ = 0;
    double speed_mm_s_ = 30;
    double station_mm_ = 0;
    Pose free_;
    double owed_s_ = 0;  // of a tick, free
};

}  // namespace vicon::viewer
