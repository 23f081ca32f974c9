#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Neighbouring voxels of one row with the same label.
struct Run {
    int begin, end;  ///< i of the first voxel, and of the one after the last
    int j, k;
    std::uint16_t label;
    std::uint32_t component;
};

/// The 26-connected components of equally labelled voxels, as runs: a colon has a twentieth as many runs as voxels.
class Components {
public:
    /// @param label of every voxel of `grid`; 0 is background
    Components(const Grid& grid, const std::vector<std::uint16_t>& label);
    /// Of the voxels labelled `wanted` alone, with the label 1.
    Components(const InsideVolume& labels, std::uint8_t wanted);

    std::uint32_t count() const { return count_; }
    const std::vector<Run>& runs() const { return runs_; }
    /// The component of a voxel that is not background.
    std::uint32_t at(Index3 v) const;

    /// Calls visit(run, other) once for every two runs that touch (26-neighbours) in different rows, and for those that
    /// follow each other in a row.
    template <class Visit>
    void forTouchingRuns(Visit visit) const
    {
        for (int k = 0; k < size_[2]; ++k)
            for (int j = 0; j < size_[1]; ++j) {
                forFollowers(row(j, k), visit);
                for (const auto& [dj, dk] : kEarlierRows)
                    if (j + dj >= 0 && j + dj < size_[1] && k + dk >= 0)
                        forOverlaps(row(j, k), row(j + dj, k + dk), visit);
            }
    }

private:
    struct Range {
        std::uint32_t begin, end;
    };
    struct RowStep {
        int dj, dk;
    };
    // Geometry: the rows already looked at that touch a row.
    static constexpr RowStep kEarlierRows[] = {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

    Range row(int j, int k) const
    {
        const std::size_t n = std::size_t(j) + std::size_t(size_[1]) * std::size_t(k);
        return {row_start_[n], row_start_[n + 1]};
    }
    template <class Visit>
    void forFollowers(Range r, Visit& visit) const
    {
        for (std::uint32_t n = r.begin; n + 1 < r.end; ++n)
            if (runs_[n].end == runs_[n + 1].begin)
                visit(runs_[n], runs_[n + 1]);
    }
    template <class Visit>
    void forOverlaps(Range a, Range b, Visit& visit) const
    {
        for (std::uint32_t n = a.begin, from = b.begin; n < a.end; ++n) {
            while (from < b.end && runs_[from].end < runs_[n].begin)
                ++from;
            for (std::uint32_t m = from; m < b.end && runs_[m].begin <= runs_[n].end; ++m)
                visit(runs_[n], runs_[m]);
        }
    }

    template <class AddRow>
    void addRows(AddRow addRow);
    void numberComponents();

    std::array<int, 3> size_;
    std::vector<Run> runs_;
    std::vector<std::uint32_t> row_start_;
    std::uint32_t count_ = 0;
};

}  // namespace vicon::steps
