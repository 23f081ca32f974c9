#pragma once

#include <memory>
#include <vector>

#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// Endoscopic pictures from places that are known beforehand, the same as of drawSnapshot() in less time: of the
/// surface only the cells that may be seen from there are made ready and drawn.
class KnownSnapshots {
public:
    /// Reads and makes ready what needs no OpenGL, on all cores; any thread may do that. Where segments or subdivision
    /// cannot be read, all cells are drawn. Throws as PreparedScan does, and Error{cancelled} where `wanted`, if there
    /// is one, says so.
    /// @param requests where to look from, and what all pictures from there have in common; of the view endo
    KnownSnapshots(PreparedScan scan, std::vector<SnapshotRequest> requests, const Progress* wanted = nullptr);
    ~KnownSnapshots();

    /// As drawSnapshot() does, and on one thread; the last picture goes there too.
    /// @param place number of its request, of which markers and peeling are replaced
    DrawnSnapshot draw(std::size_t place, const std::vector<Marker>& markers, const PeelRequest& peel);
    /// Triangles that are made ready: those of the cells that may be seen from any of the places.
    std::size_t triangles() const;

private:
    PreparedScan scan_;
    std::vector<SnapshotRequest> requests_;
    std::vector<SnapshotResult> places_;
    std::shared_ptr<const struct SeenSurface> seen_;
    std::unique_ptr<class EndoscopicPictures> endoscopic_;
};

}  // namespace vicon::viewer
