#include "lumen_import.h"

#include "scan_work.h"
#include "vicon/cases/given_lumen.h"
#include "vicon/cases/store_locks.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"
#include "vicon/core/quantity.h"
#include "vicon/ingest/load_scan.h"
#include "vicon/ingest/mask_file.h"
#include "vicon/report/wording.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/steps/given_fit.h"
#include "vicon/steps/lumen_contrast.h"
#include "vicon/steps/resample.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

// Of a lumen's voxels. Chosen on ctc-prone and the phantom of seed 3: VICON's own has 99 %, mirrored along an axis 22
// to 52 %. One that ends three voxels beyond the wall still has four fifths.
constexpr double kLeastFit = 0.7;     // that are gas or tagged fluid: less is refused
constexpr double kUsualFit = 0.85;    // less is said
constexpr double kLeastInScan = 0.5;  // that lie in the scan: less is refused
constexpr double kAllInScan = 0.99;   // less is said
/// Of the scan: a colon is a tenth of an abdomen, and what is more than half of it is what is no colon.
constexpr double kMostOfScan = 0.5;

std::string percent(double share)
{
    return report::percent(share, 0);
}

/// What the pipeline resampled, or would.
HuVolume volumeOf(CaseStore& store, const ScanRecord& scan, const Config& config, Progress& progress)
{
    const fs::path folder = store.scanFolder(scan.case_id, scan.id);
    if (fs::exists(folder / "volume.mha"))
        return scan_files::readVolume<std::int16_t>(folder / "volume.mha");
    return steps::resample(ingest::loadScan(folder / "dicom", config.get<ingest::ImportOptions>(), progress),
                           config.get<steps::ResampleOptions>(), progress);
}

/// The densities that tell a lumen, of MR its signal on the lumen's scale.
HuVolume densitiesOf(CaseStore& store, const ScanRecord& scan, const Config& config, const LumenImport& asked,
                     const InsideVolume& lumen, Progress& progress)
{
    HuVolume volume = volumeOf(store, scan, config, progress);
    if (quantityOf(scan.series) == Quantity::density)
        return volume;
    try {
        return steps::onLumenScaleOf(volume, lumen, config.get<steps::SignalOptions>(), progress);
    } catch (const Error& e) {
        throw Error(e.code(), e.what(), asked.file.string(), e.remedy());
    }
}

std::string fitWords(const steps::GivenFit& fit)
{
    return percent(fit.gasOrFluid()) + " of it is gas or tagged fluid" +
           (fit.mirrored.empty() ? "" : ", " + percent(fit.mirrored_fit) + " with " + fit.mirrored);
}

void requireFit(const steps::GivenFit& fit, const fs::path& file)
{
    const auto refuse = [&](const std::string& what, const std::string& remedy) {
        throw Error(ErrorCode::bad_input, what, file.string(), remedy);
    };
    if (fit.in_scan == 0)
        refuse("does not overlap the scan", "give it to the scan that it was made of");
    if (fit.in_scan < kLeastInScan)
        refuse("only " + percent(fit.in_scan) + " of it lies in the scan", "give it to the scan that it was made of");
    if (fit.of_scan > kMostOfScan)
        refuse("covers " + percent(fit.of_scan) + " of the scan: no lumen", "choose the lumen's label");
    if (fit.gasOrFluid() < kLeastFit)
        refuse("does not lie where the scan's lumen is: only " + fitWords(fit),
               "check the scan, and the mask's axes, left and right above all");
}

void requireSameFrame(const ingest::MaskFile& mask, const ScanRecord& scan, const fs::path& file)
{
    if (mask.form != ingest::MaskForm::segmentation_object)
        return;
    if (mask.frame_of_reference_uid.empty() || mask.frame_of_reference_uid != scan.series.frame_of_reference_uid)
        throw Error(ErrorCode::bad_input, "has another frame of reference than the scan", file.string(),
                    "give it to the scan that it was made of");
}

std::vector<std::string> doubtsOf(const steps::GivenFit& fit)
{
    std::vector<std::string> doubts;
    if (fit.in_scan < kAllInScan)
        doubts.push_back(percent(1 - fit.in_scan) + " of it lies outside the scan and is not used");
    if (fit.gasOrFluid() < kUsualFit)
        doubts.push_back("only " + fitWords(fit) + "; what is as dense as tissue is left out");
    return doubts;
}

}  // namespace

std::vector<ingest::ImportLine> importLumen(CaseStore& store, const Config& config, const LumenImport& asked,
                                            Progress& progress)
{
    using Kind = ingest::ImportLine::Kind;
    const auto queue = config.get<QueueOptions>();
    const StoreLock lock(store.folder(), progress);
    const ScanRecord scan = store.requireScan(requireCase(store, asked.case_id, IdPart::whole).id, asked.scan_id);
    const auto line = [&](Kind kind, const std::string& text) {
        return ingest::ImportLine{kind, asked.file.string(), text, scan.case_id, scan.id};
    };
    requireTakesLumen(store, scan);
    if (asked.file == "none") {
        const bool changed = takeBackLumen(store, queue, scan);
        requeueOutdated(store, config, scan.case_id, scan.id);
        return {line(changed ? Kind::stored : Kind::unchanged, "VICON finds the lumen of " + scan.id + " itself")};
    }
    const double largest_mvoxel = config.get<ingest::ImportOptions>().largest_volume_mvoxel;
    ingest::MaskFile mask = ingest::readMask(asked.file, asked.label, largest_mvoxel, progress);
    requireSameFrame(mask, scan, asked.file);
    const steps::GivenFit fit = steps::fitOf(densitiesOf(store, scan, config, asked, mask.mask, progress), mask.mask,
                                             mask.lattice_middle_mm, config.get<steps::SegmentOptions>(), progress);
    requireFit(fit, asked.file);
    giveLumen(
        store, queue, scan, mask.mask,
        {.form = nameOf(mask.form), .sha256 = mask.sha256, .label = mask.label, .gas_or_fluid = fit.gasOrFluid()});
    requeueOutdated(store, config, scan.case_id, scan.id);
    std::vector<ingest::ImportLine> lines{
        line(Kind::stored, nameOf(mask.form) + ", label " + std::to_string(mask.label) + ": the lumen of " + scan.id +
                               "; " + percent(fit.gas) + " gas, " + percent(fit.fluid) + " tagged fluid")};
    for (const std::vector<std::string>& some : {mask.notes, doubtsOf(fit)})
        for (const std::string& text : some)
            lines.push_back(line(Kind::flagged, text));
    return lines;
}

}  // namespace vicon::app
