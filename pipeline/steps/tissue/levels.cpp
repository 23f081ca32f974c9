#include "tissue/levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include "grid/byte_rows.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

// Held by tissue_test: levels against walls at 30 to 150 degrees, at a blur of 0.7 mm and a noise of 20 HU. Half and
// double of each move the wall of ctc-prone by less than 0.004 mm in the mean and that of phantom 215 by less than
// 0.003 mm; kQuartiles, which is a fact of the Gaussian, by 0.019 and 0.011 mm.

/// Above and below a level the contents are pure from here on, and are read as far as there.
constexpr double kPure_mm = 1.8, kRead_mm = 3.2;
/// What pure contents may differ from what they should be: a part of the step between them.
constexpr double kImpure = 0.12;
/// A level's blur is the median over the columns of three bins of this edge, side by side: 24 mm.
constexpr double kBin_mm = 8;
/// A column's level differs from that of the column it was reached from by at most this, in voxels: fluid rises along a
/// wall by a millimetre or two.
constexpr double kSteepest = 0.5;
/// How much the density must rise over two voxels to tell a level in a column that is mostly wall.
constexpr double kLeastRise_hu = 250;
/// Bins with fewer columns tell nothing.
constexpr std::size_t kFewest = 6;
/// The plane goes on so far into the wall around: at a beach of 20 degrees the fluid is 2.5 mm deep by then.
constexpr double kBeyond_mm = 6.8;
/// Distance in sigma between a blurred step's quarter and its three quarters.
constexpr double kQuartiles = 1.349;
/// A blur that is fitted is kept within these: about half and double of the usual one.
constexpr double kNarrowest_mm = 0.35, kWidest_mm = 1.3;

/// A column of gas over fluid.
struct Contact {
    Index3 gas;           ///< the last voxel of gas
    bool fitted = false;  ///< pure on both sides, so that its blur is known
    bool crosses = false;
    float crossing = 0;  ///< depth at which the density passes that of tissue
    float sigma = 0;
    std::uint32_t patch = 0;
};

/// How many sigma from a blurred step's middle it has this part of its height.
double sigmasAt(double part)
{
    double low = -4, high = 4;
    while (high - low > 1e-3) {
        const double middle = (low + high) / 2;
        (0.5 * std::erfc(-middle / std::sqrt(2.0)) < part ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// Where a rising profile passes `value`, in elements; nothing where it does not.
std::optional<double> crossing(const std::vector<double>& profile, double value)
{
    for (std::size_t n = 1; n < profile.size(); ++n)
        if (profile[n - 1] <= value && profile[n] > value)
            return double(n - 1) + (value - profile[n - 1]) / (profile[n] - profile[n - 1]);
    return std::nullopt;
}

double medianOf(std::vector<float>& values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

class Finder {
public:
    Finder(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down, double usual_blur_mm)
        : mixture_(mixture),
          fluid_(fluid),
          down_(down),
          usual_blur_mm_(usual_blur_mm),
          spacing_mm_(mixture.inside.grid.spacing_mm[std::size_t(down.axis)]),
          pure_(std::max(1, int(std::ceil(kPure_mm / spacing_mm_)))),
          read_(std::max(pure_ + 1, int(std::ceil(kRead_mm / spacing_mm_))))
    {
    }

    FluidLevels run()
    {
        findContacts();
        FluidLevels levels;
        if (contacts_.empty())
            return levels;
        numberPatches();
        std::vector<float> sigmas;
        for (const Contact& contact : contacts_)
            if (contact.fitted)
                sigmas.push_back(contact.sigma);
        levels.fitted = sigmas.size();
        levels.sigma_voxels = sigmas.size() < kFewest ? usual_blur_mm_ / spacing_mm_ : medianOf(sigmas);
        sigma_ = levels.sigma_voxels;
        gatherBins();
        levels.columns = columns();
        return levels;
    }

private:
    struct BinKey {
        std::uint32_t patch;
        int a, b;
        auto operator<=>(const BinKey&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs here
    };
    struct ContactBin {
        std::vector<float> sigmas;
        double sigma = 0;
        bool known = false;
    };

    std::array<int, 2> sides() const { return {(down_.axis + 1) % 3, (down_.axis + 2) % 3}; }

    void findContacts()
    {
        const InsideVolume& inside = mixture_.inside;
        const auto [nx, ny, nz] = inside.grid.size;
        std::vector<std::vector<Contact>> slices(std::size_t(nz), std::vector<Contact>{});
        tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
            for (int j = 0; j < ny; ++j) {
                const std::uint8_t* row = &inside.at({0, j, k});
                for (int i = firstOther(row, 0, nx, kOutside); i < nx; i = firstOther(row, i + 1, nx, kOutside)) {
                    const Index3 v{i, j, k};
                    if (row[i] == kGas && inside.valueOr(down_.moved(v, 1), kOutside) == kFluid)
                        slices[std::size_t(k)].push_back(contactAt(v));
                }
            }
        });
        for (const auto& slice : slices)
            contacts_.insert(contacts_.end(), slice.begin(), slice.end());
    }

    /// Fits the column when it is pure on both sides.
    Contact contactAt(Index3 gas) const
    {
        Contact contact{.gas = gas};
        if (const auto depth = crossingNear(mixture_, down_, gas, pure_)) {
            contact.crosses = true;
            contact.crossing = float(*depth);
        }
        std::vector<double> profile;
        double above = 0, below = 0;
        int count = 0;
        for (int n = -read_; n <= read_ + 1; ++n) {
            const Index3 v = down_.moved(gas, n);
            const double hu = mixture_.hu(v);
            profile.push_back(hu);
            if (n > -pure_ && n <= pure_)
                continue;
            if (mixture_.inside.valueOr(v, kOutside) != (n <= 0 ? kGas : kFluid))
                return contact;
            (n <= 0 ? above : below) += hu;
            count += n <= 0 ? 1 : 0;
        }
        above /= count;
        below /= count;
        const double step = below - above;
        if (below < mixture_.tissue_hu || std::abs(above - mixture_.gas_hu) > kImpure * step)
            return contact;
        const auto quarter = crossing(profile, above + step / 4), half = crossing(profile, above + step / 2),
                   three = crossing(profile, above + step * 3 / 4);
        if (!quarter || !half || !three)
            return contact;
        contact.sigma = float((*three - *quarter) * down_.upright / kQuartiles);
        contact.fitted = contact.sigma * spacing_mm_ > kNarrowest_mm && contact.sigma * spacing_mm_ < kWidest_mm &&
                         std::abs(*half - read_ - 0.5) < pure_;
        return contact;
    }

    /// The crossing of a contact, the median of those around it; nothing where there are none.
    std::optional<double> crossingAround(const Contact& contact) const
    {
        std::vector<float> crossings;
        for (int a = -1; a <= 1; ++a)
            for (int b = -1; b <= 1; ++b)
                for (int step = -1; step <= 1; ++step) {
                    const Index3 v = beside(beside(down_.moved(contact.gas, step), sides()[0], a), sides()[1], b);
                    const auto found =
                        mixture_.inside.grid.contains(v) ? at_.find(mixture_.inside.grid.offset(v)) : at_.end();
                    if (found != at_.end() && contacts_[found->second].crosses)
                        crossings.push_back(contacts_[found->second].crossing);
                }
        if (crossings.empty())
            return std::nullopt;
        return medianOf(crossings);
    }

    /// Contacts that lie side by side, at most a voxel apart in depth, are one level.
    void numberPatches()
    {
        const Grid& grid = mixture_.inside.grid;
        at_.reserve(contacts_.size() * 2);
        for (std::size_t n = 0; n < contacts_.size(); ++n)
            at_[grid.offset(contacts_[n].gas)] = std::uint32_t(n);
        DisjointSets sets(contacts_.size());
        for (std::size_t n = 0; n < contacts_.size(); ++n)
            for (const int axis : sides())
                for (int step = -1; step <= 1; ++step) {
                    const Index3 v = beside(down_.moved(contacts_[n].gas, step), axis, 1);
                    const auto found = grid.contains(v) ? at_.find(grid.offset(v)) : at_.end();
                    if (found != at_.end())
                        sets.join(std::uint32_t(n), found->second);
                }
        for (std::size_t n = 0; n < contacts_.size(); ++n)
            contacts_[n].patch = sets.rootOf(std::uint32_t(n));
    }

    BinKey keyOf(const Contact& contact) const
    {
        const auto bin = [&](int axis) {
            return int(std::floor(coordinate(contact.gas, axis) * mixture_.inside.grid.spacing_mm[std::size_t(axis)] /
                                  kBin_mm));
        };
        return {contact.patch, bin(sides()[0]), bin(sides()[1])};
    }

    template <class Use>
    void forBinsAround(const BinKey& key, Use use) const
    {
        for (int a = -1; a <= 1; ++a)
            for (int b = -1; b <= 1; ++b)
                if (const auto found = bins_.find({key.patch, key.a + a, key.b + b}); found != bins_.end())
                    use(found->second);
    }

    void gatherBins()
    {
        for (const Contact& contact : contacts_) {
            ContactBin& bin = bins_[keyOf(contact)];
            if (contact.fitted)
                bin.sigmas.push_back(contact.sigma);
        }
        for (auto& [key, bin] : bins_) {
            std::vector<float> sigmas;
            forBinsAround(key, [&](const ContactBin& other) {
                sigmas.insert(sigmas.end(), other.sigmas.begin(), other.sigmas.end());
            });
            bin.known = sigmas.size() >= kFewest;
            if (bin.known)
                bin.sigma = medianOf(sigmas);
        }
    }

    /// The contacts' columns, then from each in turn those around it, each with the plane of the one it was reached
    /// from.
    std::vector<LevelColumn> columns() const
    {
        const Grid& grid = mixture_.inside.grid;
        std::vector<LevelColumn> found;
        std::unordered_map<std::size_t, bool> taken;
        taken.reserve(contacts_.size() * 4);
        for (const Contact& contact : contacts_) {
            const auto crossing = crossingAround(contact);
            LevelColumn column{contact.gas, 0, float(sigma_), 0};
            if (const ContactBin& bin = bins_.at(keyOf(contact)); bin.known)
                column.sigma = float(bin.sigma);
            column.fluid_hu = float(fluid_.at(down_.moved(contact.gas, pure_ + 1)));
            if (!crossing || column.fluid_hu <= 0)
                continue;
            column.depth = float(planeOf(*crossing, column, mixture_));
            column.at = onPlane(contact.gas, column.depth);
            if (grid.contains(column.at) && taken.try_emplace(grid.offset(column.at)).second)
                found.push_back(column);
        }
        const int beyond = int(std::lround(kBeyond_mm / spacing_mm_));
        for (std::size_t from = 0, step = 0; int(step) < beyond; ++step) {
            const std::size_t until = found.size();
            for (; from < until; ++from)
                for (const int axis : sides())
                    for (const int side : {-1, 1}) {
                        LevelColumn next = found[from];
                        next.at = onPlane(beside(next.at, axis, side), next.depth);
                        if (!grid.contains(next.at) || !taken.try_emplace(grid.offset(next.at)).second)
                            continue;
                        if (const auto crossing = crossingNear(mixture_, down_, next.at, 2))
                            next.depth = float(std::clamp(planeOf(*crossing, next, mixture_), next.depth - kSteepest,
                                                          next.depth + kSteepest));
                        next.at = onPlane(next.at, next.depth);
                        if (grid.contains(next.at))
                            found.push_back(next);
                    }
        }
        return found;
    }

    /// The voxel of a column in which the plane lies.
    Index3 onPlane(Index3 v, double depth) const
    {
        return down_.moved(v, int(std::lround((depth - down_.depth(v)) / down_.upright)));
    }

    const Mixture& mixture_;
    const FluidDensity& fluid_;
    const DownAxis& down_;
    double usual_blur_mm_, spacing_mm_, sigma_ = 0;
    int pure_, read_;  ///< voxels
    std::vector<Contact> contacts_;
    std::unordered_map<std::size_t, std::uint32_t> at_;  ///< contacts by their gas voxels
    std::map<BinKey, ContactBin> bins_;
};

}  // namespace

DownAxis::DownAxis(const Grid& grid, Vector3 gravity)
{
    double most = -1;
    for (int a = 0; a < 3; ++a) {
        const double share = dot(grid.axis[std::size_t(a)], gravity);
        if (std::abs(share) > most) {
            most = std::abs(share);
            axis = a;
            sign = share < 0 ? -1 : 1;
        }
    }
    const double unit_mm = grid.spacing_mm[std::size_t(axis)];
    per_voxel = {dot(grid.axis[0], gravity) * grid.spacing_mm[0] / unit_mm,
                 dot(grid.axis[1], gravity) * grid.spacing_mm[1] / unit_mm,
                 dot(grid.axis[2], gravity) * grid.spacing_mm[2] / unit_mm};
    upright = most;
}

std::optional<double> crossingNear(const Mixture& mixture, const DownAxis& down, Index3 v, int reach)
{
    std::optional<double> found;
    double nearest = reach + 1;
    for (int n = -reach; n <= reach; ++n) {
        const double a = mixture.hu(down.moved(v, n)), b = mixture.hu(down.moved(v, n + 1));
        if (a > mixture.tissue_hu || b <= mixture.tissue_hu)
            continue;
        const double at = n + (mixture.tissue_hu - a) / (b - a);
        if (std::abs(at - 0.5) < nearest && mixture.hu(down.moved(v, n + 2)) - a > kLeastRise_hu) {
            nearest = std::abs(at - 0.5);
            found = down.depth(v) + at * down.upright;
        }
    }
    return found;
}

double planeOf(double crossing, const LevelColumn& column, const Mixture& mixture)
{
    const double part = (mixture.tissue_hu - mixture.gas_hu) / (column.fluid_hu - mixture.gas_hu);
    return crossing - column.sigma * sigmasAt(part);
}

FluidLevels findLevels(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down, double usual_blur_mm)
{
    return Finder(mixture, fluid, down, usual_blur_mm).run();
}

}  // namespace vicon::steps
