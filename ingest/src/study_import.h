#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "acquisition.h"
#include "image_object.h"
#include "vicon/cases/case_store.h"
#include "vicon/ingest/import.h"

namespace vicon::ingest {

/// An object that came in, and how the user knows its file.
struct Arrival {
    ImageObject object;
    std::string shown;
};

/// What was said about other objects of a series while its files were inspected; goes into its scan.json.
struct SeriesNotes {
    nlohmann::json set_aside = nlohmann::json::array();
    nlohmann::json refused = nlohmann::json::array();
};

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
    ImportReport& report_;
    std::vector<Counted> lines_;
};

/// Takes the objects of one study into its case.
class StudyImport {
public:
    StudyImport(CaseStore& store, const ImportOptions& options, ImportReport& report, Reporter& reporter,
                Progress& progress)
        : store_(store), options_(options), report_(report), reporter_(reporter), progress_(progress)
    {
    }
    /// @param arrivals of one study, in the order in which they were found
    /// @param notes by Series Instance UID
    void run(std::vector<Arrival> arrivals, std::map<std::string, SeriesNotes>& notes);

private:
    struct Assembled {
        Stack stack;
        StackPlan plan;
        ScanRecord record;
        std::vector<const ImageObject*> objects;
        /// People have spoken of it: its objects, its role and its words stay as they are.
        bool fixed = false;
    };
    struct Home {
        std::string scan_id;
        std::string file;
    };

    void openCase(const Patient& patient, const Study& study);
    void loadStored();
    void admit(std::vector<Arrival> arrivals, std::map<std::string, SeriesNotes>& notes);
    bool isSameAsStored(const ImageObject& object, const std::optional<InstanceRecord>& recorded);
    void quarantine(const std::vector<Arrival>& strangers);
    void dropUndecodable(std::map<std::string, SeriesNotes>& notes);
    void assemble();
    void assembleFixed(const std::string& scan_id, const std::vector<const ImageObject*>& members);
    void assembleFree(const std::string& series_uid, const std::vector<const ImageObject*>& members);
    bool isFixed(const std::string& scan_id) const { return fixed_.contains(scan_id); }
    void chooseRoles();
    void describe(Assembled& scan, const std::map<std::string, SeriesNotes>& notes);
    void addNotes(Assembled& scan, const std::map<std::string, SeriesNotes>& notes);
    void store(Assembled& scan);
    void requireUnspoken(const Assembled& scan);
    std::string flagFor(const Assembled& scan);
    bool isNewFlag(const std::string& line);
    void tellFlag(const std::string& case_id, const std::string& line);
    void tell(const Assembled& scan, bool changed);
    void flagSharedIds();

    CaseStore& store_;
    const ImportOptions& options_;
    ImportReport& report_;
    Reporter& reporter_;
    Progress& progress_;
    CaseRecord case_;
    std::map<std::string, ImageObject> objects_;   ///< by SOP Instance UID: stored ones and arrivals
    std::map<std::string, std::string> shown_;     ///< of arrivals, by SOP Instance UID
    std::map<std::string, Home> stored_at_;        ///< by SOP Instance UID
    std::map<std::string, std::string> scan_of_;   ///< by SOP Instance UID: where it is recorded, damaged ones too
    std::map<std::string, ScanRecord> old_scans_;  ///< by id
    std::set<std::string> fixed_;                  ///< ids of scans that people have spoken of
    std::vector<Assembled> scans_;
};

}  // namespace vicon::ingest
