#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vicon/viewer/model/sight_lines.h"
#include "vicon/viewer/model/visibility.h"
#include "vicon/viewer/scene/prepared_scan.h"

namespace vicon::viewer {

/// What of a surface is to be drawn.
struct VisibleParts {
    bool everything = true;             ///< the rest does not count
    std::vector<int> segments;          ///< cells, in no order
    std::vector<std::uint8_t> patches;  ///< for each of patchesOf(surface) 1 or 0; empty: all those of `segments`
};

/// Which cells of a scan may be seen from an eye: the scan's subdivision and labels put to Visibility.
class CellVisibility {
public:
    /// Gates alone are worse at choosing (they let one look through folds) but there at once.
    enum class Means { gates, gates_and_sight_lines };

    /// Reads segments.mha and subdivision.json, and for sight lines also inside.mha and cells.vtp; those take about
    /// 0.5 s beyond the reading. Throws as PreparedScan does, and Error{cancelled} where `wanted` is no
    /// longer.
    explicit CellVisibility(const PreparedScan& scan, Means means = Means::gates_and_sight_lines,
                            const Progress* wanted = nullptr);

    /// The segment of the voxel that holds a point; 0 outside.
    int segmentAt(Point3 p) const;
    /// What to draw. Everything where the eye is outside the lumen or so near to the wall that the near plane cuts it.
    VisibleParts visibleFrom(const Pose& pose, const Lens& lens) const;
    /// Numbers of the segments to draw, without choosing among their patches; empty: all.
    std::vector<int> segmentsSeen(const Pose& pose, const Lens& lens) const;
    const Visibility& visibility() const { return visibility_; }

private:
    PreparedScan scan_;
    Visibility visibility_;
    struct CellPatches {
        int segment = 0;
        std::size_t first = 0, end = 0;  ///< of the surface's patches
    };
    std::vector<CellPatches> cells_;
    std::optional<SightLines> sight_lines_;
};

}  // namespace vicon::viewer
