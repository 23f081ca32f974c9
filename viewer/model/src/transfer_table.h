#pragma once

#include <array>
#include <vector>

#include "vicon/viewer/model/transfer_function.h"

namespace vicon::viewer {

/// A transfer function for one length of step, looked up by density: half a HU fine, from -1100 to 3200 HU.
class TransferTable {
public:
    struct Entry {
        std::array<float, 3> colour{};
        float opacity = 0;  ///< of one step
    };

    TransferTable(const TransferFunction& function, double step_mm) : entries_(kEntries), next_shown_(kEntries)
    {
        for (std::size_t n = 0; n < kEntries; ++n) {
            const TransferPoint p = function.at(kLowest_hu + double(n) / kPerHu);
            entries_[n] = {{float(p.red), float(p.green), float(p.blue)},
                           float(1 - std::pow(1 - p.opacity_per_mm, step_mm))};
        }
        std::size_t next = kEntries;
        for (std::size_t n = kEntries; n-- > 0;) {
            if (entries_[n].opacity > 0)
                next = n;
            next_shown_[n] = next;
        }
    }

    const Entry& at(float density_hu) const { return entries_[placeOf(density_hu)]; }

    /// Whether any density of a range has opacity.
    bool shows(float lowest_hu, float highest_hu) const
    {
        return next_shown_[placeOf(lowest_hu)] <= placeOf(highest_hu);
    }

private:
    static std::size_t placeOf(float density_hu)
    {
        const float place = (density_hu - float(kLowest_hu)) * float(kPerHu) + 0.5F;
        return std::size_t(std::clamp(place, 0.F, float(kEntries - 1)));
    }

    static constexpr double kLowest_hu = -1100;
    static constexpr double kPerHu = 2;
    static constexpr std::size_t kEntries = 8600;
    std::vector<Entry> entries_;
    std::vector<std::size_t> next_shown_;  ///< of each entry: it or the first after it that has opacity
};

}  // namespace vicon::viewer
