#include <cstdio>

#include "dicom_writer.h"
#include "random.h"
#include "uid.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/phantom/phantom.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;

namespace vicon::phantom {
namespace {

nlohmann::json triple(Point3 p)
{
    return {p.x, p.y, p.z};
}

/// Tells of one scan's share of the whole.
class PartProgress : public Progress {
public:
    PartProgress(Progress& whole, double from, double share) : whole_(whole), from_(from), share_(share) {}
    void report(double fraction, std::string_view what) override { whole_.report(from_ + share_ * fraction, what); }
    bool cancelled() const override { return whole_.cancelled(); }

private:
    Progress& whole_;
    double from_, share_;
};

/// All options shape the voxels, so all shape the identifiers: other voxels never come under a known one.
StudyHeader headerFor(const PhantomOptions& options)
{
    StudyHeader study;
    nlohmann::json shaping = toJson(options);
    // Studies keep the identifiers that they had before there was MR, stool, film and what follows.
    if (options.mr == MrLumen::none)
        shaping.erase("phantom.mr");
    if (options.stool == 0)
        shaping.erase("phantom.stool");
    if (!options.film)
        shaping.erase("phantom.film");
    const nlohmann::json usual = toJson(PhantomOptions());
    for (const char* later : {"phantom.kernel", "phantom.thickness_mm", "phantom.tagging_hu", "phantom.bubbles",
                              "phantom.contrast", "phantom.hips"})
        if (shaping.at(later) == usual.at(later))
            shaping.erase(later);
    study.key = Random(options.seed, shaping.dump()).bits();
    study.study_uid = uidFor(study.key, "study");
    const std::string seed = std::to_string(options.seed);
    study.patient_name = "Phantom^Seed" + seed;
    study.patient_id = "PHANTOM-" + seed;
    study.birth_date = std::to_string(1940 + int(options.seed % 40)) + "0115";
    study.sex = "M";
    study.date = "20240115";
    study.accession_number = "P" + seed;
    study.study_id = seed.substr(0, 16);
    if (options.mr != MrLumen::none)
        study.description = "MR COLONOGRAPHY";
    return study;
}

void prepareFolder(const fs::path& out)
{
    std::error_code problem;
    if (fs::exists(out, problem) && (!fs::is_directory(out, problem) || !fs::is_empty(out, problem)))
        throw Error(ErrorCode::wrong_use, "the folder for the phantom is not empty", out.string(),
                    "name a new or an empty folder");
    makePrivateFolder(out);
}

}  // namespace

nlohmann::json describeTruth(const PhantomTruth& truth)
{
    nlohmann::json out = {
        {"length_mm", truth.length_mm}, {"volume_ml", truth.volume_ml},
        {"fluid_ml", truth.fluid_ml},   {"euler_number", truth.euler_number},
        {"noise_hu", truth.noise_hu},   {"blur_mm", truth.blur_mm},
        {"parts", toJson(truth.parts)}, {"gravity", {truth.gravity.x, truth.gravity.y, truth.gravity.z}}};
    if (truth.ileum.length_mm > 0)
        out["ileum"] = {{"valve_mm", triple(truth.ileum.valve_mm)},     {"station_mm", truth.ileum.station_mm},
                        {"neck_radius_mm", truth.ileum.neck_radius_mm}, {"radius_mm", truth.ileum.radius_mm},
                        {"length_mm", truth.ileum.length_mm},           {"through_fluid", truth.ileum.through_fluid}};
    for (const char* list :
         {"curve_mm", "station_mm", "wall_mm", "radius_mm", "polyps", "gaps", "pools", "stool", "films", "bubbles"})
        out[list] = nlohmann::json::array();
    for (const SkeletonPoint& point : truth.curve) {
        out["curve_mm"].push_back(triple(point.position_mm));
        out["station_mm"].push_back(point.station_mm);
        out["radius_mm"].push_back(point.radius_mm);
    }
    out["wall_mm"] = truth.wall_mm;
    for (const Polyp& polyp : truth.polyps)
        out["polyps"].push_back({{"position_mm", triple(polyp.position_mm)},
                                 {"station_mm", polyp.station_mm},
                                 {"diameter_mm", polyp.diameter_mm},
                                 {"angle_deg", polyp.clock_deg}});
    for (const CollapsedGap& gap : truth.gaps)
        out["gaps"].push_back({{"from_mm", gap.from_mm}, {"to_mm", gap.to_mm}});
    for (const FluidPool& pool : truth.pools)
        out["pools"].push_back({{"from_mm", pool.from_mm},
                                {"to_mm", pool.to_mm},
                                {"level_mm", pool.level_mm},
                                {"density_hu", pool.density_hu}});
    for (const StoolLump& lump : truth.stool)
        out["stool"].push_back({{"position_mm", triple(lump.position_mm)},
                                {"station_mm", lump.station_mm},
                                {"diameter_mm", lump.diameter_mm},
                                {"density_hu", lump.density_hu},
                                {"airy", lump.airy}});
    for (const GasBubble& bubble : truth.bubbles)
        out["bubbles"].push_back({{"position_mm", triple(bubble.position_mm)}, {"diameter_mm", bubble.diameter_mm}});
    for (const TaggingFilm& film : truth.films)
        out["films"].push_back(
            {{"polyp", film.polyp}, {"thickness_mm", film.thickness_mm}, {"density_hu", film.density_hu}});
    return out;
}

void writeStudy(const fs::path& out, const PhantomOptions& options, Progress& progress)
{
    const std::vector<std::string> positions = positionsOf(options);
    if (positions.empty())
        throw Error(ErrorCode::wrong_use, "neither a supine nor a prone nor a decubitus scan is asked for", {},
                    "ask for at least one");
    prepareFolder(out);
    const StudyHeader study = headerFor(options);
    int number = 1;
    for (const std::string& position : positions) {
        PartProgress part(progress, (number - 1.0) / double(positions.size()), 1.0 / double(positions.size()));
        const PhantomScan scan = makeScan(options, position, part);
        const std::string name = nameOfPosition(position);
        if (options.extras && number == 1 && options.mr == MrLumen::none)
            writeLocalizer(out / "series-1-localizer", study,
                           {1, uidFor(study.key, "localizer"), "Localizer", position}, scan.hu);
        ++number;
        char thickness[16];
        std::snprintf(thickness, sizeof thickness, "%.1f", scan.hu.grid.spacing_mm[2]);
        const bool mr = options.mr != MrLumen::none;
        const SeriesHeader series{
            number, uidFor(study.key, name),
            mr ? "MRC " + name + " " + thickness + " mm, " + nameIn(kMrLumenNames, options.mr) + " lumen"
               : "CTC " + name + " " + thickness + " mm soft",
            position, mr ? "MR" : "CT"};
        writeSeries(out / ("series-" + std::to_string(number) + "-" + name), study, series, scan.hu, part);
        scan_files::writeVolume(out / ("truth-" + name + "-inside.mha"), scan.truth.inside, scan_files::Packing::zlib);
        nlohmann::json truth = describeTruth(scan.truth);
        truth["scan"] = series.uid;
        truth["study"] = study.study_uid;
        truth["position"] = position;
        truth["options"] = toJson(options);
        replaceFile(out / ("truth-" + name + ".json"), truth.dump() + "\n");
    }
    if (options.extras && options.mr == MrLumen::none)
        writeDoseSheet(out / "series-999-dose", study, {999, uidFor(study.key, "dose"), "Dose report", ""});
    progress.report(1, "study");
}

}  // namespace vicon::phantom
