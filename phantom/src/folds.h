#pragma once

#include <cstdint>
#include <vector>

namespace vicon::phantom {

/// A semilunar fold: a crescent of mucosa between two taeniae.
struct Fold {
    double station_mm = 0;
    int sector = 0;  ///< 0, 1, 2: which pair of taeniae it spans
    double depth_mm = 0;
    double thickness_mm = 0;
    double slant_mm = 0;  ///< how much further along the curve its one end lies than its middle
};

/// A polyp's place on the wall.
struct PolypSite {
    double station_mm = 0;
    double off_taenia = 0;  ///< angle from the first taenia
    double diameter_mm = 0;
};

/// The patient's own relief of the colon, the same in every position: where the taeniae run, rings of folds with
/// haustra between them, polyps. Stations are those of a colon `length_mm` long.
struct Relief {
    double length_mm = 0;
    std::vector<double> ring_mm;  ///< stations of the rings
    std::vector<Fold> folds;
    std::vector<PolypSite> polyps;
    double taenia_phase = 0;  ///< angle of the first taenia at station 0
    double taenia_turn = 0;   ///< radians per mm that the taeniae wind about the curve

    double taeniaAngle(double station_mm) const { return taenia_phase + taenia_turn * station_mm; }
};

/// Rings every 20 to 35 mm, folds 5 to 12 mm deep and 2 to 4 mm thick (at least `thinnest_mm`), polyps of 5 to 10 mm in
/// the haustra, clear of folds and of one another.
Relief drawRelief(std::uint64_t seed, double length_mm, double thinnest_mm, int polyps);

/// The same relief on a colon of another length.
Relief stretched(Relief relief, double length_mm);

/// A place on the wall, and how the curve bends there.
struct WallPlace {
    double station_mm = 0;
    double angle = 0;
    double radius_mm = 0;    ///< of the tube, without folds
    double bend_per_mm = 0;  ///< curvature of the axis towards this angle; below 0 on the outer side of a bend
};

/// Depth that folds take from the radius. On the inner side of a bend stations crowd together: folds are drawn wider
/// there along the axis so that they keep their thickness in space, and fade where they would run into one another.
double foldDepth_mm(const Relief& relief, const std::vector<Fold>& near, const WallPlace& place);

/// What is left of the radius beside the taeniae's grooves and between the haustra, at most 1.
double haustration(const Relief& relief, const std::vector<double>& rings_near, double station_mm, double angle);

/// Half the angle of a sector, in radians.
inline constexpr double kHalfSector = 1.0471975511965976;
/// The angle in [-pi, pi].
double wrapped(double angle);

}  // namespace vicon::phantom
