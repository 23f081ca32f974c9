#include "vicon/steps/lumen_plan.h"

#include <algorithm>
#include <utility>

#include "grid/lumen_graph.h"
#include "segment/lumen.h"
#include "segment/pieces/lumen_ways.h"
#include "vicon/core/error.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/progress.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

LumenPiece pieceFrom(const nlohmann::json& json)
{
    return {json.at("rectal_end_mm").get<Point3>(), json.at("caecal_end_mm").get<Point3>(),
            json.at("volume_ml").get<double>(),     json.at("fluid_ml").get<double>(),
            json.at("length_mm").get<double>(),     json.at("max_radius_mm").get<double>()};
}

LumenWay longestOf(LumenWays found)
{
    return std::move(*std::max_element(found.ways.begin(), found.ways.end(), [](const LumenWay& a, const LumenWay& b) {
        return a.length_mm() < b.length_mm();
    }));
}

}  // namespace

nlohmann::json toJson(const LumenPlan& plan)
{
    nlohmann::json out{{"pieces", nlohmann::json::array()}, {"bridges", nlohmann::json::array()}};
    for (const LumenPiece& piece : plan.pieces)
        out["pieces"].push_back({{"rectal_end_mm", piece.rectal_end_mm},
                                 {"caecal_end_mm", piece.caecal_end_mm},
                                 {"volume_ml", piece.volume_ml},
                                 {"fluid_ml", piece.fluid_ml},
                                 {"length_mm", piece.length_mm},
                                 {"max_radius_mm", piece.max_radius_mm}});
    for (const Bridge& bridge : plan.bridges)
        out["bridges"].push_back(vicon::toJson(bridge));
    return out;
}

LumenPlan lumenPlanFromJson(const nlohmann::json& json)
{
    try {
        LumenPlan plan;
        for (const auto& piece : json.at("pieces"))
            plan.pieces.push_back(pieceFrom(piece));
        for (const auto& bridge : json.at("bridges"))
            plan.bridges.push_back(bridgeFromJson(bridge));
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
    const LumenWay way = longestOf(findWays(graph, progress));
    LumenPiece piece{graph.point(way.nodes.front()), graph.point(way.nodes.back())};
    if (piece.caecal_end_mm.z < piece.rectal_end_mm.z)
        std::swap(piece.rectal_end_mm, piece.caecal_end_mm);
    const double voxel_ml = inside.grid.voxelVolume_mm3() / 1000;
    piece.volume_ml = double(largest->voxels) * voxel_ml;
    piece.fluid_ml = largest->sum * voxel_ml;
    piece.length_mm = way.length_mm();
    piece.max_radius_mm = graph.node(widestNode(graph)).wall_mm;
    plan.pieces.push_back(piece);
    return plan;
}

}  // namespace vicon::steps
