#pragma once

#include <vector>

#include "vicon/cases/case_store.h"

namespace vicon {

// Markers of one finding: a pair, or of more scans a group with one marker in each. Every one names all others.

/// Whether two markers may be one finding as far as they and those that they are paired with lie in different scans.
/// @param markers of the case
bool mayBeOneFinding(const std::vector<Marker>& markers, const Marker& a, const Marker& b);

/// What joins two markers and those that each is paired with: all of them name each other afterwards. A partner of the
/// one in the scan of the other gives way to it. Throws Error{wrong_use} for two markers of one scan, and where
/// partners of both lie in one scan.
/// @param markers of the case, as they are stored
std::vector<MarkerEdit> pairingEdits(const std::vector<Marker>& markers, const Marker& a, const Marker& b);

}  // namespace vicon
