#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/support/support.h"

namespace vicon::support {

/// Runs vicon on a store and expects exit code 0; returns what it printed.
std::string viconOn(const std::filesystem::path& store, const std::string& arguments);
/// Expects that what was printed is as docs/dev/schemas/SCHEMA.schema.json says.
void expectSchema(const std::string& schema, const nlohmann::json& json);
/// The same with --json. What each subcommand prints first in a program is held against its schema.
nlohmann::json viconJson(const std::filesystem::path& store, const std::string& arguments);

/// A small synthetic study, made once per test program: 160 x 160 x 134 voxels, a colon of full length, without the
/// folds, which such voxels do not resolve.
const std::filesystem::path& smallStudy();

/// A scan of the worklist.
struct ListedScan {
    std::string case_id, scan_id, position, state;
    std::filesystem::path folder;
};
std::vector<ListedScan> listedScans(const std::filesystem::path& store);

/// Imports and prepares the small study, and reads it: a finding of 7 mm at its first polyp, categories; ready to sign.
/// @param facts more of the finding, as `vicon finding` takes it
ListedScan readSmallStudy(const std::filesystem::path& store, const std::string& facts = {});

/// What a command printed, a line each, without those that tell how far it is.
std::vector<std::string> linesWithoutProgress(const std::string& output);

/// Every file of a store: path below STORE/cases to content, recorded times removed; dicom/ included.
std::map<std::string, std::string> filesOf(const std::filesystem::path& store);

}  // namespace vicon::support
