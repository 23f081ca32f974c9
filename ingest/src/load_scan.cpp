#include "vicon/ingest/load_scan.h"

#include <tbb/parallel_for.h>

#include "helper.h"
#include "inspect.h"
#include "scan_reader.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Of the work of loading, what reading the headers is.
constexpr double kHeaderPart = 0.1;

class PartOfProgress : public Progress {
public:
    explicit PartOfProgress(Progress& whole) : whole_(whole) {}
    void report(double fraction, std::string_view what) override
    {
        whole_.report(kHeaderPart + (1 - kHeaderPart) * fraction, what);
    }
    bool cancelled() const override { return whole_.cancelled(); }

private:
    Progress& whole_;
};

std::vector<fs::path> storedFiles(const fs::path& folder)
{
    std::error_code failure;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, failure))
        if (entry.path().extension() == ".dcm" && !entry.path().filename().string().starts_with(kTemporaryPrefix))
            files.push_back(entry.path());
    if (failure || files.empty())
        throw Error(ErrorCode::not_found, "the scan has no DICOM files", folder.string(), "import the study again");
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

HuVolume loadScan(const fs::path& dicom_folder, const ImportOptions& options, Progress& progress)
{
    struct EndHelpers {
        ~EndHelpers() { endIdleHelpers(); }
    } const at_the_end;
    const std::vector<fs::path> files = storedFiles(dicom_folder);
    std::vector<Inspection> inspected(files.size());
    progress.report(0, "reading headers");
    tbb::parallel_for(std::size_t(0), files.size(), [&](std::size_t n) {
        progress.check();
        inspected[n] = inspectFile(files[n], options);
    });
    std::vector<const ImageObject*> objects;
    for (const Inspection& inspection : inspected) {
        if (inspection.verdict != Inspection::Verdict::image)
            throw Error(ErrorCode::bad_input, inspection.reason,
                        files[std::size_t(&inspection - inspected.data())].string(),
                        "the stored file was changed or damaged; import the study again");
        objects.push_back(&inspection.object);
    }
    const std::vector<Stack> stacks = splitSeries(objects, comparePixels(progress));
    const StackPlan plan = planStack(stacks.front(), options);
    if (!plan.refused.empty())
        throw Error(ErrorCode::bad_input, plan.refused, dicom_folder.parent_path().filename().string(),
                    "look at scan.json for what import found, or change the limits of import");
    PartOfProgress rest(progress);
    return readVolume(stacks.front(), plan, rest);
}

}  // namespace vicon::ingest
