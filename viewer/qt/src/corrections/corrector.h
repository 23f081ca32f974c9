#pragma once

#include <QObject>
#include <QTimer>
#include <atomic>
#include <memory>
#include <set>

#include "corrections/correction_history.h"
#include "session/own_store.h"
#include "vicon/viewer/qt/reading_room.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// Corrections of a case's scans and what the pipeline makes of them, away from the window's thread.
class Corrector : public QObject {
    Q_OBJECT
public:
    Corrector(const ReadingServices& services, const std::string& case_id, QObject* parent);
    ~Corrector() override;  ///< what runs is stopped; its job waits in the queue

    /// The scan is done again; progressed() and redone() follow, also where another one is still being done.
    void correct(const ScanRecord& scan, Correction kind, Point3 point);
    void forget(const ScanRecord& scan);
    /// bridgesFound() follows.
    void findBridges(const ScanRecord& scan);
    void review(const ScanRecord& scan, const ReviewedBridge& bridge, bool confirmed);
    /// Corrections and verdicts of this reader, one by one. What another reader has changed meanwhile is left as it
    /// is, and failed() says so.
    void undo();
    void redo();
    std::optional<StepNumber> toUndo() const { return to_undo_; }
    std::optional<StepNumber> toRedo() const { return to_redo_; }
    /// What runs is stopped; its job waits in the queue.
    void stop();
    /// A scan is being done again for this reader.
    bool busy() const { return watch_.isActive(); }

signals:
    void bridgesFound(const std::vector<vicon::ReviewedBridge>& bridges, const QString& scan_id);
    /// @param fraction 0 to 1; below 0: nothing is under way
    void progressed(const QString& what, double fraction);
    void redone(const QString& scan_id);
    void historyChanged();
    void told(const QString& message);
    void failed(const QString& message);

private:
    /// What is in the database, and what this reader did to it.
    struct Books {
        explicit Books(const ReadingServices& services) : store(services.store), history(services) {}

        OwnStore store;
        CorrectionHistory history;
    };
    using Change = std::function<CorrectionHistory::Step(CorrectionHistory&, CaseStore&)>;

    void take(const CorrectionHistory::Step& step, const QString& said);
    void change(const QString& said, Change what);
    void doAgain(const std::string& scan_id);
    void look();
    /// How far the scans are that are done again; those that are done are told.
    void show(const std::vector<WorklistScan>& watched);

    const ReadingServices services_;
    std::string case_id_;
    std::set<std::string> watched_;  // the scans that are done again
    std::optional<StepNumber> to_undo_, to_redo_;
    std::shared_ptr<std::atomic<bool>> stop_ = std::make_shared<std::atomic<bool>>(false);
    QTimer watch_;
    WorkerWith<Books> books_;
    Worker pipeline_{this};
};

}  // namespace vicon::viewer
