// Frames a second of the look below the surface, on a flight through prepared scans.
//   vicon_peeling_bench [--side PX] [--step MM] [--sample MM] [--moving] [--unshaded] [--preset NAME] FOLDER...
// FOLDER is a scan's folder, or a store's: then every prepared scan in it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/model/peeling.h"
#include "vicon/viewer/model/peeling_pace.h"
#include "vicon/viewer/scene/prepared_scan.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::viewer;

namespace {

struct Settings {
    int side = 256;
    double step_mm = 50;
    PeelingOptions peeling;
    bool moving = false;  ///< as while the eye moves: as coarse as ten a second ask for
    std::vector<std::string> presets;
    std::vector<fs::path> folders;
};

double secondsOn(clockid_t clock)
{
    timespec t{};
    ::clock_gettime(clock, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double quantile(std::vector<double> values, double part)
{
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    return values[std::size_t(part * double(values.size() - 1))];
}

void measure(const PreparedScan& scan, const std::string& preset, const Settings& settings)
{
    const Lumen lumen = scan.lumen();
    const DensityBricks& volume = scan.bricks();
    const Lens lens{90, settings.side, settings.side};
    std::vector<double> wall, cpu, coarseness;
    PeelingPace pace;
    for (const ViewPose& view : planFlight(scan.frames(), lumen, settings.step_mm, Heading::caecum)) {
        const double begin = secondsOn(CLOCK_MONOTONIC), cpu_begin = secondsOn(CLOCK_PROCESS_CPUTIME_ID);
        const int coarse = settings.moving ? pace.coarseFor(settings.side, settings.side) : 1;
        const int rays = (settings.side + coarse - 1) / coarse;
        peel(volume, lumen, view.pose, {lens.view_angle_deg, rays, rays}, transferFunction(preset), settings.peeling);
        wall.push_back(secondsOn(CLOCK_MONOTONIC) - begin);
        cpu.push_back(secondsOn(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin);
        coarseness.push_back(coarse);
        pace.tell(settings.side, settings.side, coarse, wall.back());
    }
    std::printf("| %s | %s | %d | %.0f | %zu | %.1f / %.1f | %.1f | %.1f / %.1f |\n", scan.folder().filename().c_str(),
                preset.c_str(), settings.side, quantile(coarseness, 0.5), wall.size(), 1e3 * quantile(wall, 0.5),
                1e3 * quantile(wall, 0.95), 1 / quantile(wall, 0.5), 1e3 * quantile(cpu, 0.5),
                1e3 * quantile(cpu, 0.95));
}

Settings settingsFrom(int argc, char** argv)
{
    Settings settings;
    for (int n = 1; n < argc; ++n) {
        const std::string word = argv[n];
        if (word == "--side" && n + 1 < argc)
            settings.side = std::atoi(argv[++n]);
        else if (word == "--step" && n + 1 < argc)
            settings.step_mm = std::atof(argv[++n]);
        else if (word == "--sample" && n + 1 < argc)
            settings.peeling.step_mm = std::atof(argv[++n]);
        else if (word == "--moving") {
            settings.moving = true;
            settings.peeling = settings.peeling.whileMoving();
        } else if (word == "--unshaded")
            settings.peeling.shaded = false;
        else if (word == "--preset" && n + 1 < argc)
            settings.presets.emplace_back(argv[++n]);
        else if (fs::exists(fs::path(word) / "cells.vtp"))
            settings.folders.emplace_back(word);
        else
            for (const auto& entry : fs::recursive_directory_iterator(word))
                if (entry.path().filename() == "cells.vtp")
                    settings.folders.push_back(entry.path().parent_path());
    }
    std::sort(settings.folders.begin(), settings.folders.end());
    if (settings.presets.empty())
        settings.presets = {"soft-tissue", "tagged-fluid", "fat", "polyp", "biopsy"};
    return settings;
}

}  // namespace

int main(int argc, char** argv)
try {
    const Settings settings = settingsFrom(argc, argv);
    std::printf(
        "| scan | preset | pixels a side | a ray for pixels a side | frames | ms a frame, median / 95 %% | frames a "
        "second | CPU ms, median / "
        "95 %% |\n|---|---|---|---|---|---|---|---|\n");
    for (const fs::path& folder : settings.folders) {
        const auto scan = PreparedScan::open(folder);
        for (const std::string& preset : settings.presets)
            measure(scan, preset, settings);
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
