#include "chain.h"

#include <algorithm>
#include <random>

#include "dicom_writer.h"
#include "vicon/cases/case_store.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/load_scan.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/exit_distance.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/wall_distance.h"

namespace fs = std::filesystem;

namespace vicon::test {
namespace {

template <class T>
void append(std::string& to, const std::vector<T>& values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    to.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <class T>
std::string bytesOf(const Volume<T>& volume)
{
    std::string bytes;
    append(bytes, std::vector<Point3>{volume.grid.origin_mm});
    append(bytes, std::vector<std::array<Vector3, 3>>{volume.grid.axis});
    append(bytes, std::vector<std::array<double, 3>>{volume.grid.spacing_mm});
    append(bytes, std::vector<std::array<int, 3>>{volume.grid.size});
    append(bytes, volume.voxels);
    return bytes;
}

std::string bytesOf(const Skeleton& curve)
{
    std::string bytes;
    for (const SkeletonPiece& piece : curve.pieces) {
        bytes += piece.bridge ? "bridge" : "piece";
        append(bytes, piece.points);
    }
    return bytes;
}

std::string bytesOf(const Subdivision& subdivision)
{
    std::string bytes = subdivision.statistics.dump();
    for (const SegmentInfo& s : subdivision.segments)
        append(bytes, std::vector<double>{s.from_station_mm, s.to_station_mm, s.volume_mm3, double(s.surface_voxels),
                                          double(s.triangles)});
    for (const Portal& p : subdivision.portals) {
        append(bytes, std::vector<double>{double(p.segment_a), double(p.segment_b), p.area_mm2});
        append(bytes, std::vector<std::array<Point3, 8>>{p.box_mm});
        append(bytes, std::vector<std::array<Point3, 4>>{p.gate_mm});
    }
    return bytes;
}

Vector3 along(int axis, int sign)
{
    const double s = sign;
    return axis == 0 ? Vector3{s, 0, 0} : axis == 1 ? Vector3{0, s, 0} : Vector3{0, 0, s};
}

/// The series' names stay those of its slices; only the files' names change.
void shuffleNames(const std::vector<fs::path>& files)
{
    std::vector<std::size_t> order(files.size());
    for (std::size_t n = 0; n < order.size(); ++n)
        order[n] = n;
    std::shuffle(order.begin(), order.end(), std::mt19937(7));
    for (std::size_t n = 0; n < files.size(); ++n)
        fs::rename(files[n], files[n].parent_path() / ("x" + std::to_string(order[n])));
}

}  // namespace

ChainResult runResample(HuVolume acquired)
{
    NoProgress quiet;
    ChainResult result;
    result.volume = steps::resample(std::move(acquired), {}, quiet);
    result.bytes["volume"] = bytesOf(result.volume);
    return result;
}

ChainResult runChain(HuVolume acquired, Vector3 gravity)
{
    NoProgress quiet;
    ChainResult result = runResample(std::move(acquired));
    auto& bytes = result.bytes;
    steps::Segmentation found = steps::segmentColon(result.volume, gravity, {}, quiet);
    bytes["plan"] =
        toJson(found.plan).dump() + found.measures.dump() + verdictText(found.verdict, "colon") + found.reason;
    result.inside = std::move(found.inside);
    bytes["inside"] = bytesOf(result.inside);
    const steps::SkeletonResult skeleton = steps::findSkeleton(result.inside, found.plan, {}, quiet);
    result.curve = skeleton.curve;
    bytes["skeleton"] = bytesOf(skeleton.curve) + skeleton.measures.dump();
    for (const auto& path : skeleton.voxels)
        append(bytes["skeleton_voxels"], path);
    if (result.curve.empty())
        return result;
    steps::Subdivided divided = steps::subdivide(result.inside, skeleton.curve, skeleton.voxels, {}, quiet);
    bytes["segments"] = bytesOf(divided.segments);
    const CellSurface surface = steps::extractCells(result.volume, result.inside, divided.segments, {}, quiet);
    steps::countTriangles(surface, divided.description);
    bytes["subdivision"] = bytesOf(divided.description);
    append(bytes["cells"], surface.points_mm);
    append(bytes["cells"], surface.normals);
    append(bytes["cells"], surface.triangles);
    append(bytes["cells"], surface.segment);
    bytes["exit_distance"] = bytesOf(steps::exitDistance(result.inside, skeleton.curve, quiet));
    bytes["wall_distance"] = bytesOf(steps::wallDistance(result.inside, quiet));
    bytes["wall_distance_fine"] = bytesOf(steps::wallDistance(result.inside, result.volume, quiet));
    return result;
}

HuVolume throughDicom(const HuVolume& measured, const Storage& storage, const fs::path& folder)
{
    const Grid& grid = measured.grid;
    std::array<int, 3> size{};
    std::array<double, 3> spacing_mm{};
    std::array<Vector3, 3> axis;
    SeriesSpec spec;
    spec.first_mm = grid.origin_mm;
    for (std::size_t d = 0; d < 3; ++d) {
        const auto a = std::size_t(storage.axis[d]);
        size[d] = grid.size[a];
        spacing_mm[d] = grid.spacing_mm[a];
        axis[d] = along(storage.axis[d], storage.sign[d]);
        if (dot(axis[d], grid.axis[a]) < 0)
            spec.first_mm += grid.axis[a] * (spacing_mm[d] * (size[d] - 1));
    }
    spec.row = axis[0];
    spec.column = axis[1];
    spec.step_mm = axis[2] * spacing_mm[2];
    spec.thickness_mm = spacing_mm[2];
    spec.pixel_mm = spacing_mm[0];
    spec.row_mm = spacing_mm[1];
    spec.columns = size[0];
    spec.rows = size[1];
    spec.slices = size[2];
    spec.bits_stored = 16;
    spec.high_bit = 15;
    spec.is_signed = true;
    spec.intercept = 0;
    spec.padding = kPaddingHu;
    spec.densities = [&](Point3 p) { return double(measured.at(grid.indexAt(p))); };
    const std::vector<fs::path> files = writeSeries(folder / "series", spec);
    if (storage.shuffled)
        shuffleNames(files);
    NoProgress quiet;
    CaseStore store(folder / "store");
    ingest::importPaths(store, {folder / "series"}, {}, quiet);
    const ScanRecord scan = store.requireScan(store.cases().at(0).id, {});
    return ingest::loadScan(store.scanFolder(scan.case_id, scan.id) / "dicom", {}, quiet);
}

phantom::PhantomOptions smallColon(std::uint64_t seed)
{
    phantom::PhantomOptions options;
    options.seed = seed;
    options.size = {160, 160, 134};
    options.spacing_mm = {2.375, 2.375, 3.25};
    options.folds = false;
    return options;
}

}  // namespace vicon::test
