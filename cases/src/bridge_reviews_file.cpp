#include "bridge_reviews_file.h"

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/json_text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon {
namespace {

constexpr const char* kFile = "bridge_reviews.json";

ReviewedBridge reviewFrom(const json& entry)
{
    ReviewedBridge out;
    out.bridge.from_mm = entry.at("from_mm").get<Point3>();
    out.bridge.to_mm = entry.at("to_mm").get<Point3>();
    out.review = {bridgeVerdictFrom(entry.at("verdict").get<std::string>()), entry.at("by").get<std::string>(),
                  entry.at("at").get<std::string>()};
    return out;
}

}  // namespace

json bridgeReviewJson(const Bridge& bridge, const std::string& verdict, const std::string& by, const std::string& at)
{
    return {{"from_mm", bridge.from_mm}, {"to_mm", bridge.to_mm}, {"verdict", verdict}, {"by", by}, {"at", at}};
}

std::vector<ReviewedBridge> readBridgeReviews(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kFile;
    if (!fs::exists(file))
        return {};
    const auto refuse = [&]() -> Error {
        return {ErrorCode::bad_input, "is not a file of bridges' reviews", file.string(),
                "mend it, or delete it: the bridges are then unjudged again"};
    };
    try {
        std::vector<ReviewedBridge> reviews;
        const json all = parsedJson(readFile(file));
        for (const json& entry : all.at("bridges").get_ref<const json::array_t&>())
            reviews.push_back(reviewFrom(entry));
        return reviews;
    } catch (const json::exception&) {
        throw refuse();
    } catch (const Error& e) {
        throw e.code() == ErrorCode::bad_input ? refuse() : e;
    }
}

void writeBridgeReviews(const fs::path& scan_folder, const std::vector<ReviewedBridge>& reviews)
{
    json list = json::array();
    for (const ReviewedBridge& review : reviews)
        list.push_back(
            bridgeReviewJson(review.bridge, nameOf(review.review->verdict), review.review->by, review.review->at));
    replaceFile(scan_folder / kFile, json{{"bridges", list}}.dump(1) + "\n");
}

}  // namespace vicon
