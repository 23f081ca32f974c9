// The part of CaseSession that reads scans, on the loader's thread.
#include <QThreadPool>
#include <algorithm>

#include "coverage/coverage_keeper.h"
#include "session/case_session.h"

namespace vicon::viewer {
namespace {

constexpr const char *kOpen = "open", *kOpenBeside = "open beside";

/// Freeing a scan's memory takes long enough to be felt, on whatever thread the last owner is.
void freeInBackground(OpenScan* scan)
{
    QThreadPool::globalInstance()->start([scan] { delete scan; });
}

/// The branch, unless the scan was done again meanwhile and has no such one.
int branchIn(const std::filesystem::path& folder, int branch)
{
    const bool asked = branch >= 0;
    return asked && std::size_t(branch) < PreparedScan::open(folder).tree().branches.size() ? branch : -1;
}

}  // namespace

void CaseSession::open(const std::string& scan_id, bool fresh, int branch)
{
    wanted_scan_ = scan_id;
    loader_.giveUp(kOpen);
    const bool is_beside = beside_ && beside_->record.id == scan_id;
    if (!fresh && is_beside && beside_->made == madeAt(folderOf(scan_id))) {  // else it was done again meanwhile
        loader_.giveUp(kOpenBeside);
        std::swap(scan_, beside_);
        wanted_beside_ = beside_ ? filesOf(beside_->record.id) : std::nullopt;
        emit opened();
        emit besideOpened();
        return;
    }
    giveUpMeasures();
    const auto take = [this](std::shared_ptr<OpenScan> made) {
        if (made->record.id != wanted_scan_)
            return;
        if (scan_ && scan_->record.id == made->record.id)
            made->coverage.unpack(scan_->coverage.packed());  // of the same wall; what was seen is still being written
        lead(std::move(made));
    };
    if (const auto files = filesOf(scan_id))
        load(kOpen, *files, branch, take);
    if (loader_.giveUp(kOpenBeside))
        loadBeside();  // when this one is read
}

void CaseSession::lead(std::shared_ptr<OpenScan> made)
{
    const auto before = std::exchange(scan_, std::move(made));
    if (before && before->record.id != scan_->record.id && besideWanted() == scan_->record.id) {
        loader_.giveUp(kOpenBeside);
        wanted_beside_ = filesOf(before->record.id);
        beside_ = before;
        emit opened();
        emit besideOpened();
        return;
    }
    emit opened();
}

std::string CaseSession::besideWanted() const
{
    return wanted_beside_ && wanted_beside_->record.id == row_.record.id ? wanted_beside_->scan.id : std::string();
}

void CaseSession::besideNotRead(const std::string& scan_id)
{
    if (besideWanted() == scan_id && !(beside_ && beside_->record.id == scan_id))
        wanted_beside_.reset();
}

void CaseSession::cancelOpening()
{
    loader_.giveUp(kOpen);
    wanted_scan_ = scan_ ? scan_->record.id : "";
}

void CaseSession::openBeside(const std::string& scan_id)
{
    if (const auto files = filesOf(scan_id))
        openPriorBeside(files->record, files->scan, files->folder);
}

void CaseSession::openPriorBeside(const CaseRecord& record, const ScanRecord& scan, const std::filesystem::path& folder)
{
    wanted_beside_ = ScanFiles{record, scan, folder};
    loader_.giveUp(kOpenBeside);
    loadBeside();
}

void CaseSession::loadBeside()
{
    constexpr int kFarthest = -1;
    load(kOpenBeside, *wanted_beside_, kFarthest, [this](std::shared_ptr<OpenScan> made) {
        beside_ = std::move(made);
        if (besideIsPrior()) {
            beside_->caption.position += ", EARLIER EXAMINATION";
            beside_->caption.study_date = beside_->saved_caption.study_date;
        }
        emit besideOpened();
    });
}

void CaseSession::closeBeside()
{
    wanted_beside_.reset();
    loader_.giveUp(kOpenBeside);
    beside_.reset();
    emit besideClosed();
}

std::optional<CaseSession::ScanFiles> CaseSession::filesOf(const std::string& scan_id) const
{
    for (const WorklistScan& scan : row_.scans)
        if (scan.record.id == scan_id)
            return ScanFiles{row_.record, scan.record, scan.folder};
    return std::nullopt;
}

std::filesystem::path CaseSession::folderOf(const std::string& scan_id) const
{
    const auto files = filesOf(scan_id);
    return files ? files->folder : std::filesystem::path();
}

/// While the first pictures are drawn, not before them. What cannot be read is said where it is looked at.
void CaseSession::readOn(const PreparedScan& files)
{
    reads_on_.postTask("read on", [files](const Progress& wanted) -> Worker::Work {
        try {
            files.readOn(wanted);
        } catch (const std::exception&) {
        }
        return {};
    });
}

void CaseSession::load(const char* work, const ScanFiles& files, int branch, Opened then)
{
    constexpr int kStages = 3;
    const bool leads = work == kOpen;
    const auto at = [this, leads](int stage, const Progress& wanted) {
        wanted.check();
        if (leads)
            QMetaObject::invokeMethod(
                this, [this, stage] { emit opening(stage, kStages); }, Qt::QueuedConnection);
    };
    loader_.postTask(
        work, [this, of = files, branch, then = std::move(then), leads, at](Progress& wanted) -> Worker::Work {
            const std::filesystem::path& folder = of.folder;
            try {
                at(0, wanted);
                const auto before = madeAt(folder);
                const int way = branchIn(folder, branch);
                auto files = PreparedScan::open(folder, way);
                files.readForFlight(&wanted);
                at(1, wanted);
                const std::shared_ptr<OpenScan> made(new OpenScan(files, of.scan, of.record), freeInBackground);
                made->made = before;
                made->branch = way;
                at(2, wanted);
                CoverageKeeper::restore(made->coverage, folder);
                readOn(files);
                maps_.prepare(made, wanted);
                return [made, then] { then(made); };
            } catch (...) {
                if (!wanted.cancelled())
                    QMetaObject::invokeMethod(
                        this,
                        [this, leads, id = of.scan.id] {
                            if (leads)
                                emit openingFailed();
                            else
                                besideNotRead(id);
                        },
                        Qt::QueuedConnection);
                throw;
            }
        });
}

}  // namespace vicon::viewer
