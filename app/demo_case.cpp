#include "demo_case.h"

#include <unistd.h>

#include <algorithm>

#include "progress_line.h"
#include "scan_work.h"
#include "vicon/cases/worklist.h"
#include "vicon/core/error.h"
#include "vicon/ingest/import.h"
#include "vicon/pipeline/worker.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

constexpr const char* kPatient = "PHANTOM-";  // the IDs of what is synthesised begin so

/// The images, until they are imported.
class StudyFolder {
public:
    explicit StudyFolder(const fs::path& store) : folder_(store / ("demo-" + std::to_string(::getpid()))) {}
    ~StudyFolder()
    {
        std::error_code none;
        fs::remove_all(folder_, none);
    }
    StudyFolder(const StudyFolder&) = delete;
    StudyFolder& operator=(const StudyFolder&) = delete;
    const fs::path& path() const { return folder_; }

private:
    fs::path folder_;
};

std::optional<CaseRecord> syntheticCase(CaseStore& store)
{
    for (const CaseRecord& some : store.cases())
        if (some.patient.id.rfind(kPatient, 0) == 0)
            return some;
    return std::nullopt;
}

void importStudy(Context& context, const phantom::PhantomOptions& options)
{
    const StudyFolder study(context.store().folder());
    ProgressLine making("phantom"), importing("import");
    phantom::writeStudy(study.path(), options, making);
    making.clear();
    ingest::importPaths(context.store(), {study.path()}, context.config().get<ingest::ImportOptions>(), importing);
    importing.clear();
}

/// Returns why a scan could not be prepared; empty: all can be read.
std::string prepare(Context& context)
{
    ProgressLine progress("work");
    std::string failed;
    pipeline::WorkerEvents events;
    events.progress = [&](const Job& job, double fraction, const std::string& what) {
        progress.rename("prepare " + job.scan_id);
        progress.report(fraction, what);
    };
    events.ended = [&](const Job&, JobState state, const std::string& reason) {
        if (state == JobState::failed)
            failed = reason;
    };
    auto options = context.config().get<pipeline::WorkOptions>();
    options.until_idle = true;
    pipeline::runWorker(context.store(), context.config().get<QueueOptions>(), options,
                        scanWork(context.store(), context.config()), events, stopRequested());
    progress.clear();
    return failed;
}

}  // namespace

std::string demoCase(Context& context, const phantom::PhantomOptions& study)
{
    CaseStore& store = context.store();
    if (!syntheticCase(store))
        importStudy(context, study);
    const std::string failed = prepare(context);
    const auto made = syntheticCase(store);
    const fs::path folder = store.folder();
    if (stopRequested() || !made)
        throw Error(ErrorCode::not_ready, "the synthetic case is not complete yet", folder.string(),
                    "run the same command again; it goes on where it stopped");
    if (!failed.empty())
        throw Error(ErrorCode::not_ready, "the synthetic case could not be prepared: " + failed, folder.string(),
                    "remove this folder and run the same command again");
    return made->id;
}

}  // namespace vicon::app
