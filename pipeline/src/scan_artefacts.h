#pragma once

#include <filesystem>
#include <optional>

#include "vicon/artefact/skeleton_file.h"
#include "vicon/artefact/subdivision_file.h"
#include "vicon/artefact/volume_file.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"

namespace vicon::pipeline {

/// The artefacts of a scan as the steps hand them on: kept in memory when they were just made, read when they were made
/// by an earlier run.
class ScanArtefacts {
public:
    explicit ScanArtefacts(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& folder() const { return folder_; }

    const HuVolume& volume() { return get(volume_, "volume.mha"); }
    const InsideVolume& inside() { return get(inside_, "inside.mha"); }
    const SegmentVolume& segments() { return get(segments_, "segments.mha"); }
    const Skeleton& skeleton()
    {
        if (!skeleton_)
            skeleton_ = artefact::readSkeleton(folder_ / "skeleton.vtp");
        return *skeleton_;
    }

    /// Writes the file and keeps the object.
    void put(HuVolume v) { put(volume_, std::move(v), "volume.mha", artefact::Packing::raw); }
    void put(InsideVolume v) { put(inside_, std::move(v), "inside.mha", artefact::Packing::zlib); }
    void put(SegmentVolume v) { put(segments_, std::move(v), "segments.mha", artefact::Packing::zlib); }
    void put(Skeleton s)
    {
        artefact::writeSkeleton(folder_ / "skeleton.vtp", s);
        skeleton_ = std::move(s);
    }
    /// Gives memory back that no later step needs.
    void dropVolume() { volume_.reset(); }

private:
    template <class T>
    const Volume<T>& get(std::optional<Volume<T>>& kept, const char* file)
    {
        if (!kept)
            kept = artefact::readVolume<T>(folder_ / file);
        return *kept;
    }
    template <class T>
    void put(std::optional<Volume<T>>& kept, Volume<T> made, const char* file, artefact::Packing packing)
    {
        artefact::writeVolume(folder_ / file, made, packing);
        kept = std::move(made);
    }

    std::filesystem::path folder_;
    std::optional<HuVolume> volume_;
    std::optional<InsideVolume> inside_;
    std::optional<SegmentVolume> segments_;
    std::optional<Skeleton> skeleton_;
};

}  // namespace vicon::pipeline
