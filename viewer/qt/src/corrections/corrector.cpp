#include "corrections/corrector.h"

#include <algorithm>

namespace vicon::viewer {
namespace {
constexpr int kWatch_ms = 500;
}

Corrector::Corrector(const ReadingServices& services, const std::string& case_id, QObject* parent)
    : QObject(parent), services_(services), case_id_(case_id), books_(this, services)
{
    connect(books_.worker(), &Worker::failed, this, &Corrector::failed);
    connect(&pipeline_, &Worker::failed, this, &Corrector::failed);
    watch_.setInterval(kWatch_ms);
    connect(&watch_, &QTimer::timeout, this, &Corrector::look);
}

Corrector::~Corrector()
{
    *stop_ = true;
}

void Corrector::change(const QString& said, Change what)
{
    books_.postAlways([this, said, what = std::move(what)](Books& books) -> Worker::Work {
        std::optional<CorrectionHistory::Step> step;
        QString trouble;
        try {
            step = what(books.history, books.store());
        } catch (const std::exception& e) {
            trouble = e.what();
        }
        return [this, said, step, trouble, undo = books.history.toUndo(), redo = books.history.toRedo()] {
            to_undo_ = undo;
            to_redo_ = redo;
            if (step)
                take(*step, said);
            else
                emit failed(trouble);
            emit historyChanged();
        };
    });
}

void Corrector::take(const CorrectionHistory::Step& step, const QString& said)
{
    emit told(said);
    if (step.ofBridge())
        findBridges(step.scan);
    else
        doAgain(step.scan.id);
}

void Corrector::doAgain(const std::string& scan_id)
{
    watched_.insert(scan_id);
    watch_.start();
    emit progressed(tr("waiting"), 0);
    *stop_ = false;
    pipeline_.post("work", [services = services_, stop = stop_]() -> Worker::Work {
        CaseStore own(services.store);
        services.work(own, *stop);
        return {};
    });
}

void Corrector::correct(const ScanRecord& scan, Correction kind, Point3 point)
{
    change(tr("Correction saved; the scan is done again."),
           [scan, kind, point](CorrectionHistory& history, CaseStore& store) {
               return history.correct(store, scan, kind, point);
           });
}

void Corrector::forget(const ScanRecord& scan)
{
    change(tr("Corrections forgotten; the scan is done again."),
           [scan](CorrectionHistory& history, CaseStore& store) { return history.forget(store, scan); });
}

void Corrector::findBridges(const ScanRecord& scan)
{
    books_.post("bridges", [this, scan](Books& books) -> Worker::Work {
        return [this, bridges = services_.bridges(books.store(), scan), id = QString::fromStdString(scan.id)] {
            emit bridgesFound(bridges, id);
        };
    });
}

void Corrector::review(const ScanRecord& scan, const ReviewedBridge& bridge, bool confirmed)
{
    change(
        confirmed
            ? tr("Bridge confirmed; the report says so.")
            : tr("Bridge rejected; the report says so. To keep the two sides apart, drop the piece that is not colon."),
        [scan, bridge, confirmed](CorrectionHistory& history, CaseStore& store) {
            return history.review(store, scan, bridge, confirmed);
        });
}

void Corrector::undo()
{
    change(tr("Undone"), [](CorrectionHistory& history, CaseStore& store) { return history.undo(store); });
}

void Corrector::redo()
{
    change(tr("Done again"), [](CorrectionHistory& history, CaseStore& store) { return history.redo(store); });
}

void Corrector::stop()
{
    *stop_ = true;
}

void Corrector::look()
{
    books_.post("look", [this](Books& books) -> Worker::Work {
        return [this, found = services_.worklist(books.store(), {.words = case_id_})] {
            std::vector<WorklistScan> watched;
            for (const WorklistCase& row : found.cases)
                for (const WorklistScan& scan : row.scans)
                    if (row.record.id == case_id_ && watched_.contains(scan.record.id))
                        watched.push_back(scan);
            if (watch_.isActive())
                show(watched);
        };
    });
}

void Corrector::show(const std::vector<WorklistScan>& watched)
{
    const auto first = [&](WorkState state) {
        const auto found =
            std::find_if(watched.begin(), watched.end(), [&](const auto& scan) { return scan.state == state; });
        return found == watched.end() ? nullptr : &*found;
    };
    const WorklistScan* running = first(WorkState::running);
    const WorklistScan* queued = first(WorkState::queued);
    std::vector<WorklistScan> done;
    for (const WorklistScan& scan : watched)
        if (scan.state != WorkState::running && scan.state != WorkState::queued && watched_.erase(scan.record.id) > 0)
            done.push_back(scan);
    if (running) {
        emit progressed(QString::fromStdString(running->step), running->progress);
    } else if (queued && *stop_) {
        watch_.stop();  // the next correction goes on with them
        emit progressed(tr("stopped; 'vicon work' or the next correction goes on"), -1);
    } else if (queued) {
        emit progressed(tr("waiting"), queued->progress);
    } else if (watched_.empty()) {
        watch_.stop();
        emit progressed({}, -1);
    }
    for (const WorklistScan& scan : done)
        if (scan.ready())
            emit redone(QString::fromStdString(scan.record.id));
        else
            emit failed(tr("The corrected scan cannot be read: %1. Undo (Ctrl+Z) takes the correction back.")
                            .arg(QString::fromStdString(scan.reason)));
}

}  // namespace vicon::viewer
