#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/bridge.h"

namespace vicon {

enum class BridgeVerdict { confirmed, rejected };
/// "confirmed" or "rejected".
std::string nameOf(BridgeVerdict verdict);
/// Throws Error{bad_input} for any other name.
BridgeVerdict bridgeVerdictFrom(const std::string& name);

/// What a person says of a bridge.
struct BridgeReview {
    BridgeVerdict verdict = BridgeVerdict::confirmed;
    std::string by, at;  ///< who, and when (UTC)

    bool operator==(const BridgeReview&) const = default;
};

/// A bridge and what was said of it, if anything was.
struct ReviewedBridge {
    Bridge bridge;
    std::optional<BridgeReview> review;
};
/// The bridge's own keys, and {"review": {"verdict", "by", "at"}} where there is one.
nlohmann::json toJson(const ReviewedBridge& bridge);

/// The bridges of a scan, from the rectum. Throws Error{bad_input} when `bridge_reviews.json` cannot be understood.
std::vector<ReviewedBridge> reviewedBridges(CaseStore& store, const ScanRecord& scan);

/// Keeps a bridge's review in `bridge_reviews.json` of the scan's folder, in place of an earlier one; no review takes
/// the earlier one back. Empty `by` and `at`: who works here, now. Throws Error{not_found} when the scan has no such
/// bridge.
void reviewBridge(CaseStore& store, const ScanRecord& scan, const ReviewedBridge& given);

}  // namespace vicon
