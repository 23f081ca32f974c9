#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::steps {

/// A box of voxels, each of eight parts of gas, fluid or tissue: those which, blurred as the scan is, have the
/// densities that were measured, with little surface between them. Three materials that meet cannot be told from one
/// density, but from many together. Made once a thread, and filled for each box anew.
class Subvoxels {
public:
    static constexpr int kEdge = 32;   ///< of the box, voxels
    static constexpr int kReach = 2;   ///< of the blur, voxels
    static constexpr int kBorder = 3;  ///< so many voxels at the box's border cannot be solved

    /// What was measured of a voxel, or is believed of it at first.
    struct Voxel {
        float hu = 0;
        float fluid_hu = 0;      ///< the density of fluid here
        float tissue = 0;        ///< the fraction of tissue, 0 to 1
        bool is_solved = false;  ///< whether its parts may change
    };
    struct Scan {
        double gas_hu = 0, tissue_hu = 0;
        double noise_hu = 0;     ///< standard deviation
        double blur_voxels = 1;  ///< of the point spread, standard deviation
        Vector3 down{0, 1, 0};   ///< along the voxels' axes, of length 1
    };

    explicit Subvoxels(const Scan& scan);

    /// The number of a voxel of the box.
    static constexpr std::size_t voxel(int i, int j, int k)
    {
        return std::size_t(i) + kEdge * (std::size_t(j) + kEdge * std::size_t(k));
    }
    Voxel& at(int i, int j, int k) { return voxels_[voxel(i, j, k)]; }
    void solve();
    /// Whether the parts found, blurred, have nearly the density of a voxel and of those beside it.
    bool isExplained(int i, int j, int k) const;
    /// The fraction of tissue found in a voxel that was solved.
    float tissue(int i, int j, int k) const { return tissue_[voxel(i, j, k)]; }

private:
    enum Part : std::uint8_t { gas, fluid, tissue_part };
    static constexpr int kParts = 2 * kEdge;  // along an axis
    static constexpr std::size_t kLanes = 8;  // of the blur's five numbers, with three that are 0

    static constexpr std::size_t part(int i, int j, int k)
    {
        return std::size_t(i) + kParts * (std::size_t(j) + kParts * std::size_t(k));
    }

    void markNeeded();
    void setParts(int i, int j, int k);
    void blurParts();
    float weightOf(int part, int voxel) const;
    template <class ValueOf>
    void blur(std::vector<float>& out, ValueOf valueOf);
    int sweep(int number);
    bool settle(int i, int j, int k, int number);
    std::array<float, 3> surfaceOf(std::size_t n) const;
    float misfitGain(std::size_t first, const float* weights) const;
    void change(int i, int j, int k, std::uint8_t becomes, int number);
    float huOf(std::uint8_t part, std::size_t voxel) const;

    Scan scan_;
    std::array<std::array<float, 2 * kReach + 1>, 2> kernel_{};  ///< along an axis, of a voxel's lower and upper part
    std::array<std::array<float, 25 * kLanes>, 8> weights_{};    ///< of a part, on the rows of voxels around
    float weights_squared_ = 0;
    float per_hu2_ = 0, unexplained_hu_ = 0;
    /// What it costs to lie beside another part, by its place: any, fluid beside gas, and gas beside fluid.
    std::array<float, 27> beside_{}, fluid_beside_{}, gas_beside_{};
    std::vector<Voxel> voxels_;
    std::vector<std::uint8_t> is_needed_;
    std::vector<std::uint8_t> parts_;
    std::vector<float> residual_hu_;  ///< of the parts, blurred, beside what was measured; 0 where nothing is solved
    std::vector<float> tissue_;
    std::vector<std::uint8_t> touched_;  ///< number of the sweep in which something near a voxel changed last
    std::vector<float> by_slices_, by_rows_;
};

}  // namespace vicon::steps
