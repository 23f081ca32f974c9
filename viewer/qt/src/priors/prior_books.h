#pragma once

#include <QObject>
#include <filesystem>
#include <map>

#include "session/own_store.h"
#include "vicon/cases/prior_match.h"
#include "vicon/cases/report_versions.h"
#include "vicon/viewer/qt/reading_room.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// A scan of an earlier examination that this store has, prepared.
struct PriorImages {
    CaseRecord record;
    ScanRecord scan;
    std::filesystem::path folder;
};

/// The earlier reports of the patient, what today's findings may be of theirs, and what the reader said of it.
struct PriorPage {
    PriorList list;
    std::vector<std::vector<PriorMatch>> matches;  ///< of each report, of each finding
    std::vector<ScanColon> colons;                 ///< of today's scans
    ReadCase read;
    bool open = true;                 ///< the report may be changed
    std::vector<PriorImages> images;  ///< the last examination first

    /// What the reader said of this finding of a report, whichever of today's it was said of.
    std::vector<const ComparedFinding*> saidOf(const std::string& report_uid, const std::string& prior_uid) const;
};

/// They are read and changed on a thread of their own. A change is refused where another reader was faster; the page
/// follows in either case.
class PriorBooks : public QObject {
    Q_OBJECT
public:
    PriorBooks(const ReadingServices& services, std::string case_id, QObject* parent);

    void refresh();
    /// These two are one thing, or are not.
    void say(const std::string& finding_id, const std::string& report_uid, const std::string& prior_uid,
             bool confirmed);
    void takeBack(const std::string& finding_id, const std::string& report_uid, const std::string& prior_uid);

signals:
    void shown(const vicon::viewer::PriorPage& page);
    void said(const QString& what);
    void warned(const QString& what);

private:
    using Change = std::function<void(CaseStore&, const PriorPage&)>;
    void change(const QString& done, Change change);
    PriorPage pageOf(CaseStore& store, const Progress& wanted) const;

    const PriorServices services_;
    const std::string case_id_;
    WorkerWith<OwnStore> store_;  // last: it ends first
};

}  // namespace vicon::viewer
