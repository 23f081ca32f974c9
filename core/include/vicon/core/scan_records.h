#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vicon {

/// What becomes of a scan.
enum class ScanRole {
    scan,     ///< goes through the pipeline
    kept,     ///< stored and selectable, not queued: another reconstruction, too few slices
    refused,  ///< its objects are stored, but make no volume: `ingest` says why, more objects may mend it
};
/// "scan", "kept", "refused".
std::string nameOf(ScanRole role);
/// Throws Error{bad_input} for any other name.
ScanRole scanRoleFrom(const std::string& name);

/// A finished step of the pipeline.
struct StepRecord {
    std::string step;
    int version = 0;            ///< of the step's code
    std::string digest;         ///< of parameters, version and everything it was computed from
    nlohmann::json parameters;  ///< as they were used
    nlohmann::json result;      ///< measures, for scan.json
    double seconds = 0;
    std::string finished;
};

}  // namespace vicon
