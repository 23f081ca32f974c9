#include "coverage/coverage_keeper.h"

#include <unistd.h>

#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

constexpr const char* kSearch = "unseen";

/// Two readers of one case each have their own eyes.
std::filesystem::path fileFor(const std::filesystem::path& scan_folder)
{
    const std::string name = scan_folder.filename().string() + "-user" + std::to_string(getuid()) + ".seen";
    return scan_folder.parent_path() / "reading" / name;
}

}  // namespace

CoverageKeeper::CoverageKeeper(QObject* parent) : QObject(parent)
{
    connect(worker_.worker(), &Worker::failed, this, &CoverageKeeper::failed);
}

void CoverageKeeper::restore(ScanCoverage& seen, const std::filesystem::path& scan_folder)
{
    if (std::error_code none; std::filesystem::exists(fileFor(scan_folder), none))
        seen.unpack(readFile(fileFor(scan_folder)));  // of an older surface: the reader begins anew
}

void CoverageKeeper::findUnseen(std::shared_ptr<OpenScan> scan, double least_mm2)
{
    const int search = ++latest_search_;
    worker_.giveUp(kSearch);
    worker_.post(
        kSearch, [this, search, scan = std::move(scan), least_mm2](Written&, const Progress& wanted) -> Worker::Work {
            UnseenOptions options;
            options.least_area_mm2 = least_mm2;
            const auto& cells = scan->files.cells();
            auto patches = unseenPatches(cells.points_mm, cells.triangles, scan->coverage.coverage(),
                                         scan->files.skeleton(), scan->files.frames(), scan->lumen, options, &wanted);
            return [this, search, scan, patches = std::move(patches)] {
                if (search == latest_search_)
                    emit found(patches, scan);
            };
        });
}

void CoverageKeeper::save(std::shared_ptr<OpenScan> scan)
{
    worker_.postAlways([scan = std::move(scan)](Written& written) -> Worker::Work {
        std::string bytes = scan->coverage.packed();
        const auto file = fileFor(scan->files.folder());
        if (bytes == written[file] || !std::filesystem::exists(scan->files.folder()))  // the case may have been deleted
            return {};
        makePrivateFolder(file.parent_path());
        replaceFile(file, bytes);
        written[file] = std::move(bytes);
        return {};
    });
}

}  // namespace vicon::viewer
