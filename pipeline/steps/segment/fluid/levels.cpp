#include "segment/fluid/levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "grid/along_axis.h"
#include "grid/byte_rows.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

// What a fluid level looks like. No case recorded; reason: from the scanner's point spread, up to 1 mm, and from
// gravity. Held by FluidLevels.AreFoundInEveryPosition. In the three cases (CONTRIBUTING.md) half and double keep the
// lumen to Dice 0.997, but for these: half of kFarthestStep loses an arm of 215 (0.991), half of kThickestStep_mm and
// double of kFlatShare, which no level meets, lose pools of ctc-prone and 215 (0.960).
constexpr int kFarthestStep = 5;   // voxels of the partial-volume layer
constexpr double kDeepest_mm = 4;  // how far under the level the fluid's own density is read
// Half-way to half-way of a blurred step is 1.1 mm at sigma 0.8; a wall is thicker.
constexpr double kThickestStep_mm = 1.6;
constexpr double kFlatWithin_voxels = 1;   // of the level's median
constexpr double kFlatShare = 0.7;         // of a patch's columns that must be flat
constexpr double kSmallestLevel_mm2 = 20;  // of a level's area: a puddle of 5 mm
/// Half-way density less than this many standard deviations below a pool's own: one voxel in 160 is a hole. A pool of
/// 300 HU at a noise of 60 HU, low dose, has 2.2; the prone scan of the reference data, 28 HU, has at least 2.7 in any
/// pool.
constexpr double kNoisy = 2.5;

Index3 moved(Index3 v, Down down, int steps)
{
    return beside(v, down.axis, down.sign * steps);
}

/// Where the densities between voxel n-1 and n pass `hu`, in voxels.
double crossing(double before, double after, int n, double hu)
{
    return after > before ? n - 1 + std::clamp((hu - before) / (after - before), 0.0, 1.0) : n;
}

/// How deep along gravity a place `level` voxels below a voxel lies, in voxels of the axis nearest to gravity.
float depthOf(const Grid& grid, Down down, Index3 voxel, double level)
{
    ContinuousIndex3 place{double(voxel.i), double(voxel.j), double(voxel.k)};
    (down.axis == 0 ? place.i : down.axis == 1 ? place.j : place.k) += down.sign * level;
    return float(dot(grid.pointAt(place) - grid.origin_mm, down.gravity) / grid.spacing_mm[std::size_t(down.axis)]);
}

/// The contact below a gas voxel, when the densities step from gas straight into something bright.
std::optional<Contact> contactBelow(const HuVolume& volume, Down down, const FluidDensities& densities, Index3 gas)
{
    const double spacing_mm = volume.grid.spacing_mm[std::size_t(down.axis)];
    const double upright = std::abs(dot(volume.grid.axis[std::size_t(down.axis)], down.gravity));
    const int deepest = kFarthestStep + int(std::lround(kDeepest_mm / spacing_mm));
    std::array<double, 64> hu{};
    const int count = std::min(deepest, 63);
    double brightest = -1e9;
    int first_bright = 0;
    for (int n = 0; n <= count; ++n) {
        const Index3 v = moved(gas, down, n);
        hu[std::size_t(n)] = volume.valueOr(v, kPaddingHu);
        if (n <= kFarthestStep && !first_bright && hu[std::size_t(n)] > densities.fluid_above_hu)
            first_bright = n;
        if (first_bright && n < first_bright + count - kFarthestStep)
            brightest = std::max(brightest, hu[std::size_t(n)]);
    }
    if (!first_bright)
        return std::nullopt;
    const double half = (densities.wall.tissue_hu + brightest) / 2;
    double leave_gas = 0, enter_fluid = 0, level = 0;
    const double middle = (hu[0] + brightest) / 2;
    int n = 1;
    for (; n <= count; ++n) {
        const double a = hu[std::size_t(n - 1)], b = hu[std::size_t(n)];
        if (a <= densities.wall.wall_hu && b > densities.wall.wall_hu)
            leave_gas = crossing(a, b, n, densities.wall.wall_hu);
        if (a <= middle && b > middle)
            level = crossing(a, b, n, middle);
        if (b >= half) {
            enter_fluid = crossing(a, b, n, half);
            break;
        }
    }
    if (n > count || (enter_fluid - leave_gas) * spacing_mm * upright > kThickestStep_mm)
        return std::nullopt;
    return Contact{gas, n, float(brightest), float(level), depthOf(volume.grid, down, gas, level)};
}

std::vector<Contact> findContacts(const HuVolume& volume, Down down, const FluidDensities& densities,
                                  const InsideVolume& labels)
{
    const auto [nx, ny, nz] = labels.grid.size;
    std::vector<std::vector<Contact>> slices(std::size_t(nz), std::vector<Contact>{});
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        for (int j = 0; j < ny; ++j) {
            const std::uint8_t* row = &labels.at({0, j, k});
            for (int i = firstOther(row, 0, nx, kOutside); i < nx; i = firstOther(row, i + 1, nx, kOutside)) {
                const Index3 v{i, j, k}, next = moved(v, down, 1);
                if (row[i] != kGas || !labels.grid.contains(next) || labels.at(next) == kGas)
                    continue;
                if (const auto contact = contactBelow(volume, down, densities, v))
                    slices[std::size_t(k)].push_back(*contact);
            }
        }
    });
    std::vector<Contact> contacts;
    for (const auto& slice : slices)
        contacts.insert(contacts.end(), slice.begin(), slice.end());
    return contacts;
}

/// Numbers of the contacts that each contact is joined to: neighbouring columns whose levels differ by little.
std::vector<std::uint32_t> joinContacts(const std::vector<Contact>& contacts, const Grid& grid, Down down)
{
    std::unordered_map<std::size_t, std::uint32_t> at;
    at.reserve(contacts.size() * 2);
    for (std::size_t n = 0; n < contacts.size(); ++n)
        at[grid.offset(contacts[n].gas)] = std::uint32_t(n);
    DisjointSets levels(contacts.size());
    for (std::size_t n = 0; n < contacts.size(); ++n)
        for (int axis = 0; axis < 3; ++axis)
            for (int step = -1; axis != down.axis && step <= 1; ++step) {
                Index3 v = contacts[n].gas;
                coordinate(v, axis) += 1;
                coordinate(v, down.axis) += step;
                const auto found = grid.contains(v) ? at.find(grid.offset(v)) : at.end();
                if (found != at.end())
                    levels.join(std::uint32_t(n), found->second);
            }
    std::vector<std::uint32_t> roots(contacts.size());
    for (std::size_t n = 0; n < roots.size(); ++n)
        roots[n] = levels.rootOf(std::uint32_t(n));
    return roots;
}

template <class Value>
double medianOf(const std::vector<Contact>& contacts, Value value)
{
    std::vector<float> values;
    for (const Contact& c : contacts)
        values.push_back(value(c));
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The density of the fluid under a level, whatever the noise: the highest of the medians over all columns at each
/// depth.
double densityBelow(const HuVolume& volume, Down down, const std::vector<Contact>& contacts)
{
    const int deepest = std::max(1, int(std::lround(kDeepest_mm / volume.grid.spacing_mm[std::size_t(down.axis)])));
    double density_hu = kPaddingHu;
    for (int n = 1; n <= deepest; ++n)
        density_hu = std::max(density_hu, medianOf(contacts, [&](const Contact& c) {
                                  const int steps = int(std::lround(c.below_voxels)) + n;
                                  return float(volume.valueOr(moved(c.gas, down, steps), kPaddingHu));
                              }));
    return density_hu;
}

/// Keeps what lies at the level of the most, and says whether that is a fluid's surface.
bool isLevel(ContactPatch& patch, const HuVolume& volume, Down down)
{
    const double face_mm2 = volume.grid.voxelVolume_mm3() / volume.grid.spacing_mm[std::size_t(down.axis)];
    if (double(patch.contacts.size()) * face_mm2 < kSmallestLevel_mm2)
        return false;
    const double level = medianOf(patch.contacts, [](const Contact& c) { return c.level_voxels; });
    const auto flat = [&](const Contact& c) { return std::abs(c.level_voxels - level) <= kFlatWithin_voxels; };
    const auto count = std::count_if(patch.contacts.begin(), patch.contacts.end(), flat);
    if (double(count) < kFlatShare * double(patch.contacts.size()))
        return false;
    std::erase_if(patch.contacts, [&](const Contact& c) { return !flat(c); });
    return true;
}

/// Sets the density of a level. The highest of each column is more than a standard deviation above the fluid's own:
/// that keeps pools apart (without it the prone scan of the reference data has 17 ml more of small bowel), but where
/// the noise is strong for the fluid it makes the pool fall to pieces (phantoms 205, 210).
void measureDensity(ContactPatch& patch, const HuVolume& volume, Down down, double tissue_hu, double noise_hu)
{
    const double highest_hu = medianOf(patch.contacts, [](const Contact& c) { return c.density_hu; });
    const double own_hu = densityBelow(volume, down, patch.contacts);
    patch.noisy = own_hu - (highest_hu + tissue_hu) / 2 < kNoisy * noise_hu;
    patch.density_hu = patch.noisy ? own_hu : highest_hu;
}

}  // namespace

Down downFor(const Grid& grid, Vector3 gravity)
{
    Down down;
    double most = -1;
    for (int a = 0; a < 3; ++a) {
        const double share = dot(grid.axis[std::size_t(a)], gravity);
        if (std::abs(share) > most) {
            most = std::abs(share);
            down = {a, share < 0 ? -1 : 1, normalized(gravity)};
        }
    }
    return down;
}

std::vector<ContactPatch> findFluidLevels(const HuVolume& volume, Down down, const FluidDensities& densities,
                                          double noise_hu, const InsideVolume& labels)
{
    const std::vector<Contact> contacts = findContacts(volume, down, densities, labels);
    const std::vector<std::uint32_t> root = joinContacts(contacts, labels.grid, down);
    std::vector<ContactPatch> patches;
    std::unordered_map<std::uint32_t, std::size_t> number;
    for (std::size_t n = 0; n < contacts.size(); ++n) {
        const auto [entry, is_new] = number.try_emplace(root[n], patches.size());
        if (is_new)
            patches.emplace_back();
        patches[entry->second].contacts.push_back(contacts[n]);
    }
    std::erase_if(patches, [&](ContactPatch& patch) { return !isLevel(patch, volume, down); });
    for (ContactPatch& patch : patches)
        measureDensity(patch, volume, down, densities.wall.tissue_hu, noise_hu);
    return patches;
}

}  // namespace vicon::steps
