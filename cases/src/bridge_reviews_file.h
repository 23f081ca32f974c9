#pragma once

#include <filesystem>
#include <vector>

#include "vicon/cases/bridges.h"

namespace vicon {

/// {"from_mm", "to_mm", "verdict", "by", "at"}: a bridge is known by its two ends.
/// @param verdict empty: an earlier one is taken back
nlohmann::json bridgeReviewJson(const Bridge& bridge, const std::string& verdict, const std::string& by,
                                const std::string& at);

/// The reviews in a scan's `bridge_reviews.json`; none when there is no such file. Of the bridges only the ends are
/// known. Throws Error{bad_input} when it cannot be understood.
std::vector<ReviewedBridge> readBridgeReviews(const std::filesystem::path& scan_folder);
/// Throws Error{store}.
void writeBridgeReviews(const std::filesystem::path& scan_folder, const std::vector<ReviewedBridge>& reviews);

}  // namespace vicon
