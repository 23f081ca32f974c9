#include "correcting.h"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "organs.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::app {
namespace {

constexpr const char* kReviews = "bridge_reviews.json";
constexpr double kSame_mm = 0.5;  // less than a voxel: the same end of the same bridge

void requireInside(const std::filesystem::path& scan_folder, const std::vector<Point3>& points, const char* option)
{
    const auto file = scan_folder / "volume.mha";
    if (points.empty() || !std::filesystem::exists(file))
        return;
    const Grid grid = scan_files::readGrid(file);
    for (const Point3 p : points) {
        if (grid.contains(grid.indexAt(p)))
            continue;
        char text[96];
        std::snprintf(text, sizeof text, "%.1f,%.1f,%.1f", p.x, p.y, p.z);
        throw Error(ErrorCode::wrong_use, std::string("the point ") + text + " lies outside the scan", option,
                    "give LPS mm, as 'vicon snapshot --view slices' shows them");
    }
}

void append(std::vector<Point3>& to, const std::vector<Point3>& more)
{
    to.insert(to.end(), more.begin(), more.end());
}

bool same(const nlohmann::json& a, const nlohmann::json& b)
{
    const auto near = [&](const char* key) {
        double sum = 0;
        for (std::size_t d = 0; d < 3; ++d)
            sum += std::abs(a.at(key).at(d).get<double>() - b.at(key).at(d).get<double>());
        return sum < kSame_mm;
    };
    return near("from_mm") && near("to_mm");
}

bool isPoint(const nlohmann::json& review, const char* key)
{
    const auto point = review.find(key);
    return point != review.end() && point->is_array() && point->size() == 3 &&
           std::all_of(point->begin(), point->end(), [](const auto& number) { return number.is_number(); });
}

bool isReview(const nlohmann::json& review)
{
    if (!review.is_object() || !isPoint(review, "from_mm") || !isPoint(review, "to_mm"))
        return false;
    for (const char* key : {"verdict", "by", "at"})
        if (const auto text = review.find(key); text == review.end() || !text->is_string())
            return false;
    return true;
}

nlohmann::json readReviews(const std::filesystem::path& scan_folder)
{
    const auto file = scan_folder / kReviews;
    if (!std::filesystem::exists(file))
        return nlohmann::json::array();
    const auto all = nlohmann::json::parse(readFile(file), nullptr, false);
    if (!all.is_object() || !all.contains("bridges") || !all["bridges"].is_array() ||
        !std::all_of(all["bridges"].begin(), all["bridges"].end(), isReview))
        throw Error(ErrorCode::bad_input, "is not a file of bridges' reviews", file.string(),
                    "mend it, or delete it: the bridges are then unjudged again");
    return all["bridges"];
}

/// Who works here; the number where the system knows no name.
std::string thisPerson()
{
    const passwd* entry = getpwuid(getuid());
    return entry ? entry->pw_name : std::to_string(getuid());
}

}  // namespace

void correctScan(CaseStore& store, const Config& config, const ScanRecord& scan, const pipeline::Corrections& more,
                 bool forget)
{
    const auto folder = store.scanFolder(scan.case_id, scan.id);
    if (const std::string organ = organOf(store, scan); organ != "colon")
        throw Error(ErrorCode::wrong_use, "corrections are made to a colon; this scan shows the " + organ, scan.id,
                    "set organ.seed to a point inside it instead");
    requireInside(folder, more.add, "--add");
    requireInside(folder, more.cut, "--cut");
    requireInside(folder, more.drop, "--drop");
    pipeline::Corrections all;
    if (!forget)
        all = pipeline::readCorrections(folder);
    append(all.add, more.add);
    append(all.cut, more.cut);
    append(all.drop, more.drop);
    pipeline::writeCorrections(folder, all);
    store.audit("corrections", scan.case_id, scan.id, toJson(all).dump());
    JobQueue queue(store.database(), config.get<QueueOptions>());
    if (const auto job = queue.find(scan.case_id, scan.id); job && job->state == JobState::failed)
        queue.retry(scan.case_id, scan.id);
}

nlohmann::json reviewedBridges(CaseStore& store, const ScanRecord& scan)
{
    nlohmann::json bridges = store.describeScan(scan.case_id, scan.id).value("bridges", nlohmann::json::array());
    const nlohmann::json reviews = readReviews(store.scanFolder(scan.case_id, scan.id));
    for (nlohmann::json& bridge : bridges)
        for (const nlohmann::json& review : reviews)
            if (same(bridge, review))
                bridge["review"] = {
                    {"verdict", review.at("verdict")}, {"by", review.at("by")}, {"at", review.at("at")}};
    return bridges;
}

void reviewBridge(CaseStore& store, const ScanRecord& scan, const BridgeReview& given)
{
    const Point3 from = given.from_mm, to = given.to_mm;
    nlohmann::json review = {{"from_mm", {from.x, from.y, from.z}}, {"to_mm", {to.x, to.y, to.z}}};
    const nlohmann::json bridges = reviewedBridges(store, scan);
    if (std::none_of(bridges.begin(), bridges.end(), [&](const auto& bridge) { return same(bridge, review); }))
        throw Error(ErrorCode::not_found, "the scan has no such bridge any more", scan.id);
    review["verdict"] = given.verdict;
    review["by"] = given.by.empty() ? thisPerson() : given.by;
    review["at"] = given.at.empty() ? nowUtc() : given.at;
    const auto folder = store.scanFolder(scan.case_id, scan.id);
    nlohmann::json kept = nlohmann::json::array();
    for (const nlohmann::json& earlier : readReviews(folder))
        if (!same(earlier, review))
            kept.push_back(earlier);
    if (!given.verdict.empty())
        kept.push_back(review);
    replaceFile(folder / kReviews, nlohmann::json{{"bridges", kept}}.dump(1) + "\n");
    store.audit("bridge " + (given.verdict.empty() ? "unjudged" : given.verdict), scan.case_id, scan.id, review.dump());
}

}  // namespace vicon::app
