#pragma once

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"
#include "vicon/pipeline/corrections.h"

namespace vicon::app {

/// Adds what a person says about one scan to what was said before, and puts its job back where it failed. What is
/// out of date then is queued by requeueOutdated(); steps that do not depend on it are kept.
/// @param forget what was said before
/// Throws Error{wrong_use} for a point outside the scan.
void correctScan(CaseStore& store, const Config& config, const ScanRecord& scan, const pipeline::Corrections& more,
                 bool forget = false);

/// The bridges of a scan as scan.json has them, from the rectum; those that a person has judged carry
/// {"review": {"verdict": "confirmed|rejected", "by", "at"}}.
nlohmann::json reviewedBridges(CaseStore& store, const ScanRecord& scan);

/// What a person says of a bridge, which is known by its two ends.
struct BridgeReview {
    Point3 from_mm, to_mm;
    std::string verdict;  ///< "confirmed" or "rejected"; empty: nobody has judged it
    std::string by, at;   ///< empty: who works here, now
};

/// Keeps a review as `bridge_reviews.json` in the scan's folder, in place of an earlier one. Throws Error{not_found}
/// when the scan has no such bridge.
void reviewBridge(CaseStore& store, const ScanRecord& scan, const BridgeReview& review);

}  // namespace vicon::app
