#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/audit_event.h"
#include "vicon/cases/database.h"
#include "vicon/cases/marker.h"
#include "vicon/cases/records.h"
#include "vicon/scan_files/description_file.h"

namespace vicon {

/// Where a store lies: its folder (data), and its database (state).
struct StorePlace {
    std::filesystem::path folder;
    std::string database;  ///< the address of a PostgreSQL database; empty: vicon.db in the folder

    StorePlace() = default;
    StorePlace(std::filesystem::path the_folder, std::string the_database = {})
        : folder(std::move(the_folder)), database(std::move(the_database))
    {
    }
    /// Whether a store was made in the folder. Throws Error{store} where this account may not know.
    bool holdsStore() const;
    /// Whether cases or objects lie in the folder, also where its database is gone.
    bool holdsData() const;
};

struct StoreOptions {
    std::string database;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("store.database", database, "",
          "Where the state lies that several machines share: a PostgreSQL address, postgresql://USER@HOST/NAME; empty: "
          "vicon.db in the store.");
    }
};

/// What shall become of one marker: `before` as the reader saw it (nothing: it is new), `after` as it shall be
/// (nothing: it is deleted).
struct MarkerEdit {
    std::optional<Marker> before, after;
};

/// A store: its folder (data) and its database (state). Every method that changes something is one transaction.
class CaseStore {
public:
    /// Opens a store, and makes it when its folder does not exist or is empty. Throws Error{store} or Error{database},
    /// also where the folder holds data and the database is gone or empty: a new one would know nothing of them.
    explicit CaseStore(const StorePlace& place);
    explicit CaseStore(const std::filesystem::path& folder) : CaseStore(StorePlace(folder)) {}

    /// To be opened by another thread or process as well.
    const StorePlace& place() const { return place_; }
    const std::filesystem::path& folder() const { return place_.folder; }
    std::filesystem::path caseFolder(const std::string& case_id) const;
    std::filesystem::path scanFolder(const std::string& case_id, const std::string& scan_id) const;
    Database& database() { return database_; }

    /// Names derived from UIDs: short, stable, safe as path, free of patient data.
    static std::string caseIdFor(const std::string& study_uid);
    static std::string scanIdFor(const std::string& scan_key);

    std::vector<CaseRecord> cases();
    std::optional<CaseRecord> findCase(const std::string& case_id);
    std::optional<CaseRecord> findCaseByStudy(const std::string& study_uid);
    std::vector<CaseRecord> findCasesByPatient(const std::string& patient_id);
    /// The case of that id, or the only one whose id begins so. Throws Error{not_found}.
    CaseRecord requireCase(const std::string& case_id);
    /// The scans of a case, in order of series number, then id.
    std::vector<ScanRecord> scans(const std::string& case_id);
    /// Those of several cases at once, in the same order.
    std::vector<ScanRecord> scans(const std::vector<CaseRecord>& cases);
    /// The named scan; with an empty name the only scan of role "scan". Throws Error{not_found} or Error{wrong_use}.
    ScanRecord requireScan(const std::string& case_id, const std::string& scan_id);

    std::optional<InstanceRecord> findInstance(const std::string& sop_uid);
    std::vector<InstanceRecord> instances(const std::string& case_id, const std::string& scan_id);

    /// Adds a case, or to it, and adds or replaces its scan and the scan's instances in one transaction, after their
    /// files were written; then rewrites scan.json. A case that is there keeps its flags, and gets `flag` unless that
    /// is empty. `queue` puts a job for the scan into the queue; a scan whose role is no longer "scan" leaves it unless
    /// its job is done. `require` runs first, within the transaction: when it throws, nothing is written.
    void addScan(const CaseRecord& a_case, const ScanRecord& scan, const std::vector<InstanceRecord>& instances,
                 bool queue, const std::function<void()>& require = {}, const std::string& flag = {});
    /// Forgets a scan and removes its folder, unless an image or a marker is recorded in it: then it stays as it is.
    void removeScan(const std::string& case_id, const std::string& scan_id);
    /// Adds a line for a person to the case; the same line is kept once.
    void flag(const std::string& case_id, const std::string& line);
    /// Takes a line away that a person has decided; it does not come back. Throws Error{not_found} where there is none.
    void settleFlag(const std::string& case_id, const std::string& line);
    /// Whether the case ever had this line, also where a person took it away.
    bool wasFlagged(const std::string& case_id, const std::string& line);

    std::vector<StepRecord> steps(const std::string& case_id, const std::string& scan_id);

    /// What scan.json says of a scan. The database owns all of it; the file is a copy.
    scan_files::ScanDescription describeScan(const std::string& case_id, const std::string& scan_id);
    void writeScanFile(const std::string& case_id, const std::string& scan_id);

    std::vector<Marker> markers(const std::string& case_id);
    Marker requireMarker(const std::string& case_id, const std::string& marker_id);
    /// Adds (an empty id gets the next one) or replaces a marker, whatever is stored. Returns it as saved.
    Marker saveMarker(const std::string& case_id, Marker marker);
    void removeMarker(const std::string& case_id, const std::string& marker_id);
    /// All of these edits in one transaction, or none. A pair holds on both sides or not at all: who deletes or parts a
    /// marker, or pairs it with another, also parts the one that it was paired with.
    /// Returns what was done, with ids and times as saved, and the partners that were parted at the end.
    /// Throws Error{bad_input} when a stored marker is no longer what the reader saw, and Error{not_found} when the
    /// case is gone; nothing was written then.
    std::vector<MarkerEdit> editMarkers(const std::string& case_id, std::vector<MarkerEdit> edits);
    /// Why markers.json could not be written after the last change; empty when it was. The change itself is saved: the
    /// database owns the markers, and the copy is written anew by the next change or when the store is opened.
    const std::string& markerFileTrouble() const { return marker_file_trouble_; }

    /// Next value of a counter that belongs to `name`, starting with 1.
    int nextNumber(const std::string& name);
    void audit(AuditEvent event, const std::string& case_id, const std::string& scan_id, const std::string& detail);

private:
    void makeSearchWords();
    void renewMarkerFiles();
    void renewMarkerFiles(const std::string& case_id);
    void writeMarkerFiles(const std::string& case_id);

    StorePlace place_;
    Database database_;
    std::string marker_file_trouble_;
};

}  // namespace vicon
