#pragma once

#include <vector>

#include "vicon/viewer/model/view_pose.h"

namespace vicon::viewer {

class FreeSpace;

/// What the user does with mouse and keys; each from -1 to 1. All zero: let go.
struct Steering {
    double pull = 0;        ///< along path and exit potential, 1: the way the camera heads, -1: back
    double turn_right = 0;  ///< turns the view
    double turn_up = 0;
    double thrust_forward = 0;  ///< moves the camera in its own axes
    double thrust_right = 0;
    double thrust_up = 0;
    double drift = 0;  ///< without `pull`: the two potentials alone lead on, 1: the way it heads, -1: back

    bool turns() const { return turn_right != 0 || turn_up != 0; }
    bool thrusts() const { return thrust_forward != 0 || thrust_right != 0 || thrust_up != 0; }
};

struct SubmarineState {
    Pose pose;
    Vector3 velocity_mm_s;
    double station_mm = 0;    ///< of its foot on the path
    double off_path_mm = 0;   ///< distance from the foot
    double clearance_mm = 0;  ///< from the wall
    bool carried = false;     ///< being carried over a collapsed or too narrow part
    bool at_end = false;      ///< at the end of the path that it heads for
    Heading heading = Heading::caecum;
};

/// The guided camera (thesis, section 3.3; Hong et al., Virtual Voyage, 1997): pulled along the distance from the exit,
/// pushed off the wall, steered by the user, back on its path when let go. Adrift, the thesis' submarine, nothing but
/// the two potentials moves it, and the path leads on only where they hold it fast. It moves in fixed steps of 1/240 s
/// whatever the frame rate; where it is between two steps is interpolated. Bridges and parts narrower than the camera
/// are crossed along the path, and the state says so; there it is never nearer to the wall than the path itself,
/// elsewhere never nearer than kCameraRadius_mm. Its way back leads round folds and to where the path is wide enough
/// for it.
class Submarine {
public:
    static constexpr double kTick_s = 1.0 / 240;
    // How it moves; chosen on bent tubes of 8 to 25 mm radius with folds, and on a real prone scan.
    static constexpr double kWallShare = 0.6;            ///< the wall pushes below this part of the lumen's radius
    static constexpr double kWallStrength_mm2_s2 = 100;  ///< how hard the wall pushes
    static constexpr double kCruise_mm_s = 30;           ///< speed at full pull
    static constexpr double kThrust_mm_s = 30;           ///< speed at full thrust by the user
    static constexpr double kFriction_per_s = 4;         ///< how fast speed fades
    static constexpr double kHoming_per_s = 6;           ///< how fast a camera that was let go is back on its path
    static constexpr double kTurning_deg_s = 90;         ///< speed of turning at full steering
    static constexpr double kRighting_per_s = 4;         ///< how fast the view turns back along the path

    /// Path, lumen and field must outlive it. Starts at the rectal end, heading for the caecum.
    /// Throws Error{unusable_scan} when no station of the path is wide enough.
    Submarine(const PathFrames& path, const Lumen& lumen, const FieldView& exit_distance);

    /// Puts it on the path, at rest, at the wide enough station nearest to this one.
    void placeAt(double station_mm, Heading heading);
    void setHeading(Heading heading) { now_.heading = heading; }
    /// Stays in force until the next call.
    void steer(const Steering& steering) { steering_ = steering; }
    /// Lets time pass.
    void advance(double seconds);
    SubmarineState state() const;

private:
    struct Moment {
        Point3 position_mm;
        Vector3 velocity_mm_s, spin_rad_s, forward, up;
        double station_mm = 0;
        bool carried = false;
        Heading heading = Heading::caecum;
    };

    void tick();
    void carry(double direction);
    bool startCarry();
    void move();
    void turn();
    Vector3 wayOn() const;
    /// Of the distance from the exit, over so many voxels to either side; of inside voxels only.
    Vector3 exitSlope(int voxels) const;
    double wantedPull() const { return steering_.pull != 0 ? steering_.pull : steering_.drift; }
    Vector3 pull() const;
    Vector3 drift() const;
    bool isAdrift();
    Vector3 pushOffWall() const;
    void home();
    void lookForWayHome();
    void step();
    FreeSpace space() const;
    bool wideAt(double station_mm) const;
    bool openAt(double station_mm) const;
    double sign() const { return now_.heading == Heading::caecum ? 1 : -1; }

    const PathFrames* path_;
    Lumen lumen_;
    LookAhead ahead_;
    FieldView exit_;
    Steering steering_;
    Moment now_, before_;
    double first_mm_ = 0, last_mm_ = 0;  // the stations between which the path can be flown
    std::vector<Point3> way_home_;       // places to make for, the next one last; empty: the foot
    double home_station_mm_ = 0;         // of the first of them
    long adrift_ticks_ = 0;
    double farthest_mm_ = 0;  // adrift: the farthest station so far, the way it heads
    long held_ticks_ = 0;     // since it got no farther
    double owed_s_ = 0;       // time that has passed since `now_`
};

}  // namespace vicon::viewer
