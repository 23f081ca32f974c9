#include "report_known.h"

#include <cmath>

#include "text_table.h"
#include "vicon/cases/orders.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/quantity.h"
#include "vicon/ingest/acquisition_facts.h"

namespace vicon::app {
namespace {

/// "supine (120 kV, slices of 1.0 mm, kernel B30f)".
std::string techniqueOf(const ScanRecord& scan)
{
    const Series& series = scan.series;
    std::string how;
    const auto add = [&](const std::string& what) { how += (how.empty() ? "" : ", ") + what; };
    if (series.kvp > 0)
        add(formatNumber(series.kvp, 0) + " kV");
    if (series.slice_thickness_mm > 0)
        add("slices of " + formatNumber(series.slice_thickness_mm, 1) + " mm");
    if (!series.kernel.empty())
        add("kernel " + series.kernel);
    const BodyPosition position = bodyPositionFrom(series.patient_position);
    return (position == BodyPosition::unknown ? "position not said" : nameOf(position)) +
           (how.empty() ? "" : " (" + how + ")");
}

/// "supine 212 ml (12 %)"; empty where it was not measured.
std::string fluidOf(CaseStore& store, const ScanRecord& scan)
{
    const StepResults results = resultsOf(store.steps(scan.case_id, scan.id));
    if (!results.quality || !results.quality->quality)
        return {};
    const StretchQuality& whole = results.quality->quality->whole;
    return positionName(scan.series.patient_position) + " " + formatNumber(whole.fluid_ml, 0) + " ml (" +
           formatNumber(100 * whole.fluidFraction(), 0) + " %)";
}

}  // namespace

KnownStudy knownOf(CaseStore& store, const std::string& case_id)
{
    KnownStudy known;
    double dose_mgy_cm = 0;
    bool all_dosed = true;
    Quantity quantity = Quantity::density;
    std::string contrast;
    const auto join = [](std::string& to, const std::string& what, const char* by) {
        if (!what.empty())
            to += (to.empty() ? "" : by) + what;
    };
    for (const ScanRecord& scan : store.scans(case_id)) {
        if (scan.role != ScanRole::scan)
            continue;
        const auto facts =
            ingest::acquisitionFacts(store.scanFolder(case_id, scan.id) / "dicom", store.instances(case_id, scan.id));
        if (known.indication.empty())
            known.indication = facts.reason;
        if (contrast.empty())
            contrast = facts.contrast;
        dose_mgy_cm += facts.dose_mgy_cm.value_or(0);
        all_dosed = all_dosed && facts.dose_mgy_cm;
        join(known.technique, techniqueOf(scan), "; ");
        quantity = quantityOf(scan.series);
        join(known.fluid, fluidOf(store, scan), ", ");
    }
    if (const auto order = orderOf(store, case_id); order && known.indication.empty())
        known.indication = order->reason.empty() ? order->procedure : order->reason;
    if (!known.technique.empty())
        known.technique = std::string(examinationOf(quantity)) + ", " + known.technique +
                          (contrast.empty() ? "" : "; contrast: " + contrast) + ".";
    if (all_dosed && dose_mgy_cm > 0)
        known.dose_mgy_cm = std::round(dose_mgy_cm * 10) / 10;
    return known;
}

}  // namespace vicon::app
