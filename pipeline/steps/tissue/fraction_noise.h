#pragma once

#include <cmath>

#include "tissue/fluid_density.h"

namespace vicon::steps {

/// The standard deviation that the scan's noise gives the fraction of tissue. It is the larger the less tissue and what
/// lies beside it differ: in faintly tagged fluid several times that in gas.
class FractionNoise {
public:
    /// References must outlive it.
    FractionNoise(const Mixture& mixture, const FluidDensity& fluid, double noise_hu)
        : mixture_(mixture), fluid_(fluid), noise_hu_(noise_hu)
    {
    }

    double inGas() const { return noise_hu_ / (mixture_.tissue_hu - mixture_.gas_hu); }
    /// Where the fluid's density is not known: as in gas.
    double inFluid(Index3 v) const
    {
        const double fluid_hu = fluid_.at(v);
        return fluid_hu > 0 ? noise_hu_ / std::abs(fluid_hu - mixture_.tissue_hu) : inGas();
    }

private:
    const Mixture& mixture_;
    const FluidDensity& fluid_;
    double noise_hu_;
};

}  // namespace vicon::steps
