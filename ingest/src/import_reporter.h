#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/ingest/import.h"

namespace vicon::ingest {

/// Collects lines; several objects of one series with the same fate and reason become one.
class Reporter {
public:
    explicit Reporter(ImportReport& report) : report_(report) {}
    void object(ImportLine::Kind kind, const std::string& shown, const std::string& series_uid, const std::string& why,
                const std::string& case_id = {});
    void line(ImportLine line) { lines_.push_back({std::move(line), 1, {}}); }
    bool empty() const { return lines_.empty(); }
    /// Writes the lines into the report.
    void finish();

private:
    struct Counted {
        ImportLine line;
        int count = 1;
        std::string series_uid;
    };
    using Fate = std::tuple<std::string, ImportLine::Kind, std::string>;  // of a series' objects; the last is why

    ImportReport& report_;
    std::vector<Counted> lines_;
    std::map<Fate, std::size_t> line_of_;
};

/// What one import works on, and whom it tells.
struct ImportContext {
    CaseStore& store;
    const ImportOptions& options;
    ImportReport& report;
    Reporter& reporter;
    Progress& progress;
};

/// What was said about other objects of a series while its files were inspected; goes into its scan.json.
struct SeriesNotes {
    nlohmann::json set_aside = nlohmann::json::array();
    nlohmann::json refused = nlohmann::json::array();
};

/// A note as scan.json has it.
nlohmann::json noteOf(const std::string& object, const std::string& why);

/// Adds a note to a list that does not have it. Of more than some hundred the last says that there are more: every page
/// of the worklist reads them.
void addNote(nlohmann::json& list, nlohmann::json note);

}  // namespace vicon::ingest
