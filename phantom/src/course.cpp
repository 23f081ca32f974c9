#include "course.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bead_chain.h"
#include "curve.h"
#include "loops.h"
#include "radii.h"
#include "relax.h"
#include "vicon/core/error.h"

namespace vicon::phantom {
namespace {

constexpr double kShortest = 1500, kLongest = 1900;  // usual length of a colon at CT, mm
constexpr int kAttempts = 60;

/// By how much the wall lies turned about the course; two positions differ by 80 degrees at most.
double turnIn(const CourseOptions& options)
{
    constexpr double kMostTurn = 40 * std::numbers::pi / 180;
    return Random(options.seed, "turned wall", std::uint64_t(options.position)).uniform(-kMostTurn, kMostTurn);
}

/// Which place of the patient's wall lies where on this course: evenly, or drawn out here and pushed together there
/// between the places where the colon is held, past which it slides a little.
PostureWarp layWall(const DrawnCourse& drawn, double wall_mm, const CourseOptions& options)
{
    constexpr double kSlide_mm = 7;
    const double length_mm = drawn.course.length_mm();
    std::vector<double> none(std::size_t(wall_mm) + 2, 0);
    if (!options.stretch)
        return heldWarp(none, {0, wall_mm}, {0, length_mm});
    Random slide(options.seed, "slide", std::uint64_t(options.position));
    const WayMarks marks;
    std::vector<double> wall{0}, station{0};
    for (const double stop : {marks.splenic_corner, marks.hepatic_corner}) {
        const auto n = std::size_t(stop);
        const double at = std::lerp(drawn.stop_station_mm[n], drawn.stop_station_mm[n + 1], stop - double(n));
        wall.push_back(at / length_mm * wall_mm);
        station.push_back(at + kSlide_mm * slide.normal());
    }
    wall.push_back(wall_mm);
    station.push_back(length_mm);
    return heldWarp(halfLogStretch(options.seed, options.position, wall_mm), wall, station);
}

std::optional<DrawnCourse> finish(std::vector<Bead> beads, const Trunk& trunk, const Relief& relief,
                                  const std::vector<double>& stops, const CourseOptions& options, Random& random)
{
    relax(beads, trunk, options.separation_mm, {});
    std::vector<Contact> contacts;
    if (options.thin_walls > 0 || options.self_contact) {
        const Course course = curveThrough(beads);
        if (options.self_contact)
            contacts = closestLoops(course, relief, 1, -2.5);
        else
            contacts = closestLoops(course, relief, options.thin_walls, options.thin_wall_mm);
        std::vector<BeadPair> pulled;
        for (const Contact& c : contacts) {
            const auto bead = [&](double f) {
                return std::clamp<std::size_t>(std::size_t(f * double(beads.size() - 1)), 4, beads.size() - 5);
            };
            pulled.push_back({bead(c.fraction_a), bead(c.fraction_b), 0});
            pulled.back().distance_mm = beads[pulled.back().a].radius_mm + beads[pulled.back().b].radius_mm + c.wall_mm;
        }
        relax(beads, trunk, options.separation_mm, pulled);
    }
    DrawnCourse drawn{curveThrough(beads), relief, trunk, contacts, {}, {}};
    drawn.stop_station_mm = stationsOnChain(beads, stops, drawn.course.length_mm());
    drawn.warp = layWall(drawn, relief.length_mm, options);
    drawn.relief =
        options.stretch ? warped(relief, drawn.warp, turnIn(options)) : stretched(relief, drawn.course.length_mm());
    shapeRadii(drawn.course, options.position, random);
    if (options.stretch)
        distend(drawn.course, options);
    limitSlope(drawn.course);
    narrowBetweenLoops(drawn.course, options.separation_mm, options.thin_wall_mm, contacts);
    smoothRadii(drawn.course);
    const bool as_wanted = int(contacts.size()) == (options.self_contact ? 1 : options.thin_walls);
    if (!as_wanted || narrowed(drawn.course, beads) || !closeContacts(drawn.course, contacts))
        return std::nullopt;
    if (!options.self_contact && !contacts.empty())  // widened loops may have come too near beside the contact
        narrowBetweenLoops(drawn.course, 0.8 * options.separation_mm, options.thin_wall_mm, contacts);
    if (!plausible(drawn.course, contacts, options.separation_mm))
        return std::nullopt;
    return drawn;
}

}  // namespace

std::size_t Course::sampleAt(double station_mm) const
{
    const double n = std::round(station_mm / step_mm);
    return std::size_t(std::clamp(n, 0.0, double(samples.size() - 1)));
}

DrawnCourse drawCourse(const CourseOptions& options)
{
    for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
        Random patient(options.seed, "patient", attempt);
        Trunk trunk;
        trunk.build = patient.uniform(0.97, 1.02);
        const double length_mm = patient.uniform(kShortest, kLongest);
        const std::vector<Bead> drawn_beads = beadsAlong(variedWay(patient), length_mm);
        const std::vector<double> stops = stopFractions(drawn_beads, usualWay().size());
        std::vector<Bead> beads = evenBeads(drawn_beads);
        const Relief relief = drawRelief(options.seed, length_mm, options.thinnest_fold_mm, options.polyps);
        // The patient is the same in every position: what lies on the back decides.
        CourseOptions on_back = options;
        on_back.position = Position::supine;
        Random radii(options.seed, "radii", attempt);
        auto supine = finish(beads, trunk, relief, stops, on_back, radii);
        if (!supine)
            continue;
        if (options.position == Position::supine)
            return *supine;
        relax(beads, trunk, options.separation_mm, {});
        for (std::uint64_t turn = 0; turn < kAttempts; ++turn) {
            std::vector<Bead> turned = beads;
            Random moved(options.seed, "turn", attempt * kAttempts + turn + 10000 * std::uint64_t(options.position));
            Trunk pressed = trunk;
            if (options.position == Position::prone)
                pressed.flatten_front = 14;
            turnOver(turned, options.position, moved);
            Random again(options.seed, "radii", attempt);
            if (auto drawn = finish(turned, pressed, relief, stops, options, again))
                return *drawn;
        }
    }
    throw Error(ErrorCode::internal, "no plausible colon could be drawn for seed " + std::to_string(options.seed), {},
                "use another seed");
}

}  // namespace vicon::phantom
