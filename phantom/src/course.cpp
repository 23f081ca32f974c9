#include "course.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "curve.h"
#include "relax.h"
#include "vicon/core/error.h"

namespace vicon::phantom {
namespace {

constexpr double kBeadSpacing = 5;
constexpr double kShortest = 1500, kLongest = 1900;  // usual length of a colon at CT, mm
constexpr double kCurvatureGoal = 0.85;              // of radius x curvature; 0.9 is the limit
constexpr double kNarrowest = 0.62;                  // of the usual radius; narrower: redraw
constexpr double kSlope = 0.35;                      // greatest change of the radius along the curve
constexpr int kAttempts = 60;

/// The usual way, varied as patients vary.
std::vector<WayPoint> variedWay(Random& random)
{
    std::vector<WayPoint> way = usualWay();
    const double sag_mm = random.uniform(-10, 45), girth = random.uniform(0.95, 1.07);
    const Vector3 sigmoid{random.uniform(-20, 20), random.uniform(-12, 12), random.uniform(-5, 40)};
    for (std::size_t n = 0; n < way.size(); ++n) {
        WayPoint& stop = way[n];
        const double spread_mm = n < 2 ? 0 : 3 + 5 * stop.mobility;
        stop.position_mm += Vector3{random.normal(), random.normal(), random.normal()} * spread_mm;
        stop.radius_mm *= girth * random.uniform(0.92, 1.08);
        if (n >= 17 && n <= 23)
            stop.position_mm.z -= sag_mm * stop.mobility;
        if (n >= 4 && n <= 9)
            stop.position_mm += sigmoid * stop.mobility;
    }
    return way;
}

/// Beads along the way whose links together are `length_mm` long: what is mobile takes up the slack.
std::vector<Bead> beadsAlong(const std::vector<WayPoint>& way, double length_mm)
{
    std::vector<Point3> positions;
    std::vector<double> radii, mobilities;
    for (const WayPoint& stop : way) {
        positions.push_back(stop.position_mm);
        radii.push_back(stop.radius_mm);
        mobilities.push_back(stop.mobility);
    }
    const auto count = std::size_t(length_mm / kBeadSpacing);
    std::vector<Bead> beads(count);
    for (std::size_t n = 0; n < count; ++n) {
        const double at = double(n) / double(count - 1) * double(way.size() - 1);
        beads[n] = {splinePoint(positions, at), {}, splineValue(radii, at), splineValue(mobilities, at), 0};
        beads[n].anchor_mm = beads[n].position_mm;
    }
    double plain = 0, mobile = 0;
    for (std::size_t n = 0; n + 1 < count; ++n) {
        beads[n].rest_mm = distance(beads[n].position_mm, beads[n + 1].position_mm);
        plain += beads[n].rest_mm;
        mobile += beads[n].rest_mm * (0.05 + beads[n].mobility);
    }
    for (Bead& bead : beads)
        bead.rest_mm *= 1 + (length_mm - plain) / mobile * (0.05 + bead.mobility);
    return beads;
}

/// Where the stops of a way of `stops` points lie on its beads, as fractions of the length.
std::vector<double> stopFractions(const std::vector<Bead>& beads, std::size_t stops)
{
    std::vector<double> passed{0}, fractions;
    for (std::size_t n = 0; n + 1 < beads.size(); ++n)
        passed.push_back(passed.back() + beads[n].rest_mm);
    for (std::size_t stop = 0; stop < stops; ++stop)
        fractions.push_back(splineValue(passed, double(stop) / double(stops - 1) * double(beads.size() - 1)) /
                            passed.back());
    return fractions;
}

/// Stations of those fractions of the chain, whose links the relaxing may have stretched unevenly.
std::vector<double> stationsOnChain(const std::vector<Bead>& beads, const std::vector<double>& fractions,
                                    double length_mm)
{
    std::vector<double> passed{0}, stations;
    for (std::size_t n = 0; n + 1 < beads.size(); ++n)
        passed.push_back(passed.back() + distance(beads[n].position_mm, beads[n + 1].position_mm));
    for (const double fraction : fractions) {
        const double at = fraction * double(beads.size() - 1);
        const auto n = std::min(std::size_t(at), beads.size() - 2);
        stations.push_back(std::lerp(passed[n], passed[n + 1], at - double(n)) / passed.back() * length_mm);
    }
    return stations;
}

/// The chain again with links of even length: bending stiffness then means the same everywhere.
std::vector<Bead> evenBeads(const std::vector<Bead>& beads)
{
    double total = 0;
    for (std::size_t n = 0; n + 1 < beads.size(); ++n)
        total += beads[n].rest_mm;
    const auto count = std::size_t(total / kBeadSpacing) + 1;
    const double link = total / double(count - 1);
    std::vector<Bead> even;
    std::size_t n = 0;
    double passed = 0;
    for (std::size_t m = 0; m < count; ++m) {
        const double at = link * double(m);
        while (n + 2 < beads.size() && passed + beads[n].rest_mm < at)
            passed += beads[n++].rest_mm;
        const double t = std::clamp((at - passed) / beads[n].rest_mm, 0.0, 1.0);
        const Bead &a = beads[n], &b = beads[n + 1];
        even.push_back({interpolate(a.position_mm, b.position_mm, t), interpolate(a.anchor_mm, b.anchor_mm, t),
                        std::lerp(a.radius_mm, b.radius_mm, t), std::lerp(a.mobility, b.mobility, t), link});
    }
    return even;
}

/// Where gas rises to, the lumen is a little wider; where the colon bends or loops meet, it is narrower.
void shapeRadii(Course& course, Position position, Random& random)
{
    const Vector3 up = -gravityOf(position);
    std::vector<double> wander(course.samples.size() / 60 + 4);
    for (double& value : wander)
        value = 1 + 0.07 * std::clamp(random.normal(), -2.0, 2.0);
    for (std::size_t n = 0; n < course.samples.size(); ++n) {
        CourseSample& s = course.samples[n];
        s.radius_mm *=
            splineValue(wander, double(n) / 60 + 1) * (1 + 0.06 * std::tanh(dot(s.position_mm - Point3{}, up) / 60));
        if (s.curvature > 0)
            s.radius_mm = std::min(s.radius_mm, kCurvatureGoal / s.curvature);
    }
}

bool inContact(const std::vector<Contact>& contacts, double fraction_a, double fraction_b, double length_mm)
{
    constexpr double kReach = 40;
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return std::abs(c.fraction_a - fraction_a) * length_mm < kReach &&
               std::abs(c.fraction_b - fraction_b) * length_mm < kReach;
    });
}

/// Calls `visit(a, b, distance)` for samples of different loops, every `stride`-th sample.
void eachLoopPair(const Course& course, std::size_t stride, auto&& visit)
{
    const auto& s = course.samples;
    for (std::size_t a = 0; a < s.size(); a += stride)
        for (std::size_t b = a + stride; b < s.size(); b += stride) {
            const double along = course.step_mm * double(b - a);
            const Vector3 apart = s[b].position_mm - s[a].position_mm;
            if (dot(apart, apart) < 90 * 90 && along >= loopDistance_mm(s[a].radius_mm, s[b].radius_mm))
                visit(a, b, length(apart));
        }
}

void limitSlope(Course& course)
{
    auto& s = course.samples;
    const double step = kSlope * course.step_mm;
    for (std::size_t n = 1; n < s.size(); ++n)
        s[n].radius_mm = std::min(s[n].radius_mm, s[n - 1].radius_mm + step);
    for (std::size_t n = s.size() - 1; n-- > 0;)
        s[n].radius_mm = std::min(s[n].radius_mm, s[n + 1].radius_mm + step);
}

/// Narrows loops that lie too close together.
void narrowBetweenLoops(Course& course, double separation_mm, double least_wall_mm,
                        const std::vector<Contact>& contacts)
{
    auto& s = course.samples;
    const double last = double(s.size() - 1), length_mm = course.length_mm();
    std::vector<double> limit(s.size(), 1e9);
    eachLoopPair(course, 2, [&](std::size_t a, std::size_t b, double apart) {
        const bool touching = inContact(contacts, double(a) / last, double(b) / last, length_mm);
        const double excess = s[a].radius_mm + s[b].radius_mm + (touching ? least_wall_mm : separation_mm) - apart;
        if (excess <= 0)
            return;
        limit[a] = std::min(limit[a], s[a].radius_mm - excess / 2);
        limit[b] = std::min(limit[b], s[b].radius_mm - excess / 2);
    });
    for (std::size_t n = 0; n < s.size(); ++n)
        s[n].radius_mm = std::min(s[n].radius_mm, limit[n]);
    limitSlope(course);
}

void smoothRadii(Course& course)
{
    auto& s = course.samples;
    constexpr int kReach = 12;
    std::vector<double> smooth(s.size());
    for (int n = 0; n < int(s.size()); ++n) {
        double sum = 0, weights = 0;
        for (int m = std::max(0, n - kReach); m <= std::min(int(s.size()) - 1, n + kReach); ++m) {
            const double w = std::exp(-0.5 * (m - n) * (m - n) / 16.0);
            sum += w * s[std::size_t(m)].radius_mm;
            weights += w;
        }
        smooth[std::size_t(n)] = sum / weights;
    }
    for (std::size_t n = 0; n < s.size(); ++n)
        s[n].radius_mm = smooth[n];
}

/// Widens both loops at each contact until just the wanted wall is left between them. False where that is too much.
bool closeContacts(Course& course, const std::vector<Contact>& contacts)
{
    auto& s = course.samples;
    const double last = double(s.size() - 1), length_mm = course.length_mm();
    for (const Contact& contact : contacts) {
        std::size_t a = 0, b = 0;
        double slack = 1e9;
        eachLoopPair(course, 1, [&](std::size_t i, std::size_t j, double apart) {
            if (inContact({contact}, double(i) / last, double(j) / last, length_mm) &&
                apart - s[i].radius_mm - s[j].radius_mm < slack) {
                slack = apart - s[i].radius_mm - s[j].radius_mm;
                a = i, b = j;
            }
        });
        const double widen = (slack - contact.wall_mm) / 2;
        if (slack > 1e8 || std::abs(widen) > 5)
            return false;
        for (std::size_t n = 0; n < s.size(); ++n)
            for (const std::size_t centre : {a, b}) {
                const double d = (double(n) - double(centre)) / 12;
                s[n].radius_mm += widen * std::exp(-0.5 * d * d);
            }
    }
    return true;
}

bool plausible(const Course& course, const std::vector<Contact>& contacts, double separation_mm)
{
    const auto& s = course.samples;
    const double last = double(s.size() - 1), length_mm = course.length_mm();
    for (const CourseSample& sample : s)
        if (sample.radius_mm * sample.curvature >= 0.9 || sample.radius_mm < 8.5)
            return false;
    bool apart_enough = true;
    eachLoopPair(course, 2, [&](std::size_t a, std::size_t b, double apart) {
        if (!inContact(contacts, double(a) / last, double(b) / last, length_mm))
            apart_enough &= apart >= s[a].radius_mm + s[b].radius_mm + 0.8 * separation_mm;
    });
    return apart_enough;
}

/// The places where loops come closest, far from one another.
std::vector<Contact> closestLoops(const Course& course, const Relief& relief, int count, double wall_mm)
{
    const auto& s = course.samples;
    const double last = double(s.size() - 1);
    const auto nearPolyp = [&](double fraction) {
        return std::any_of(relief.polyps.begin(), relief.polyps.end(), [&](const PolypSite& polyp) {
            return std::abs(polyp.station_mm - fraction * relief.length_mm) < 38;
        });
    };
    std::vector<Contact> found;
    for (int n = 0; n < count; ++n) {
        std::optional<Contact> best;
        double least = 1e9;
        eachLoopPair(course, 3, [&](std::size_t a, std::size_t b, double apart) {
            const double slack = apart - s[a].radius_mm - s[b].radius_mm;
            const double fa = double(a) / last, fb = double(b) / last;
            const bool usable = slack < least && fa > 0.08 && fb < 0.95 && (fb - fa) * course.length_mm() > 130 &&
                                !nearPolyp(fa) && !nearPolyp(fb) &&
                                std::none_of(found.begin(), found.end(), [&](const Contact& c) {
                                    const auto near = [](double p, double q) { return std::abs(p - q) < 0.06; };
                                    return near(c.fraction_a, fa) || near(c.fraction_b, fb) || near(c.fraction_a, fb) ||
                                           near(c.fraction_b, fa);
                                });
            if (usable) {
                least = slack;
                best = Contact{fa, fb, wall_mm};
            }
        });
        if (best)
            found.push_back(*best);
    }
    return found;
}

bool narrowed(const Course& course, const std::vector<Bead>& beads)
{
    for (std::size_t n = 0; n < course.samples.size(); ++n) {
        const std::size_t bead = n * (beads.size() - 1) / (course.samples.size() - 1);
        if (course.samples[n].radius_mm < kNarrowest * beads[bead].radius_mm)
            return true;
    }
    return false;
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
    DrawnCourse drawn{curveThrough(beads), relief, trunk, contacts, {}};
    drawn.stop_station_mm = stationsOnChain(beads, stops, drawn.course.length_mm());
    drawn.relief = stretched(relief, drawn.course.length_mm());
    shapeRadii(drawn.course, options.position, random);
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

/// Turning over: the mobile parts shift, the front is pressed flat.
void turnOver(std::vector<Bead>& beads, Position position, Random& random)
{
    const Vector3 down = gravityOf(position);
    std::vector<Point3> shift(beads.size() / 14 + 4);
    for (Point3& s : shift)
        s = Point3{} + Vector3{random.normal(), random.normal(), random.normal()} * 7.0;
    for (std::size_t n = 0; n < beads.size(); ++n) {
        const Vector3 wander = splinePoint(shift, double(n) / 14 + 1) - Point3{};
        beads[n].anchor_mm = beads[n].position_mm += (wander + down * 6.0) * (0.25 + 0.75 * beads[n].mobility);
        if (n == 0)
            beads[n].anchor_mm = beads[n].position_mm = beads[n].position_mm - (wander + down * 6.0) * 0.25;
    }
}

}  // namespace

std::size_t Course::sampleAt(double station_mm) const
{
    const double n = std::round(station_mm / step_mm);
    return std::size_t(std::clamp(n, 0.0, double(samples.size() - 1)));
}

double loopDistance_mm(double radius_a_mm, double radius_b_mm)
{
    return 2.1 * (radius_a_mm + radius_b_mm);
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
