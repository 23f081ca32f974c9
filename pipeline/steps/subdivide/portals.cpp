#include "subdivide/portals.h"

#include <tbb/parallel_for.h>
#include <vtkMath.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "grid/components.h"

namespace vicon::steps {
namespace {

/// Turns of the gate in its plane that are tried for the smallest area: every 5 degrees of a quarter.
constexpr int kTurns = 18;

/// What two segments share.
struct Contact {
    std::vector<Point3> corners_mm;  ///< of the shared faces, edges and corners of voxels
    std::vector<Point3> centres_mm;  ///< of the shared faces; of the shared edges and corners where there is no face
    double area_mm2 = 0;
    Vector3 across;  ///< sum of the shared faces' vectors from the first segment to the second
    std::size_t faces = 0;
};

using Contacts = std::map<std::pair<int, int>, Contact>;

/// Adds what voxel `v` shares with its neighbour at `step` (each component -1, 0 or 1).
void addShared(Contact& contact, const Grid& grid, Index3 v, std::array<int, 3> step, bool first_is_a)
{
    const std::array<double, 3> at{double(v.i), double(v.j), double(v.k)};
    const auto point = [&](const std::array<double, 3>& offset) {
        return grid.pointAt(ContinuousIndex3{at[0] + offset[0], at[1] + offset[1], at[2] + offset[2]});
    };
    const int moved = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
    for (int n = 0; n < 8; ++n) {
        std::array<double, 3> corner{};
        bool shared = true;
        for (std::size_t d = 0; d < 3; ++d) {
            corner[d] = n >> d & 1 ? 0.5 : -0.5;
            shared = shared && (step[d] == 0 || corner[d] * step[d] > 0);
        }
        if (shared)
            contact.corners_mm.push_back(point(corner));
    }
    const Point3 middle = point({step[0] * 0.5, step[1] * 0.5, step[2] * 0.5});
    if (moved > 1) {
        if (contact.faces == 0)
            contact.centres_mm.push_back(middle);
        return;
    }
    if (contact.faces++ == 0)
        contact.centres_mm.clear();
    contact.centres_mm.push_back(middle);
    for (std::size_t d = 0; d < 3; ++d)
        if (step[d] != 0) {
            const double area = grid.voxelVolume_mm3() / grid.spacing_mm[d];
            contact.area_mm2 += area;
            contact.across += grid.axis[d] * (area * step[d] * (first_is_a ? 1 : -1));
        }
}

Contacts findContacts(const SegmentVolume& segments)
{
    const Grid& grid = segments.grid;
    Contacts contacts;
    const auto compare = [&](Index3 v, Index3 w) {
        const int a = segments.at(v), b = segments.at(w);
        if (a != b && a && b)
            addShared(contacts[{std::min(a, b), std::max(a, b)}], grid, v, {w.i - v.i, w.j - v.j, w.k - v.k}, a < b);
    };
    const Components components(grid, segments.voxels);
    components.forTouchingRuns([&](const Run& p, const Run& q) {
        if (p.label == q.label)
            return;
        if (p.j == q.j && p.k == q.k) {
            compare({p.end - 1, p.j, p.k}, {q.begin, q.j, q.k});
            return;
        }
        for (int i = std::max(p.begin, q.begin - 1); i < std::min(p.end, q.end + 1); ++i)
            for (int m = std::max(i - 1, q.begin); m < std::min(i + 2, q.end); ++m)
                compare({i, p.j, p.k}, {m, q.j, q.k});
    });
    return contacts;
}

struct Frame {
    Point3 centre;
    Vector3 normal, u, v;
};

Vector3 anyAcross(Vector3 n)
{
    const Vector3 least = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? Vector3{1, 0, 0}
                          : std::abs(n.y) <= std::abs(n.z)                                 ? Vector3{0, 1, 0}
                                                                                           : Vector3{0, 0, 1};
    return normalized(cross(n, least));
}

/// The plane through the middle of the contact in which it is most nearly flat, its normal from a to b.
Frame planeOf(const Contact& contact)
{
    Frame frame;
    Vector3 sum;
    for (const Point3& p : contact.centres_mm)
        sum += p - Point3{};
    frame.centre = Point3{} + sum / double(contact.centres_mm.size());
    double matrix[3][3] = {}, values[3], vectors[3][3];
    for (const Point3& p : contact.centres_mm) {
        const Vector3 r = p - frame.centre;
        const double d[3] = {r.x, r.y, r.z};
        for (int m = 0; m < 3; ++m)
            for (int n = 0; n < 3; ++n)
                matrix[m][n] += d[m] * d[n];
    }
    double *rows[3] = {matrix[0], matrix[1], matrix[2]}, *columns[3] = {vectors[0], vectors[1], vectors[2]};
    vtkMath::Jacobi(rows, values, columns);
    frame.normal = {vectors[0][2], vectors[1][2], vectors[2][2]};
    // A line of faces, or a single one, is flat in many planes: its faces know which one.
    const bool flat = values[1] > 0.01 * values[0] && values[2] < 0.5 * values[1];
    if (!flat && length(contact.across) > 0)
        frame.normal = normalized(contact.across);
    if (dot(frame.normal, contact.across) < 0)
        frame.normal = -frame.normal;
    frame.u = anyAcross(frame.normal);
    frame.v = cross(frame.normal, frame.u);
    return frame;
}

struct Bounds {
    double low = 1e300, high = -1e300;
    void add(double x)
    {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    void widen(double by)
    {
        low -= by;
        high += by;
    }
};

/// Turns u and v in the plane to where the rectangle around the contact is smallest.
void turnToSmallest(Frame& frame, const Contact& contact)
{
    double smallest = 1e300;
    const Vector3 u = frame.u, v = frame.v;
    for (int n = 0; n < kTurns; ++n) {
        const double angle = M_PI / 2 * n / kTurns;
        const Vector3 x = u * std::cos(angle) + v * std::sin(angle), y = cross(frame.normal, x);
        Bounds bx, by;
        for (const Point3& p : contact.corners_mm) {
            bx.add(dot(p - frame.centre, x));
            by.add(dot(p - frame.centre, y));
        }
        if (const double area = (bx.high - bx.low) * (by.high - by.low); area < smallest - 1e-9) {
            smallest = area;
            frame.u = x;
            frame.v = y;
        }
    }
}

double diagonal_mm(const Grid& grid)
{
    return std::hypot(grid.spacing_mm[0], grid.spacing_mm[1], grid.spacing_mm[2]);
}

Portal portalOf(std::pair<int, int> between, const Contact& contact, const Grid& grid)
{
    Frame frame = planeOf(contact);
    turnToSmallest(frame, contact);
    Bounds bu, bv, bn;
    for (const Point3& p : contact.corners_mm) {
        bu.add(dot(p - frame.centre, frame.u));
        bv.add(dot(p - frame.centre, frame.v));
        bn.add(dot(p - frame.centre, frame.normal));
    }
    for (Bounds* bounds : {&bu, &bv, &bn})
        bounds->widen(diagonal_mm(grid));
    Portal portal{.segment_a = between.first,
                  .segment_b = between.second,
                  .centre_mm = frame.centre,
                  .normal = frame.normal,
                  .area_mm2 = contact.area_mm2,
                  .gate_mm = {},
                  .box_mm = {}};
    const std::array<std::pair<double, double>, 4> corner{
        std::pair(bu.low, bv.low), {bu.high, bv.low}, {bu.high, bv.high}, {bu.low, bv.high}};
    for (std::size_t n = 0; n < 4; ++n) {
        portal.gate_mm[n] = frame.centre + frame.u * corner[n].first + frame.v * corner[n].second;
        portal.box_mm[n] = portal.gate_mm[n] + frame.normal * bn.low;
        portal.box_mm[n + 4] = portal.gate_mm[n] + frame.normal * bn.high;
    }
    return portal;
}

bool followAlongSkeleton(const LabelledPiece& a, const LabelledPiece& b)
{
    constexpr double kSame_mm = 1e-6;  // stations differ by rounding alone
    return a.piece >= 0 && a.piece == b.piece && a.from_station_mm <= b.to_station_mm + kSame_mm &&
           b.from_station_mm <= a.to_station_mm + kSame_mm;
}

}  // namespace

std::vector<Portal> findPortals(const NumberedSegments& numbered)
{
    const Contacts found = findContacts(numbered.segments);
    std::vector<Contacts::const_pointer> contacts;
    for (const auto& contact : found)
        contacts.push_back(&contact);
    std::vector<Portal> portals(contacts.size());
    tbb::parallel_for(std::size_t(0), contacts.size(), [&](std::size_t n) {
        const auto& [between, contact] = *contacts[n];
        portals[n] = portalOf(between, contact, numbered.segments.grid);
        portals[n].along_skeleton = followAlongSkeleton(numbered.pieces[std::size_t(between.first) - 1],
                                                        numbered.pieces[std::size_t(between.second) - 1]);
    });
    return portals;
}

double thicknessOf(const Portal& portal, const Grid& grid)
{
    return distance(portal.box_mm[0], portal.box_mm[4]) - 2 * diagonal_mm(grid);
}

}  // namespace vicon::steps
