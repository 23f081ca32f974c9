#include "vicon/ingest/import.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <set>

#include "helper.h"
#include "import_reporter.h"
#include "input_files.h"
#include "inspect.h"
#include "report_import.h"
#include "stored_files.h"
#include "study_import.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/printable.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Of the work of an import, what reading and hashing the files is.
constexpr double kReadingPart = 0.6;

struct Found {
    InputFile file;
    Inspection inspection;
};

/// A file may be gone, or become unreadable, after it was inspected.
void hashImage(Found& found)
{
    if (found.inspection.verdict != Inspection::Verdict::image)
        return;
    try {
        found.inspection.object.sha256 = sha256OfFile(found.file.path);
    } catch (const Error& e) {
        found.inspection = {Inspection::Verdict::refused, e.what(), {}};
    }
}

/// A file whose study could not be taken.
struct Refused {
    std::string shown;
    fs::path file;
    bool unpacked = false;
};

/// Inspects and hashes all files, in parallel.
std::vector<Found> inspectAll(const std::vector<InputFile>& files, const ImportOptions& options, Progress& progress)
{
    std::vector<Found> found(files.size());
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    tbb::parallel_for(std::size_t(0), files.size(), [&](std::size_t n) {
        found[n] = {files[n], inspectFile(files[n].path, options)};
        hashImage(found[n]);
        const std::lock_guard lock(telling);
        progress.check();
        progress.report(kReadingPart * double(++done) / double(files.size()), "reading DICOM files");
    });
    return found;
}

/// The zip files among what was found are replaced by what they hold.
void openArchives(std::vector<Found>& found, UnpackFolder& folder, const ImportOptions& options, Progress& progress,
                  std::vector<ImportLine>& lines)
{
    std::vector<Found> all;
    for (Found& one : found) {
        if (one.inspection.verdict != Inspection::Verdict::archive) {
            all.push_back(std::move(one));
            continue;
        }
        for (Found& inside : inspectAll(unpackZip(one.file, folder, options, progress, lines), options, progress)) {
            if (inside.inspection.verdict == Inspection::Verdict::archive)
                inside.inspection = {Inspection::Verdict::refused, "a zip file inside a zip file", {}};
            all.push_back(std::move(inside));
        }
    }
    found = std::move(all);
}

/// The decoder programs end with the import that asked them.
struct EndHelpers {
    ~EndHelpers() { endIdleHelpers(); }
};

std::string namesOf(const std::vector<fs::path>& paths)
{
    std::string names;
    for (const fs::path& path : paths)
        names += (names.empty() ? "" : ", ") + path.string();
    return names;
}

class Import {
public:
    Import(CaseStore& store, const ImportOptions& options, Progress& progress)
        : store_(store), options_(options), progress_(progress)
    {
    }

    ImportReport run(const std::vector<fs::path>& paths)
    {
        const auto unpacked = unpackFolder();
        std::vector<ImportLine> lines;
        const std::vector<InputFile> files = listFiles(paths, lines);
        std::vector<Found> found = inspectAll(files, options_, progress_);
        openArchives(found, *unpacked, options_, progress_, lines);
        for (ImportLine& line : lines) {
            ++report_.refused;
            reporter_.line(std::move(line));
        }
        for (Found& one : found)
            sort(std::move(one));
        if (order_.empty() && reporter_.empty())
            reporter_.line({ImportLine::Kind::refused,
                            namesOf(paths),
                            "nothing to import: no file there (links to folders are not followed, a DICOMDIR is no "
                            "image)",
                            {},
                            {}});
        importStudies();
        reporter_.finish();
        return std::move(report_);
    }

private:
    std::unique_ptr<UnpackFolder> unpackFolder()
    {
        const StoreLock lock(store_.folder(), progress_);
        const fs::path incoming = store_.folder() / "incoming";
        UnpackFolder::removeLeftovers(incoming);
        return std::make_unique<UnpackFolder>(incoming);
    }

    void sort(Found found)
    {
        using Verdict = Inspection::Verdict;
        using Kind = ImportLine::Kind;
        Inspection& inspection = found.inspection;
        ImageObject& object = inspection.object;
        if (inspection.verdict == Verdict::image) {
            auto& study = studies_[object.study.uid];
            if (study.empty())
                order_.push_back(object.study.uid);
            study.push_back({std::move(object), found.file.shown, found.file.unpacked});
            return;
        }
        if (inspection.verdict == Verdict::report) {
            const StoreLock lock(store_.folder(), progress_, kReadingPart);
            takeReport(object, found.file.shown, found.file.unpacked, context_);
            return;
        }
        if (inspection.verdict == Verdict::directory) {  // says nothing that the files do not say
            report_.not_stored.push_back(found.file.path);
            return;
        }
        if (!found.file.unpacked)
            report_.not_stored.push_back(found.file.path);
        const bool aside = inspection.verdict == Verdict::set_aside;
        reporter_.object(aside ? Kind::set_aside : Kind::refused, found.file.shown, object.series.uid,
                         inspection.reason);
        if (object.series.uid.empty())
            return;
        const std::string name =
            object.sop_uid.empty() ? printable(found.file.path.filename().string()) : object.sop_uid;
        SeriesNotes& notes = notes_[object.series.uid];
        addNote(aside ? notes.set_aside : notes.refused, noteOf(name, inspection.reason));
    }

    void importStudies()
    {
        for (std::size_t n = 0; n < order_.size(); ++n) {
            progress_.check();
            const double done = kReadingPart + (1 - kReadingPart) * double(n) / double(order_.size());
            progress_.report(done, "storing studies");
            // Study by study: what a scanner sends meanwhile need not wait until a whole archive is taken.
            const StoreLock lock(store_.folder(), progress_, done);
            importStudy(studies_[order_[n]]);
        }
        progress_.report(1, "imported");
    }

    /// What is wrong with the store, its database or memory ends the import, so that it can be done again; what is
    /// wrong with a study costs that study.
    void importStudy(std::vector<Arrival>& arrivals)
    {
        std::vector<Refused> all;
        for (const Arrival& arrival : arrivals)
            all.push_back({arrival.shown, arrival.object.file, arrival.unpacked});
        const std::string series = arrivals.front().object.series.uid;
        try {
            StudyImport(context_).run(std::move(arrivals), notes_);
        } catch (const Error& e) {
            if (e.code() != ErrorCode::bad_input)
                throw;
            refuseAll(all, series, e.what());
        } catch (const std::bad_alloc&) {
            throw Error(ErrorCode::no_memory, "not enough memory for a study", series, "close other programs");
        } catch (const fs::filesystem_error& e) {
            throw Error(ErrorCode::store, "a file cannot be used (" + e.code().message() + ")", e.path1().string(),
                        "check that the store is yours, and its disk not full");
        } catch (const std::exception&) {  // a library's words may hold what came from outside
            refuseAll(all, series, "its study cannot be taken");
        }
    }

    /// Some of them may be in the store already: what is kept twice is not lost.
    void refuseAll(const std::vector<Refused>& all, const std::string& series, const std::string& why)
    {
        const std::set<fs::path> refused_before(report_.not_stored.begin(), report_.not_stored.end());
        for (const Refused& one : all) {
            reporter_.object(ImportLine::Kind::refused, one.shown, series, why);
            if (!one.unpacked && !refused_before.contains(one.file))
                report_.not_stored.push_back(one.file);
        }
    }

    CaseStore& store_;
    const ImportOptions& options_;
    Progress& progress_;
    ImportReport report_;
    Reporter reporter_{report_};
    const ImportContext context_{store_, options_, report_, reporter_, progress_};
    std::vector<std::string> order_;  ///< study UIDs as they were found first
    std::map<std::string, std::vector<Arrival>> studies_;
    std::map<std::string, SeriesNotes> notes_;
};

}  // namespace

nlohmann::json toJson(const ImportLine& line)
{
    return {{"kind", nameOf(line.kind)},
            {"subject", line.subject},
            {"text", line.text},
            {"case", line.case_id},
            {"scan", line.scan_id}};
}

std::string nameOf(ImportLine::Kind kind)
{
    switch (kind) {
        case ImportLine::Kind::stored:
            return "stored";
        case ImportLine::Kind::unchanged:
            return "unchanged";
        case ImportLine::Kind::kept:
            return "kept";
        case ImportLine::Kind::set_aside:
            return "set aside";
        case ImportLine::Kind::refused:
            return "refused";
        case ImportLine::Kind::quarantined:
            return "quarantined";
        case ImportLine::Kind::repaired:
            return "repaired";
        case ImportLine::Kind::flagged:
            return "flagged";
    }
    return "unknown";
}

ImportReport importPaths(CaseStore& store, const std::vector<fs::path>& paths, const ImportOptions& options,
                         Progress& progress)
{
    const EndHelpers at_the_end;
    return Import(store, options, progress).run(paths);
}

}  // namespace vicon::ingest
