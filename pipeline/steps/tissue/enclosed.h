#pragma once

#include "grid/neighbours.h"

namespace vicon::steps {

/// Along each line: a bubble of twice as many across is enclosed. No case recorded.
inline constexpr int kEnclosed_voxels = 4;
/// Of the 13 lines through a voxel; of those through a fold 4 lie in its own plane.
inline constexpr int kLinesOfEnclosed = 12;

/// Whether something lies on all sides of a voxel, within kEnclosed_voxels: isIt(Index3).
template <class IsIt>
bool isEnclosed(Index3 v, IsIt isIt)
{
    const auto reaches = [&](Index3 line, int sign) {
        for (int n = 1; n <= kEnclosed_voxels; ++n)
            if (isIt(along(v, line, sign * n)))
                return true;
        return false;
    };
    int lines = 0;
    for (std::size_t n = 0; n < kLines.size(); ++n) {
        lines += reaches(kLines[n], 1) && reaches(kLines[n], -1) ? 1 : 0;
        if (lines + int(kLines.size() - n) - 1 < kLinesOfEnclosed)
            return false;
    }
    return true;
}

}  // namespace vicon::steps
