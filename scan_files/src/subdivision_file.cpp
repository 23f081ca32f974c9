#include "vicon/scan_files/subdivision_file.h"

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/json_text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::scan_files {
namespace {

json toJson(const Portal& p)
{
    json gate = json::array(), box = json::array();
    for (const Point3& corner : p.gate_mm)
        gate.push_back(corner);
    for (const Point3& corner : p.box_mm)
        box.push_back(corner);
    return {{"between", {p.segment_a, p.segment_b}},
            {"centre_mm", p.centre_mm},
            {"normal", p.normal},
            {"area_mm2", p.area_mm2},
            {"gate_mm", gate},
            {"box_mm", box},
            {"along_skeleton", p.along_skeleton}};
}

Portal portalFrom(const json& j)
{
    Portal p;
    p.segment_a = wholeNumber(j.at("between").at(0));
    p.segment_b = wholeNumber(j.at("between").at(1));
    p.centre_mm = j.at("centre_mm").get<Point3>();
    p.normal = j.at("normal").get<Vector3>();
    p.area_mm2 = j.at("area_mm2");
    for (std::size_t n = 0; n < 4; ++n)
        p.gate_mm[n] = j.at("gate_mm").at(n).get<Point3>();
    for (std::size_t n = 0; n < 8; ++n)
        p.box_mm[n] = j.at("box_mm").at(n).get<Point3>();
    p.along_skeleton = j.at("along_skeleton");
    return p;
}

json toJson(const SegmentInfo& s)
{
    return {{"number", s.number},
            {"from_station_mm", s.from_station_mm},
            {"to_station_mm", s.to_station_mm},
            {"volume_mm3", s.volume_mm3},
            {"inside_voxels", s.inside_voxels},
            {"surface_voxels", s.surface_voxels},
            {"triangles", s.triangles},
            {"lower_mm", s.lower_mm},
            {"upper_mm", s.upper_mm}};
}

SegmentInfo segmentFrom(const json& j)
{
    return {.number = wholeNumber(j.at("number")),
            .from_station_mm = j.at("from_station_mm"),
            .to_station_mm = j.at("to_station_mm"),
            .volume_mm3 = j.at("volume_mm3"),
            .inside_voxels = wholeCount(j.at("inside_voxels")),
            .surface_voxels = wholeCount(j.at("surface_voxels")),
            .triangles = wholeCount(j.at("triangles")),
            .lower_mm = j.at("lower_mm").get<Point3>(),
            .upper_mm = j.at("upper_mm").get<Point3>()};
}

Subdivision subdivisionFrom(const json& in)
{
    Subdivision subdivision;
    subdivision.method = subdivideMethodFrom(in.at("method"));
    subdivision.parameters = in.at("parameters");
    subdivision.statistics = in.at("statistics");
    for (const json& segment : in.at("segments"))
        subdivision.segments.push_back(segmentFrom(segment));
    for (const json& portal : in.at("portals"))
        subdivision.portals.push_back(portalFrom(portal));
    return subdivision;
}

}  // namespace

void writeSubdivision(const fs::path& file, const Subdivision& subdivision)
{
    json out = {{"method", nameOf(subdivision.method)},
                {"parameters", subdivision.parameters},
                {"statistics", subdivision.statistics},
                {"segments", json::array()},
                {"portals", json::array()}};
    for (const SegmentInfo& segment : subdivision.segments)
        out["segments"].push_back(toJson(segment));
    for (const Portal& portal : subdivision.portals)
        out["portals"].push_back(toJson(portal));
    replaceFile(file, out.dump(1) + "\n");
}

Subdivision readSubdivision(const fs::path& file)
{
    const json in = parsedJson(readFile(file));
    try {
        return subdivisionFrom(in);
    } catch (const json::exception&) {  // both: told below
    } catch (const Error&) {
    }
    throw Error(ErrorCode::bad_input, "is not a subdivision", file.string(), "run 'vicon work' to make it anew");
}

}  // namespace vicon::scan_files
