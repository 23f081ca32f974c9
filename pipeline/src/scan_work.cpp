#include "vicon/pipeline/scan_work.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "memory_limits.h"
#include "scan_results.h"
#include "step_runner.h"
#include "step_table.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/given_lumen.h"
#include "vicon/cases/organs.h"
#include "vicon/cases/step_results.h"
#include "vicon/cases/store_presence.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/pipeline/corrections.h"
#include "vicon/pipeline/organs.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/resample.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::pipeline {
namespace {

json sizesOf(const ScanResults& results, const std::vector<std::string>& files)
{
    json sizes = json::object();
    for (const std::string& file : files)
        sizes[file] = fs::file_size(results.source(file));
    return sizes;
}

/// A worker that was thought dead and is not writes here, where it can spoil nothing of its successor's.
fs::path claimFolder(const fs::path& scan_folder, const Job& job)
{
    removeTemporaries(scan_folder);  // of earlier claims
    return scan_folder / (std::string(kTemporaryPrefix) + "claim-" + std::to_string(job.fence));
}

bool filesAreThere(const fs::path& folder, const json& sizes)
{
    for (const auto& [file, size] : sizes.items()) {
        std::error_code missing;
        if (fs::file_size(folder / file, missing) != size.get<std::uintmax_t>() || missing)
            return false;
    }
    return true;
}

/// What a step's result depends on: its code, its parameters, and the digests of what it reads.
std::string digestOf(const Step& step, const json& parameters, const StepRecords& records,
                     const std::vector<InstanceRecord>& instances)
{
    std::string all = step.name + "\n" + std::to_string(step.version) + "\n" + parameters.dump() + "\n";
    for (const std::string& input : step.inputs)
        all += records.at(input).digest + "\n";
    if (step.inputs.empty())
        for (const InstanceRecord& instance : instances)
            all += instance.sha256 + "\n";
    return sha256(all);
}

json parametersOf(const Step& step, const Config& config, const json& loader_parameters,
                  const std::optional<GivenLumen>& lumen)
{
    json parameters = step.parameters(config);
    if (lumen && step.name == "segment" && config.get<steps::OrganOptions>().isColon())
        parameters["lumen"] = lumen->mask_sha256;
    if (step.inputs.empty())
        parameters.update(loader_parameters);
    return parameters;
}

bool isCurrent(const StepRecord& record, const std::string& digest, const fs::path& folder)
{
    return record.digest == digest && filesAreThere(folder, record.result.value("files", json::object()));
}

bool endsHere(const StepRecord& record)
{
    return record.step == "segment" && segmentFoundFromJson(record.result).verdict == Verdict::absent;
}

/// Voxels of the scan once it is isotropic; 0 when import did not say how large it is.
double isotropicVoxels(const json& ingest, const Config& config)
{
    const json geometry = ingest.value("geometry", json::object());
    if (!geometry.is_object() || !geometry.contains("size") || !geometry.contains("spacing_mm"))
        return 0;
    const auto size = geometry.at("size").get<std::array<double, 3>>();
    const auto spacing_mm = geometry.at("spacing_mm").get<std::array<double, 3>>();
    double edge_mm = config.get<steps::ResampleOptions>().spacing_mm;
    if (edge_mm <= 0)
        edge_mm = *std::min_element(spacing_mm.begin(), spacing_mm.end());
    double voxels = 1;
    for (std::size_t a = 0; a < 3; ++a)
        voxels *= size[a] * spacing_mm[a] / edge_mm;
    return std::isfinite(voxels) ? voxels : 0;
}

/// The configuration for one scan: of its organ, and with what a person said about its lumen.
Config configFor(const Config& config, const fs::path& scan_folder)
{
    return withOrgan(withCorrections(config, readCorrections(scan_folder)), readOrgan(scan_folder));
}

StepRecords recordsOf(CaseStore& store, const ScanRecord& scan)
{
    StepRecords records;
    for (StepRecord& record : store.steps(scan.case_id, scan.id))
        records[record.step] = std::move(record);
    return records;
}

/// The work on one scan, step by step.
class ScanRun {
public:
    ScanRun(CaseStore& store, const Config& config, const AcquiredVolumeLoader& loader, const json& loader_parameters,
            JobContext& context)
        : store_(store),
          context_(context),
          scan_(store.requireScan(context.job().case_id, context.job().scan_id)),
          folder_(store.scanFolder(scan_.case_id, scan_.id)),
          inputs_{configFor(config, folder_),
                  loader,
                  gravityFor(scan_.series.patient_position),
                  folder_ / "dicom",
                  readGivenLumen(folder_),
                  quantityOf(scan_.series)},
          results_(folder_, claimFolder(folder_, context.job()), inputs_.quantity),
          loader_parameters_(loader_parameters),
          instances_(store.instances(scan_.case_id, scan_.id)),
          records_(recordsOf(store, scan_))
    {
    }

    void run()
    {
        if (const double voxels = isotropicVoxels(scan_.ingest, inputs_.config); voxels > 0)
            context_.reserveMemory(expectedMemory_mb(voxels),
                                   machineMemory_mb(inputs_.config.get<WorkOptions>().machine_memory_mb));
        requireThere(store_.place());  // no folder is made where it is gone
        makePrivateFolder(folder_ / "projections");
        removeTemporaries(folder_ / "projections");
        StepRunner(stepTable(),
                   {.is_due = [this](const Step& step) { return isDue(step); },
                    .made = [this](const Step& step, json result) { records_[step.name].result = std::move(result); },
                    .ends = [this](const Step& step) { return endsHere(records_[step.name]); },
                    .written = [this](const Step& step, double seconds) { record(step, seconds); }},
                   inputs_, results_, records_, context_, inputs_.config.get<StepOptions>().at_once)
            .run();
        for (const Step& step : stepTable())
            if (endsHere(records_[step.name]))
                withdrawAfter(step);
        store_.writeScanFile(scan_.case_id, scan_.id);
    }

private:
    bool isDue(const Step& step)
    {
        const json parameters = parametersOf(step, inputs_.config, loader_parameters_, inputs_.lumen);
        const std::string digest = digestOf(step, parameters, records_, instances_);
        StepRecord& record = records_[step.name];
        if (isCurrent(record, digest, folder_))
            return false;
        const double voxels = isotropicVoxels(scan_.ingest, inputs_.config);
        if (voxels > 0)
            requireMemory(voxels, inputs_.config.get<StepOptions>().memory_mb);
        record = {step.name, step.version, digest, parameters, json::object(), 0, {}};
        return true;
    }

    void record(const Step& step, double seconds)
    {
        StepRecord& record = records_[step.name];
        const std::vector<std::string> files = step.outputs(record.result);
        record.result["files"] = sizesOf(results_, files);
        record.seconds = seconds;
        record.finished = nowUtc();
        context_.commitStep(record, [&] {
            results_.publish(files);
            removeFilesBut(step, files);
        });
        store_.writeScanFile(scan_.case_id, scan_.id);
    }

    /// What the step had made of another organ.
    void removeFilesBut(const Step& step, const std::vector<std::string>& kept)
    {
        for (const std::string& file : step.outputs(json::object()))
            if (std::find(kept.begin(), kept.end(), file) == kept.end())
                fs::remove(folder_ / file);
    }

    /// What an earlier run, with other parameters, had found in a scan whose organ is not found now.
    void withdrawAfter(const Step& last)
    {
        std::vector<std::string> steps, files = last.outputs(json::object());
        const json kept = records_[last.name].result.value("files", json::object());
        std::erase_if(files, [&](const std::string& file) { return kept.contains(file); });
        const auto& table = stepTable();
        auto step = std::find_if(table.begin(), table.end(), [&](const Step& s) { return s.name == last.name; });
        for (++step; step != table.end(); ++step) {
            steps.push_back(step->name);
            const std::vector<std::string> made = step->outputs(json::object());
            files.insert(files.end(), made.begin(), made.end());
        }
        context_.withdrawSteps(steps, [&] {
            for (const std::string& file : files)
                fs::remove(folder_ / file);
        });
    }

    CaseStore& store_;
    JobContext& context_;
    ScanRecord scan_;
    fs::path folder_;
    StepInputs inputs_;
    ScanResults results_;
    const json& loader_parameters_;
    std::vector<InstanceRecord> instances_;
    StepRecords records_;
};

}  // namespace

bool isOutdated(CaseStore& store, const Config& config, const json& loader_parameters, const std::string& case_id,
                const std::string& scan_id)
{
    const ScanRecord scan = store.requireScan(case_id, scan_id);
    const auto instances = store.instances(case_id, scan_id);
    StepRecords records = recordsOf(store, scan);
    const fs::path folder = store.scanFolder(case_id, scan_id);
    const Config corrected = configFor(config, folder);
    const std::optional<GivenLumen> lumen = readGivenLumen(folder);
    for (const Step& step : stepTable()) {
        const auto record = records.find(step.name);
        if (record == records.end() ||
            !isCurrent(record->second,
                       digestOf(step, parametersOf(step, corrected, loader_parameters, lumen), records, instances),
                       folder))
            return true;
        if (endsHere(record->second))
            return false;
    }
    return false;
}

JobWork makeScanWork(CaseStore& store, const Config& config, AcquiredVolumeLoader loader, json loader_parameters)
{
    return [&store, config, loader = std::move(loader), parameters = std::move(loader_parameters)](
               JobContext& context) { ScanRun(store, config, loader, parameters, context).run(); };
}

}  // namespace vicon::pipeline
