#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "published_file.h"
#include "vicon/core/file.h"
#include "vicon/core/quantity.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"
#include "vicon/scan_files/itk_globals.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/densities_around.h"
#include "vicon/steps/largest.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/tissue.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::pipeline {

/// The results of a scan as the steps hand them on: kept in memory when they were just made, read when they were made
/// by an earlier run. Steps that run at the same time share it. Volumes are written in the background, so that the
/// next step need not wait for the disk; finish() does.
class ScanResults {
public:
    /// @param folder of the scan
    /// @param claim folder of the files that this claim of the job makes, until publish() puts them into the scan's
    /// @param quantity of volume.mha; where it is a signal, the steps after segment read lumen_scale.mha in its place
    ScanResults(std::filesystem::path folder, std::filesystem::path claim, Quantity quantity)
        : folder_(std::move(folder)), claim_(std::move(claim)), quantity_(quantity)
    {
        scan_files::makeItkGlobals();  // volumes are written beside the steps
        makePrivateFolder(claim_ / "projections");
    }
    ~ScanResults()
    {
        largest_wall_distance_ = {};  // waits, as the others do; it may begin to write
        flood_ = {};
        writing_.clear();
        std::error_code ignored;
        std::filesystem::remove_all(claim_, ignored);
    }
    ScanResults(const ScanResults&) = delete;
    ScanResults& operator=(const ScanResults&) = delete;

    /// Where a file is written.
    std::filesystem::path target(const std::string& file) const { return claim_ / file; }
    /// Where a file is read: as this claim made it, else as an earlier one did.
    std::filesystem::path source(const std::string& file) const
    {
        return std::filesystem::exists(claim_ / file) ? claim_ / file : folder_ / file;
    }
    /// Puts files that are on the disk into the scan's folder, each whole. They stay readable where they were made.
    void publish(const std::vector<std::string>& files) const
    {
        for (const std::string& file : files)
            if (std::filesystem::exists(claim_ / file))
                publishFile(claim_ / file, folder_ / file);
    }

    const HuVolume& volume() { return get(volume_, "volume.mha"); }
    /// The part of volume(), or of a signal on the lumen's scale, around the lumen; the whole need not be kept for it.
    const HuVolume& densitiesAroundLumen()
    {
        const Grid lumen = gridOfLumen();
        const bool signal = quantity_ == Quantity::signal;
        const std::lock_guard lock(mutex_);
        const std::optional<HuVolume>& whole = signal ? lumen_scale_ : volume_;
        if (!around_lumen_ && whole)
            around_lumen_ = steps::densitiesAround(*whole, lumen);
        if (!around_lumen_)
            around_lumen_ = steps::densitiesAround(
                scan_files::readVolume<std::int16_t>(source(signal ? "lumen_scale.mha" : "volume.mha")), lumen);
        return *around_lumen_;
    }
    /// Keeps a signal on the lumen's scale, and begins to write it.
    void putLumenScale(HuVolume v) { put(lumen_scale_, std::move(v), "lumen_scale.mha", scan_files::Packing::zlib); }
    /// The lumen as the densities told, before its wall was placed. On the grid of inside().
    const InsideVolume& mask() { return get(mask_, "mask.mha"); }
    const InsideVolume& inside() { return get(inside_, "inside.mha"); }
    const steps::TissueVolume& tissue() { return get(tissue_, "tissue.mha"); }
    const SegmentVolume& segments() { return get(segments_, "segments.mha"); }
    const Skeleton& skeleton()
    {
        const std::lock_guard lock(mutex_);
        if (!skeleton_)
            skeleton_ = scan_files::readSkeleton(source("skeleton.vtp"));
        return *skeleton_;
    }

    /// Keeps the object and begins to write the file.
    void put(HuVolume v) { put(volume_, std::move(v), "volume.mha", scan_files::Packing::raw); }
    void putMask(InsideVolume v) { put(mask_, std::move(v), "mask.mha", scan_files::Packing::zlib); }
    void put(InsideVolume v) { put(inside_, std::move(v), "inside.mha", scan_files::Packing::zlib); }
    /// Gives the mask's memory back. No step may be at work on it.
    void dropMask()
    {
        finish({"mask.mha"});
        const std::lock_guard lock(mutex_);
        mask_.reset();
    }
    /// The surface is made of it from now on.
    void putTissue(steps::TissueVolume v)
    {
        put(tissue_, std::move(v), "tissue.mha", scan_files::Packing::zlib);
        beginSurface();
    }
    void put(SegmentVolume v) { put(segments_, std::move(v), "segments.mha", scan_files::Packing::zlib); }
    void put(Skeleton s)
    {
        scan_files::writeSkeleton(target("skeleton.vtp"), s);
        const std::lock_guard lock(mutex_);
        skeleton_ = std::move(s);
    }
    /// Begins to write a volume that no other step needs.
    template <class T>
    void write(const std::string& file, Volume<T> volume)
    {
        begin(file, [path = target(file), kept = std::make_shared<const Volume<T>>(std::move(volume))] {
            scan_files::writeVolume(path, *kept, scan_files::Packing::raw);
        });
    }

    /// Begins to contour the lumen, unless that was begun, or the densities around it are not in memory.
    void beginSurface(const steps::WallDensities& wall)
    {
        const std::lock_guard lock(mutex_);
        if (around_lumen_ && inside_ && !surface_.valid())
            surface_ = std::async(std::launch::async, [&densities = *around_lumen_, &inside = *inside_, wall] {
                           NoProgress quiet;
                           return steps::LumenSurface(densities, inside, wall, quiet);
                       }).share();
    }
    /// Begins to contour the lumen from the fraction of tissue, unless that was begun.
    void beginSurface()
    {
        const auto& from = tissue();
        const InsideVolume& lumen = inside();
        const std::lock_guard lock(mutex_);
        if (!surface_.valid())
            surface_ = std::async(std::launch::async, [&from, &lumen] {
                           NoProgress quiet;
                           return steps::LumenSurface(from, lumen, quiet);
                       }).share();
    }
    /// The lumen's surface from the fraction of tissue; reads it where an earlier run made it.
    std::shared_future<steps::LumenSurface> surface()
    {
        beginSurface();
        const std::lock_guard lock(mutex_);
        return surface_;
    }
    /// The lumen's surface; reads the densities where an earlier run made them.
    std::shared_future<steps::LumenSurface> surface(const steps::WallDensities& wall)
    {
        densitiesAroundLumen();
        beginSurface(wall);
        const std::lock_guard lock(mutex_);
        return surface_;
    }

    /// Begins to measure the distances from the surface, if that was begun, and then to write them: the disk has
    /// nothing to do at that time.
    void beginWallDistance()
    {
        const std::lock_guard lock(mutex_);
        if (surface_.valid() && inside_)
            largest_wall_distance_ = std::async(std::launch::async, [this, surface = surface_, &lumen = *inside_] {
                NoProgress quiet;
                return putWallDistance(steps::wallDistance(lumen, surface.get().nearWall(), quiet));
            });
    }
    /// The largest distance from the wall, when an earlier step began to measure them. They are being written then.
    std::optional<double> takeLargestWallDistance() { return take(largest_wall_distance_); }
    /// Begins to write the distances from the wall. Returns the largest.
    double putWallDistance(FieldVolume from_wall_mm)
    {
        const double largest_mm = steps::largestOf(from_wall_mm);
        write("wall_distance.mha", std::move(from_wall_mm));
        return largest_mm;
    }

    /// The lumen flooded from the skeleton's paths, when an earlier step began it; it is given away.
    std::optional<steps::PathFlood> takeFlood() { return take(flood_); }
    /// Where one was begun of other paths, waits for its end.
    void keepFlood(std::future<steps::PathFlood> flood)
    {
        const std::lock_guard lock(mutex_);
        std::swap(flood_, flood);
    }

    /// Waits until these files are on the disk, whichever of them were begun, and whoever else waits for them. Throws
    /// what their writing threw.
    void finish(const std::vector<std::string>& files)
    {
        for (const std::string& file : files) {
            std::shared_future<void> writing;
            {
                const std::lock_guard lock(mutex_);
                if (const auto at = writing_.find(file); at != writing_.end())
                    writing = at->second;
            }
            if (!writing.valid())
                continue;
            writing.get();
            const std::lock_guard lock(mutex_);
            writing_.erase(file);  // with the memory of what was written
        }
    }
    /// Gives the whole volume's memory back. It must be written, and no step at work on it.
    void dropVolume()
    {
        finish({"lumen_scale.mha"});
        const std::lock_guard lock(mutex_);
        volume_.reset();
        lumen_scale_.reset();
    }
    /// Gives back what densitiesAroundLumen() keeps; no step may be at work on it.
    void dropDensitiesAroundLumen()
    {
        std::shared_future<steps::LumenSurface> surface;
        {
            const std::lock_guard lock(mutex_);
            surface = std::exchange(surface_, {});
        }
        if (surface.valid())
            surface.wait();  // also when only the distances from it are wanted
        const std::lock_guard lock(mutex_);
        around_lumen_.reset();
    }

private:
    Grid gridOfLumen()
    {
        {
            const std::lock_guard lock(mutex_);
            if (inside_)
                return inside_->grid;
        }
        return mask().grid;
    }
    template <class T>
    std::optional<T> take(std::future<T>& kept)
    {
        std::future<T> taken;
        {
            const std::lock_guard lock(mutex_);
            taken = std::move(kept);
        }
        return taken.valid() ? std::optional(taken.get()) : std::nullopt;
    }
    template <class T>
    const Volume<T>& get(std::optional<Volume<T>>& kept, const char* file)
    {
        const std::lock_guard lock(mutex_);
        if (!kept)
            kept = scan_files::readVolume<T>(source(file));
        return *kept;
    }
    template <class T>
    void put(std::optional<Volume<T>>& kept, Volume<T> made, const char* file, scan_files::Packing packing)
    {
        {
            const std::lock_guard lock(mutex_);
            kept = std::move(made);
        }
        begin(file, [path = target(file), &kept, packing] { scan_files::writeVolume(path, *kept, packing); });
    }
    template <class Write>
    void begin(const std::string& file, Write write)
    {
        auto writing = std::async(std::launch::async, std::move(write)).share();
        const std::lock_guard lock(mutex_);
        writing_[file] = std::move(writing);
    }

    std::filesystem::path folder_, claim_;
    std::mutex mutex_;
    Quantity quantity_;
    std::optional<HuVolume> volume_, lumen_scale_, around_lumen_;
    std::optional<InsideVolume> mask_, inside_;
    std::optional<steps::TissueVolume> tissue_;
    std::optional<SegmentVolume> segments_;
    std::optional<Skeleton> skeleton_;
    std::shared_future<steps::LumenSurface> surface_;          // reads around_lumen_, inside_ and tissue_
    std::future<steps::PathFlood> flood_;                      // reads inside_
    std::map<std::string, std::shared_future<void>> writing_;  // late: what is written must outlive it
    std::future<double> largest_wall_distance_;                // reads surface_ and inside_, begins to write
};

}  // namespace vicon::pipeline
