#include "vicon/steps/lumen_plan.h"

#include <algorithm>

#include "grid/lumen_graph.h"
#include "segment/lumen.h"
#include "vicon/core/error.h"
#include "vicon/core/progress.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

nlohmann::json toJson(Point3 p)
{
    return {p.x, p.y, p.z};
}

Point3 pointFrom(const nlohmann::json& json)
{
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

LumenPiece pieceFrom(const nlohmann::json& json)
{
    return {pointFrom(json.at("rectal_end_mm")), pointFrom(json.at("caecal_end_mm")),
            json.at("volume_ml").get<double>(),  json.at("fluid_ml").get<double>(),
            json.at("length_mm").get<double>(),  json.at("max_radius_mm").get<double>()};
}

Bridge bridgeFrom(const nlohmann::json& json)
{
    Bridge bridge{
        pointFrom(json.at("from_mm")),      pointFrom(json.at("to_mm")),         {},
        json.at("length_mm").get<double>(), json.at("confidence").get<double>(), json.at("reason").get<std::string>(),
        json.at("certain").get<bool>()};
    for (const auto& p : json.at("path_mm"))
        bridge.path_mm.push_back(pointFrom(p));
    return bridge;
}

}  // namespace

nlohmann::json toJson(const LumenPlan& plan)
{
    nlohmann::json out{{"pieces", nlohmann::json::array()}, {"bridges", nlohmann::json::array()}};
    for (const LumenPiece& piece : plan.pieces)
        out["pieces"].push_back({{"rectal_end_mm", toJson(piece.rectal_end_mm)},
                                 {"caecal_end_mm", toJson(piece.caecal_end_mm)},
                                 {"volume_ml", piece.volume_ml},
                                 {"fluid_ml", piece.fluid_ml},
                                 {"length_mm", piece.length_mm},
                                 {"max_radius_mm", piece.max_radius_mm}});
    for (const Bridge& bridge : plan.bridges) {
        nlohmann::json path = nlohmann::json::array();
        for (const Point3& p : bridge.path_mm)
            path.push_back(toJson(p));
        out["bridges"].push_back({{"from_mm", toJson(bridge.from_mm)},
                                  {"to_mm", toJson(bridge.to_mm)},
                                  {"path_mm", path},
                                  {"length_mm", bridge.length_mm},
                                  {"confidence", bridge.confidence},
                                  {"reason", bridge.reason},
                                  {"certain", bridge.certain}});
    }
    return out;
}

LumenPlan lumenPlanFromJson(const nlohmann::json& json)
{
    try {
        LumenPlan plan;
        for (const auto& piece : json.at("pieces"))
            plan.pieces.push_back(pieceFrom(piece));
        for (const auto& bridge : json.at("bridges"))
            plan.bridges.push_back(bridgeFrom(bridge));
        return plan;
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::bad_input, "the plan of the lumen cannot be read: " + std::string(e.what()), {},
                    "segment the scan again");
    }
}

LumenPlan planForMask(const InsideVolume& inside)
{
    LumenPlan plan;
    NoProgress progress;
    const RunLabels labels = labelLumen(inside, Neighbours::all);
    if (labels.components.empty())
        return plan;
    const auto largest =
        std::max_element(labels.components.begin(), labels.components.end(),
                         [](const RunComponent& a, const RunComponent& b) { return a.voxels < b.voxels; });
    const auto wanted = std::uint32_t(largest - labels.components.begin());
    FieldVolume wall_mm = wallDistance(inside, progress);
    labels.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (run.label != wanted)
            std::fill_n(&wall_mm.at({run.begin, j, k}), run.end - run.begin, 0.0F);
    });
    const LumenGraph graph = makeWholeGraph(wall_mm, 4, progress);
    const std::int32_t start = widestNode(graph);
    const std::int32_t one = farthestNode(centralTree(graph, start, {}, progress));
    const LumenTree tree = centralTree(graph, one, {}, progress);
    const std::int32_t other = farthestNode(tree);
    LumenPiece piece{graph.point(one), graph.point(other)};
    if (piece.caecal_end_mm.z < piece.rectal_end_mm.z)
        std::swap(piece.rectal_end_mm, piece.caecal_end_mm);
    const double voxel_ml = inside.grid.voxelVolume_mm3() / 1000;
    piece.volume_ml = double(largest->voxels) * voxel_ml;
    piece.fluid_ml = largest->sum * voxel_ml;
    piece.length_mm = tree.length_mm[std::size_t(other)];
    piece.max_radius_mm = graph.node(start).wall_mm;
    plan.pieces.push_back(piece);
    return plan;
}

}  // namespace vicon::steps
