#include "organs.h"

#include "text_table.h"
#include "vicon/cases/organs.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"
#include "vicon/pipeline/organs.h"
#include "vicon/scan_files/skeleton_file.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

constexpr std::size_t kMostListed = 80;

double meanRadius_mm(const SkeletonBranch& branch)
{
    double sum = 0;
    for (const SkeletonPoint& p : branch.points)
        sum += p.radius_mm;
    return sum / double(branch.points.size());
}

}  // namespace

void setOrgan(CaseStore& store, const Config& config, const std::string& organ, const std::string& case_id,
              const std::string& scan_id)
{
    (void)pipeline::withOrgan(config, Organ(organ));
    const auto say = [&](const ScanRecord& scan) {
        writeOrgan(store.scanFolder(scan.case_id, scan.id), Organ(organ));
        store.audit(AuditEvent::organ_named, scan.case_id, scan.id, organ);
    };
    const CaseRecord record = requireCase(store, case_id, IdPart::whole);
    if (!scan_id.empty()) {
        say(store.requireScan(record.id, scan_id));
        return;
    }
    for (const ScanRecord& scan : store.scans(record.id))
        if (scan.role == ScanRole::scan)
            say(scan);
}

std::string branchTable(const fs::path& scan_folder)
{
    if (!fs::exists(scan_folder / "skeleton.vtp"))
        return {};
    const SkeletonTree tree = scan_files::readSkeletonTree(scan_folder / "skeleton.vtp");
    if (tree.empty())
        return {};
    std::vector<std::vector<std::string>> rows;
    for (std::size_t n = 0; n < std::min(kMostListed, tree.branches.size()); ++n) {
        const SkeletonBranch& branch = tree.branches[n];
        rows.push_back({"  " + std::to_string(n), branch.parent < 0 ? "-" : std::to_string(branch.parent),
                        std::to_string(branch.generation), formatNumber(branch.points.front().station_mm, 0),
                        formatNumber(branch.points.back().station_mm, 0), formatNumber(meanRadius_mm(branch), 1)});
    }
    std::string out = formatTable({"  BRANCH", "PARENT", "GENERATION", "FROM MM", "TO MM", "MEAN RADIUS MM"}, rows);
    if (tree.branches.size() > kMostListed)
        out += "  ... " + std::to_string(tree.branches.size() - kMostListed) + " more in skeleton.vtp\n";
    return out;
}

}  // namespace vicon::app
