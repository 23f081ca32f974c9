#include "scan_description.h"

#include <array>
#include <cstdio>
#include <map>

using nlohmann::json;

namespace vicon::ingest {
namespace {

json asJson(const Vector3& v)
{
    return {v.x, v.y, v.z};
}

}  // namespace

Series seriesOf(const Stack& stack)
{
    Series series = stack.slices.front().object->series;
    for (const SliceRef& ref : stack.slices)
        series.lossy = series.lossy || ref.object->series.lossy;
    series.kernel = stack.slices.front().slice->kernel;
    return series;
}

json describeGeometry(const Stack& stack, const StackPlan& plan)
{
    json geometry = plan.geometry;
    geometry["slices"] = stack.slices.size();
    geometry["columns"] = stack.slices.front().object->pixels.columns;
    geometry["rows"] = stack.slices.front().object->pixels.rows;
    if (!plan.refused.empty()) {
        geometry.erase("interpolated_slices");
        geometry.erase("largest_offset_mm");
        return geometry;
    }
    const Grid grid = nearestToPatient(plan.grid).grid;
    geometry["size"] = grid.size;
    geometry["spacing_mm"] = grid.spacing_mm;
    geometry["origin_mm"] = asJson(grid.origin_mm - Point3{});
    geometry["axes"] = {asJson(grid.axis[0]), asJson(grid.axis[1]), asJson(grid.axis[2])};
    return geometry;
}

json describeRepairs(const std::vector<const ImageObject*>& objects, const StackPlan& plan)
{
    // Of a volume that is not made nothing was interpolated or moved.
    json repairs = plan.refused.empty() ? json(plan.repairs) : json::array();
    std::map<std::string, int> counts;
    for (const ImageObject* object : objects)
        for (const std::string& repair : object->repairs)
            ++counts[repair];
    for (const auto& [repair, count] : counts)
        repairs.push_back(repair + " (" + std::to_string(count) + (count == 1 ? " image)" : " images)"));
    if (objects.front()->series.patient_position.empty())
        repairs.push_back("Patient Position not said: whether the patient lay supine or prone is unknown");
    return repairs;
}

std::string describeInWords(const ScanRecord& record, const StackPlan& plan)
{
    std::array<char, 80> text{};
    const std::size_t slices = record.ingest["geometry"]["slices"];
    if (slices == 1)
        std::snprintf(text.data(), text.size(), "1 slice, ");
    else
        std::snprintf(text.data(), text.size(), "%zu slices, %.2f mm apart, ", slices, plan.grid.spacing_mm[2]);
    std::string words = text.data() + positionName(record.series.patient_position);
    if (record.series.lossy)
        words += ", lossy compression";
    if (record.role == ScanRole::scan)
        words += "; queued";
    if (record.ingest.contains("kept_because"))
        words += "; not queued: " + record.ingest["kept_because"].get<std::string>();
    return words;
}

}  // namespace vicon::ingest
