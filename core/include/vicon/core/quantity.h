#pragma once

#include "vicon/core/study.h"

namespace vicon {

/// What the numbers of a scan's volume.mha are.
enum class Quantity {
    density,  ///< HU, of CT
    signal,   ///< of MR: without a unit, comparable within one scan only
};

/// By the series' modality: MR has a signal, anything else that import takes has densities.
inline Quantity quantityOf(const Series& series)
{
    return series.modality == "MR" ? Quantity::signal : Quantity::density;
}

/// What the reader reads: "CT colonography" or "MR colonography".
inline const char* examinationOf(Quantity quantity)
{
    return quantity == Quantity::signal ? "MR colonography" : "CT colonography";
}

/// As a reader sees it behind a number: "HU", or "a.u." (arbitrary units).
inline const char* unitOf(Quantity quantity)
{
    return quantity == Quantity::signal ? "a.u." : "HU";
}

}  // namespace vicon
