#include <cstdio>

#include "../command.h"
#include "../organs.h"
#include "../subdivision_table.h"
#include "../text_table.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/orders.h"
#include "vicon/cases/step_results.h"
#include "vicon/cases/whole_id.h"
#include "vicon/cases/worklist.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct ShowArguments {
    std::string case_id;
    std::string scan_id;
    bool subdivision_table = false;
    int settle = 0;  ///< which of the case's flags, counted from 1; 0: none
};

/// Parts of the colon and how well the scan shows them.
void printQuality(const QualityFound& found)
{
    if (!found.quality)
        return;
    const ScanQuality& quality = *found.quality;
    const std::string noise = quality.noise_hu > 0 ? ", noise " + formatNumber(quality.noise_hu, 0) + " HU" : "";
    std::printf("  quality: %s%s%s%s\n", quality.whole.adequate ? "adequate" : "not adequate",
                quality.reason.empty() ? "" : ": ", quality.reason.c_str(), noise.c_str());
    std::vector<std::vector<std::string>> rows;
    const auto addRow = [&](const std::string& name, const std::string& stations, const StretchQuality& q) {
        const auto number = [](double value) { return formatNumber(value, 0); };
        rows.push_back({"  " + name, stations, number(q.median_radius_mm), number(q.collapsed_mm),
                        number(100 * q.collapsed_fraction) + " %", number(q.volume_ml), number(q.fluid_ml),
                        number(100 * q.fluidFraction()) + " %", q.adequate ? "yes" : "no"});
    };
    for (std::size_t n = 0; n < found.parts.size() && n < quality.parts.size(); ++n)
        addRow(nameOf(found.parts[n].part),
               formatNumber(found.parts[n].from_mm, 0) + " - " + formatNumber(found.parts[n].to_mm, 0),
               quality.parts[n]);
    addRow("whole colon", "", quality.whole);
    std::printf("%s", formatTable({"  SEGMENT", "STATION MM", "MEDIAN RADIUS MM", "COLLAPSED MM", "SHARE", "VOLUME ML",
                                   "FLUID ML", "SHARE", "ADEQUATE"},
                                  rows)
                          .c_str());
}

/// What a person said about the lumen.
void printCorrections(const std::filesystem::path& scan_folder)
{
    const Corrections corrections = readCorrections(scan_folder);
    for (const Correction kind : kCorrections)
        for (const Point3 p : corrections.of(kind))
            std::printf("  corrected: %s at %s,%s,%s\n", nameOf(kind).c_str(), formatNumber(p.x, 1).c_str(),
                        formatNumber(p.y, 1).c_str(), formatNumber(p.z, 1).c_str());
}

/// A line of what import said: a repair, or an image and why it is not used.
std::string inWords(const nlohmann::json& line)
{
    if (line.is_string())
        return line.get<std::string>();
    if (!line.is_object() || !line.contains("why"))
        return line.dump();
    return (line.contains("object") ? line.value("object", "") + ": " : "") + line.value("why", "");
}

/// What is being done with a scan, and how far it is.
std::string stateOf(const WorklistScan& scan)
{
    if (scan.state != WorkState::running)
        return nameOf(scan.state);
    return nameOf(scan.state) + " " + formatNumber(100 * scan.progress, 0) + " %, " + scan.step;
}

void printScan(CaseStore& store, const WorklistScan& scan)
{
    const ScanRecord& r = scan.record;
    std::printf("\nscan %s: %s, series %d '%s', %s%s\n", r.id.c_str(), positionName(r.series.patient_position).c_str(),
                r.series.number, r.series.description.c_str(), stateOf(scan).c_str(),
                scan.reason.empty() ? "" : (" (" + scan.reason + ")").c_str());
    std::printf("  %s\n", scan.folder.c_str());
    std::vector<std::vector<std::string>> rows;
    const std::vector<StepRecord> steps = store.steps(r.case_id, r.id);
    const StepResults results = resultsOf(steps);
    for (const StepRecord& step : steps) {
        std::string measures;
        for (const auto& [key, value] : step.result.items())
            if (value.is_number() || value.is_string())
                measures += (measures.empty() ? "" : ", ") + key + " " +
                            (value.is_number_float() ? formatNumber(value.get<double>(), 2)
                             : value.is_string()     ? value.get<std::string>()
                                                     : value.dump());
        rows.push_back({"  " + step.step, formatNumber(step.seconds, 1) + " s", measures});
    }
    if (!rows.empty())
        std::printf("%s", formatTable({"  STEP", "TIME", "MEASURES"}, rows).c_str());
    if (!results.organ().isColon())
        std::printf("  organ: %s\n%s", results.organ().name().c_str(), branchTable(scan.folder).c_str());
    if (results.segment && results.segment->given)
        std::printf("  lumen: %s\n", textOf(*results.segment->given).c_str());
    printCorrections(scan.folder);
    if (results.quality)
        printQuality(*results.quality);
    for (const char* list : {"repairs", "refused", "set_aside"})
        for (const auto& line : r.ingest.value(list, nlohmann::json::array()))
            std::printf("  %s: %s\n", list, inWords(line).c_str());
}

/// What the study was asked for by whom, and what a modality worklist says of it.
void printOrder(const CaseRecord& record, const std::optional<Order>& order)
{
    if (!record.study.accession_number.empty())
        std::printf("accession number %s\n", record.study.accession_number.c_str());
    if (!record.study.referring_physician.empty())
        std::printf("referred by %s\n", record.study.referring_physician.c_str());
    if (order)
        std::printf("ordered as %s%s%s, by the worklist of %s\n",
                    order->procedure.empty() ? "an unnamed procedure" : order->procedure.c_str(),
                    order->reason.empty() ? "" : ": ", order->reason.c_str(), order->peer.c_str());
}

void settle(CaseStore& store, const CaseRecord& record, int number)
{
    if (std::size_t(number) > record.flags.size())
        throw Error(ErrorCode::wrong_use, "the case has " + std::to_string(record.flags.size()) + " flags",
                    "--settle " + std::to_string(number), "'vicon show " + record.id + "' lists them, marked by '!'");
    const std::string flag = record.flags[std::size_t(number) - 1];
    store.settleFlag(record.id, flag);
    std::printf("settled: %s\n", flag.c_str());
}

int show(Context& context, const ShowArguments& arguments)
{
    CaseStore& store = context.existingStore();
    if (arguments.settle > 0) {
        settle(store, requireCase(store, arguments.case_id, IdPart::whole), arguments.settle);
        return 0;
    }
    const CaseRecord record = store.requireCase(arguments.case_id);
    if (!arguments.scan_id.empty())
        store.requireScan(record.id, arguments.scan_id);
    const WorklistCase c = makeWorklistCase(store, context.config().get<QueueOptions>(), record);
    if (arguments.subdivision_table)
        return printSubdivisionTable(store, context.config(), c, arguments.scan_id);
    if (context.json) {
        nlohmann::json out = toJson(std::vector{c})["cases"][0];
        if (const auto order = orderOf(store, record.id))
            out["order"] = *order;
        std::erase_if(out["scans"].get_ref<nlohmann::json::array_t&>(), [&](const nlohmann::json& scan) {
            return !scan["id"].get_ref<const std::string&>().starts_with(arguments.scan_id);
        });
        for (nlohmann::json& scan : out["scans"])
            scan.update(toJson(store.describeScan(record.id, scan["id"])));
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    std::printf("case %s: %s\npatient %s, ID %s, born %s, sex %s\nstudy %s %s\n", record.id.c_str(),
                nameOf(c.state).c_str(), record.patient.name.c_str(), record.patient.id.c_str(),
                record.patient.birth_date.c_str(), record.patient.sex.c_str(), record.study.date.c_str(),
                record.study.description.c_str());
    printOrder(record, orderOf(store, record.id));
    for (const std::string& flag : record.flags)
        std::printf("! %s\n", flag.c_str());
    for (const WorklistScan& scan : c.scans)
        if (scan.record.id.starts_with(arguments.scan_id))
            printScan(store, scan);
    return 0;
}

}  // namespace

Subcommand showCommand()
{
    return {"show", "Show one case: its scans, steps, measures and faults", [](CommandLine& command) {
                auto arguments = std::make_shared<ShowArguments>();
                command.option("CASE", arguments->case_id, "The case's id, whole to change something").required();
                command.option("--scan", arguments->scan_id, "Only this scan").typeName("SCAN");
                command.option("--settle", arguments->settle, "Take the Nth line marked by '!' away: it is decided")
                    .typeName("N")
                    .check(range(1, 1000));
                command.flag(
                    "--subdivision-table", arguments->subdivision_table,
                    "Divide the lumen in every way, and show segments and triangles a cell, as the thesis' Table 2");
                return [arguments](Context& context) { return show(context, *arguments); };
            }};
}

}  // namespace vicon::app
