#include "vicon/cases/bridges.h"

#include <soci/soci.h>

#include <algorithm>

#include "bridge_reviews_file.h"
#include "case_rows.h"
#include "this_person.h"
#include "vicon/cases/roles.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

using nlohmann::json;

namespace vicon {
namespace {

AuditEvent eventOf(const std::optional<BridgeReview>& review)
{
    if (!review)
        return AuditEvent::bridge_unjudged;
    return review->verdict == BridgeVerdict::confirmed ? AuditEvent::bridge_confirmed : AuditEvent::bridge_rejected;
}

}  // namespace

std::string nameOf(BridgeVerdict verdict)
{
    return verdict == BridgeVerdict::confirmed ? "confirmed" : "rejected";
}

BridgeVerdict bridgeVerdictFrom(const std::string& name)
{
    for (const BridgeVerdict verdict : {BridgeVerdict::confirmed, BridgeVerdict::rejected})
        if (nameOf(verdict) == name)
            return verdict;
    throw Error(ErrorCode::bad_input, "a bridge is confirmed or rejected", "'" + name + "'");
}

json toJson(const ReviewedBridge& bridge)
{
    json out = toJson(bridge.bridge);
    if (bridge.review)
        out["review"] = {
            {"verdict", nameOf(bridge.review->verdict)}, {"by", bridge.review->by}, {"at", bridge.review->at}};
    return out;
}

std::vector<ReviewedBridge> reviewedBridges(CaseStore& store, const ScanRecord& scan)
{
    const std::vector<ReviewedBridge> reviews = readBridgeReviews(store.scanFolder(scan.case_id, scan.id));
    std::vector<ReviewedBridge> bridges;
    const StepResults results = resultsOf(store.steps(scan.case_id, scan.id));
    if (!results.segment)
        return bridges;
    for (const Bridge& found : results.segment->bridges) {
        ReviewedBridge bridge{found, std::nullopt};
        for (const ReviewedBridge& review : reviews)
            if (isSameBridge(bridge.bridge, review.bridge))
                bridge.review = review.review;
        bridges.push_back(std::move(bridge));
    }
    return bridges;
}

void reviewBridge(CaseStore& store, const ScanRecord& scan, const ReviewedBridge& given)
{
    requireRole(Role::mark);
    const auto same = [&](const ReviewedBridge& other) { return isSameBridge(other.bridge, given.bridge); };
    const std::vector<ReviewedBridge> known = reviewedBridges(store, scan);
    if (std::none_of(known.begin(), known.end(), same))
        throw Error(ErrorCode::not_found, "the scan has no such bridge any more", scan.id);
    BridgeReview told = given.review.value_or(BridgeReview{});
    if (told.by.empty())
        told.by = thisPerson();
    if (told.at.empty())
        told.at = nowUtc();
    const auto folder = store.scanFolder(scan.case_id, scan.id);
    const std::string verdict = given.review ? nameOf(told.verdict) : "";
    // Alone with the database: of two readers at once neither takes back what the other said.
    store.database().write([&](soci::session& sql) {
        std::vector<ReviewedBridge> reviews = readBridgeReviews(folder);
        std::erase_if(reviews, same);
        if (given.review)
            reviews.push_back({given.bridge, told});
        putAudit(sql, eventOf(given.review), scan.case_id, scan.id,
                 bridgeReviewJson(given.bridge, verdict, told.by, told.at).dump());
        writeBridgeReviews(folder, reviews);  // last: what is left to fail is the commit
    });
}

}  // namespace vicon
