// Whatever a .vtp holds, a centreline has its points and a surface's triangles their corners, or it is refused.
#include "memory_file.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/skeleton_file.h"

using namespace vicon;

namespace {

template <class Read>
void tryTo(Read read)
{
    try {
        read();
    } catch (const Error&) {
    }
}

void requireSound(const CellSurface& surface)
{
    const std::size_t points = surface.points_mm.size() / 3;
    fuzz::require(surface.points_mm.size() == surface.normals.size());
    fuzz::require(surface.segment.size() == surface.triangleCount());
    for (const auto corner : surface.triangles)
        fuzz::require(std::size_t(corner) < points);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    file.fill(data, size);
    tryTo([&] {
        for (const SkeletonPiece& piece : scan_files::readSkeleton(file.path()).pieces)
            fuzz::require(piece.points.size() >= 2);
    });
    tryTo([&] { (void)scan_files::readSkeletonTree(file.path()); });
    tryTo([&] { (void)scan_files::readSkeletonVoxels(file.path()); });
    tryTo([&] { requireSound(scan_files::readCells(file.path())); });
    return 0;
}
