#include "vicon/viewer/scene/prepared_scan.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "lumen_pages.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/description_file.h"
#include "vicon/scan_files/projections_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/stored_volume.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/viewer/model/acquired_wall.h"
#include "vicon/viewer/model/home_place.h"
#include "vicon/viewer/model/openness.h"
#include "vicon/viewer/model/wall_tagging.h"

namespace fs = std::filesystem;

namespace vicon::viewer {
namespace {

constexpr const char* kNeededByPictures[] = {"volume.mha", "inside.mha", "skeleton.vtp", "wall_distance.mha",
                                             "cells.vtp"};

void mustExist(const fs::path& file)
{
    if (!fs::exists(file))
        throw Error(ErrorCode::not_ready, "the pipeline has not made this file yet", file.string(),
                    "run 'vicon work' and see 'vicon show' for what stopped it");
}

}  // namespace

struct PreparedScan::Files {
    // Read once, when first asked for; a failed reading is tried again at the next call.
    template <class T>
    class Lazy {
    public:
        template <class Make>
        const T& get(Make make)
        {
            const std::lock_guard lock(mutex_);
            if (!value_)
                value_.emplace(make());
            return *value_;
        }

        /// It is there; false also while it is being made.
        bool known()
        {
            const std::unique_lock lock(mutex_, std::try_to_lock);
            return lock && value_;
        }

    private:
        std::mutex mutex_;
        std::optional<T> value_;
    };

    fs::path folder;
    Lazy<scan_files::StoredVolume<std::int16_t>> volume, cleansed;
    Lazy<scan_files::StoredVolume<std::uint8_t>> inside;
    Lazy<scan_files::StoredVolume<float>> wall_distance, exit_distance;
    Lazy<scan_files::StoredVolume<std::uint16_t>> segments;
    int branch = -1;
    Lazy<Skeleton> skeleton;
    Lazy<SkeletonTree> tree;
    Lazy<CellSurface> cells;
    Lazy<Subdivision> subdivision;
    Lazy<Projection> coronal;
    Lazy<PathFrames> frames;
    Lazy<ColonPartRanges> parts;
    Lazy<LumenAlong> along;
    Lazy<OrganWords> words;
    Lazy<StepResults> results;
    Lazy<Quantity> quantity;
    Lazy<double> gas_ends_hu;
    Lazy<std::unique_ptr<const DensityBricks>> bricks;
    Lazy<std::vector<float>> openness, tagging;

    fs::path at(const char* name) const
    {
        mustExist(folder / name);
        return folder / name;
    }

    const scan_files::StoredVolume<std::int16_t>& storedVolume()
    {
        return volume.get([&] { return scan_files::StoredVolume<std::int16_t>(at("volume.mha")); });
    }
    const scan_files::StoredVolume<float>& storedWallDistance()
    {
        return wall_distance.get([&] { return scan_files::StoredVolume<float>(at("wall_distance.mha")); });
    }
    const scan_files::StoredVolume<float>& storedExitDistance()
    {
        return exit_distance.get([&] { return scan_files::StoredVolume<float>(at("exit_distance.mha")); });
    }

    /// What the steps found, by scan.json.
    const StepResults& stepResults()
    {
        return results.get([&] { return resultsOf(scan_files::readDescription(folder).steps); });
    }
};

PreparedScan::PreparedScan(std::shared_ptr<Files> files) : files_(std::move(files)) {}

PreparedScan PreparedScan::open(const fs::path& scan_folder, int branch)
{
    if (!fs::is_directory(scan_folder))
        throw Error(ErrorCode::not_found, "no such scan folder", scan_folder.string(), "see 'vicon cases'");
    for (const char* name : kNeededByPictures)
        mustExist(scan_folder / name);
    auto files = std::make_shared<Files>();
    files->folder = scan_folder;
    files->branch = branch;
    return PreparedScan(std::move(files));
}

const fs::path& PreparedScan::folder() const
{
    return files_->folder;
}

void PreparedScan::readForFlight(const Progress* wanted) const
{
    const auto check = [&] {
        if (wanted)
            wanted->check();
    };
    tbb::parallel_invoke([&] { segments(); }, [&] { cells(); }, [&] { inside(); },
                         [&] {
                             subdivision();
                             wallDistance();
                             check();
                             if (hasPath())
                                 exitDistance();
                             check();
                             volume();
                         });
    bringInLumen(files_->storedWallDistance(), inside(), wanted);
}

void PreparedScan::readOn(const Progress& wanted) const
{
    constexpr std::size_t kAtOnce = std::size_t(1) << 22;  // voxels: some milliseconds of a slow disk
    if (hasPath())
        bringInLumen(files_->storedExitDistance(), inside(), &wanted);
    const auto& stored = files_->storedVolume();
    const std::size_t all = stored.view().voxels.size();
    for (std::size_t n = 0; n < all; n += kAtOnce) {
        wanted.check();
        stored.readAhead(n, std::min(n + kAtOnce, all));
    }
}

bool PreparedScan::canBeCleansed() const
{
    return fs::exists(files_->folder / "cleansed.mha");
}

const HuView* PreparedScan::cleansed() const
{
    if (!canBeCleansed())
        return nullptr;
    return &files_->cleansed
                .get([&] { return scan_files::StoredVolume<std::int16_t>(files_->folder / "cleansed.mha"); })
                .view();
}

const HuView& PreparedScan::volume() const
{
    return files_->storedVolume().view();
}

const InsideView& PreparedScan::inside() const
{
    return files_->inside.get([&] { return scan_files::StoredVolume<std::uint8_t>(files_->at("inside.mha")); }).view();
}

const FieldView& PreparedScan::wallDistance() const
{
    return files_->storedWallDistance().view();
}

const FieldView& PreparedScan::exitDistance() const
{
    return files_->storedExitDistance().view();
}

const SegmentView& PreparedScan::segments() const
{
    return files_->segments.get([&] { return scan_files::StoredVolume<std::uint16_t>(files_->at("segments.mha")); })
        .view();
}

const Skeleton& PreparedScan::skeleton() const
{
    return files_->skeleton.get([&] {
        if (files_->branch < 0)
            return scan_files::readSkeleton(files_->at("skeleton.vtp"));
        if (tree().empty())
            throw Error(ErrorCode::wrong_use, "the scan's organ has no branches", files_->folder.filename().string());
        return tree().pathTo(files_->branch);
    });
}

bool PreparedScan::hasPath() const
{
    return !skeleton().empty();
}

const SkeletonTree& PreparedScan::tree() const
{
    return files_->tree.get([&] { return scan_files::readSkeletonTree(files_->at("skeleton.vtp")); });
}

const CellSurface& PreparedScan::cells() const
{
    return files_->cells.get([&] { return scan_files::readCells(files_->at("cells.vtp")); });
}

const Subdivision& PreparedScan::subdivision() const
{
    return files_->subdivision.get([&] { return scan_files::readSubdivision(files_->at("subdivision.json")); });
}

const Projection& PreparedScan::coronalProjection() const
{
    return files_->coronal.get([&] { return scan_files::readProjection(files_->at("projections"), "coronal"); });
}

const PathFrames& PreparedScan::frames() const
{
    return files_->frames.get([&] {
        if (!hasPath())
            return PathFrames::withoutPath(homePlace(lumen(), wallDistance()));
        PathFrames frames(skeleton());
        frames.setTapers(!tree().empty());
        return frames;
    });
}

const ColonPartRanges& PreparedScan::parts() const
{
    return files_->parts.get([&] { return files_->stepResults().parts(); });
}

const LumenAlong& PreparedScan::along() const
{
    return files_->along.get([&] {
        const StepResults& results = files_->stepResults();
        return results.quality && results.quality->quality ? results.quality->quality->along : LumenAlong();
    });
}

const OrganWords& PreparedScan::words() const
{
    return files_->words.get([&] { return wordsFor(files_->stepResults().organ(), hasPath()); });
}

Quantity PreparedScan::quantity() const
{
    return files_->quantity.get([&] { return quantityOf(scan_files::readDescription(files_->folder).series); });
}

std::vector<WindowLevel> PreparedScan::windows() const
{
    if (quantity() == Quantity::density)
        return windowPresets(words().organ.name());
    const auto& segment = files_->stepResults().segment;
    const nlohmann::json measures = segment ? segment->measures : nlohmann::json::object();
    return signalWindows(measures.value("lumen_signal", 0.0), measures.value("tissue_signal", 0.0));
}

WindowLevel PreparedScan::window(const std::string& name) const
{
    if (quantity() == Quantity::density)
        return windowPreset(name);
    std::string names;
    for (const WindowLevel& window : windows()) {
        if (window.name == name)
            return window;
        names += (names.empty() ? "" : ", ") + window.name;
    }
    throw Error(ErrorCode::wrong_use, "there is no window of this name for MR", "'" + name + "'",
                "use one of " + names);
}

const DensityBricks& PreparedScan::bricks() const
{
    return *files_->bricks.get([&] { return std::make_unique<const DensityBricks>(volume()); });
}

double PreparedScan::gasEnds_hu() const
{
    return files_->gas_ends_hu.get([&] { return gasEndsOf_hu(scan_files::readDescription(files_->folder).steps); });
}

bool PreparedScan::hasOpenness() const
{
    return files_->openness.known();
}

const std::vector<float>& PreparedScan::openness(const Progress* wanted) const
{
    return files_->openness.get([&] { return opennessOf(cells().points_mm, cells().normals, lumen(), wanted); });
}

bool PreparedScan::hasTagging() const
{
    return files_->tagging.known();
}

const std::vector<float>& PreparedScan::tagging(const Progress* wanted) const
{
    return files_->tagging.get([&] { return taggingOf(cells(), wanted); });
}

std::vector<float> PreparedScan::taggingOf(const CellSurface& surface, const Progress* wanted) const
{
    if (quantity() != Quantity::density)
        return {};
    auto tagging = viewer::taggingOf(surface.points_mm, surface.normals, volume(), inside(), noise_hu(),
                                     tagDensitiesOf(scan_files::readDescription(files_->folder).steps), wanted);
    if (const StepResults& results = files_->stepResults(); results.tissue)
        addUntrusted(tagging, surface.points_mm, results.tissue->untrusted);
    constexpr float kSure = 0.5F;
    const bool any = std::ranges::any_of(tagging, [](float of) { return of > kSure; });
    return any ? tagging : std::vector<float>();
}

bool PreparedScan::hasUntrustedWall() const
{
    const StepResults& results = files_->stepResults();
    return results.tissue &&
           !(results.tissue->untrusted.mottled.blocks_mm.empty() && results.tissue->untrusted.faint.empty());
}

double PreparedScan::noise_hu() const
{
    const StepResults& results = files_->stepResults();
    return results.quality && results.quality->quality ? results.quality->quality->noise_hu : 0;
}

Lumen PreparedScan::lumen() const
{
    return {inside(), wallDistance()};
}

}  // namespace vicon::viewer
