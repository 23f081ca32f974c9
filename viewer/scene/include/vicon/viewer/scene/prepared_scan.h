#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "vicon/core/colon_parts.h"
#include "vicon/core/progress.h"
#include "vicon/core/quantity.h"
#include "vicon/core/scan_quality.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/skeleton_tree.h"
#include "vicon/core/volume_view.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/projections_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/viewer/model/density_bricks.h"
#include "vicon/viewer/model/lumen.h"
#include "vicon/viewer/model/organ_words.h"
#include "vicon/viewer/model/path_frames.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {

/// A scan whose pipeline steps are done, as its folder holds it. Files are read when they are first asked for, and
/// kept; copies share them. Reading from several threads at once is safe.
class PreparedScan {
public:
    /// Throws Error{not_found} when there is no such folder, Error{not_ready} naming the first file that a picture
    /// needs and that the pipeline has not made yet.
    /// @param branch of an organ that branches: what skeleton() and frames() follow from the root; below 0: the way to
    ///        the tip that lies farthest from it
    static PreparedScan open(const std::filesystem::path& scan_folder, int branch = -1);

    const std::filesystem::path& folder() const;

    /// Reads what a flight needs now, on all cores, also of the mapped distances from the wall: a camera that flies
    /// does not wait for the disk. Throws as the functions below do, and Error{cancelled} where `wanted` is no
    /// longer.
    void readForFlight(const Progress* wanted = nullptr) const;
    /// Reads what else will be looked at soon: the distances from the exit, which pull the guided camera, and the
    /// densities. Throws as the functions below do, and Error{cancelled}.
    void readOn(const Progress& wanted) const;

    // Each throws Error{not_ready} where its file is missing, Error{bad_input} where it is damaged.
    const HuView& volume() const;                 ///< volume.mha
    const HuView* cleansed() const;               ///< cleansed.mha; nothing where no tagging was sought
    const InsideView& inside() const;             ///< inside.mha
    const FieldView& wallDistance() const;        ///< wall_distance.mha
    const FieldView& exitDistance() const;        ///< exit_distance.mha; only where there is a path
    const SegmentView& segments() const;          ///< segments.mha
    bool hasPath() const;                         ///< false: a cavity, skeleton() is empty
    const Skeleton& skeleton() const;             ///< skeleton.vtp; of a tree one way from the root
    const SkeletonTree& tree() const;             ///< skeleton.vtp; no branches where the organ is one path
    const CellSurface& cells() const;             ///< cells.vtp
    const Subdivision& subdivision() const;       ///< subdivision.json
    const Projection& coronalProjection() const;  ///< of projections/
    const PathFrames& frames() const;             ///< of the skeleton; of a cavity its widest place
    const ColonPartRanges& parts() const;         ///< of scan.json; empty where it knows none
    const LumenAlong& along() const;              ///< of scan.json's quality; empty where it has none
    const OrganWords& words() const;              ///< for the organ that scan.json names
    Quantity quantity() const;                    ///< of the volume, by scan.json
    /// For its slices, the default first: those of the organ, of MR those of this scan.
    std::vector<WindowLevel> windows() const;
    /// One of them. Throws Error{wrong_use} naming those there are.
    WindowLevel window(const std::string& name) const;
    bool canBeCleansed() const;           ///< cleansed() is something
    const DensityBricks& bricks() const;  ///< of the volume
    double gasEnds_hu() const;            ///< where the wall as acquired stands, see gasEndsOf_hu()
    bool hasOpenness() const;             ///< openness() answers at once
    /// Of the points of cells(), see opennessOf().
    const std::vector<float>& openness(const Progress* wanted = nullptr) const;
    bool hasTagging() const;  ///< tagging() answers at once
    /// Of the points of cells(), see taggingOf(), up to 2 on untrusted wall; empty
    /// where there is none on any wall.
    const std::vector<float>& tagging(const Progress* wanted = nullptr) const;
    /// The same of a part of them.
    std::vector<float> taggingOf(const CellSurface& surface, const Progress* wanted = nullptr) const;
    bool hasUntrustedWall() const;
    /// Standard deviation of the noise, as the pipeline measured it; 0: it did not.
    double noise_hu() const;
    Lumen lumen() const;  ///< of inside and wallDistance; valid while this object lives

private:
    struct Files;
    explicit PreparedScan(std::shared_ptr<Files> files);
    std::shared_ptr<Files> files_;
};

}  // namespace vicon::viewer
