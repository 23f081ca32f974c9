// The thesis' Table 3 for prepared scans: how much of the surface is drawn on a flight, how much of that is seen, and
// what a frame takes with culling and without, in one run.
//   vicon_visibility_bench [--step MM] [--side PX] [--angle DEG] [--flights N] FOLDER...
// FOLDER is a scan's folder, or a store's: then every prepared scan in it. Each way of drawing flies N times, in turn
// with the others, so that a machine whose speed changes does so for all of them; medians are over all frames.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "other_views.h"
#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/display.h"
#include "vicon/viewer/scene/id_scene.h"
#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/sight_ahead.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::viewer;

namespace {

struct Settings {
    double step_mm = 10;
    int side = 768;
    double angle_deg = 90;
    int flights = 3;
    std::vector<fs::path> folders;
};

double secondsOf(const std::function<void()>& work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// CPU time of all threads together: on a busy machine its ratios tell more than those of the time passed.
double cpuSeconds()
{
    timespec t{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double quantile(std::vector<double> values, double part)
{
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    return values[std::size_t(part * double(values.size() - 1))];
}

/// Sums over the frames of a flight.
struct Flight {
    std::size_t frames = 0, missing = 0;
    double cells = 0, triangles = 0;  // drawn
    double seen_cells = 0, seen_cells_triangles = 0, seen = 0;
    std::vector<double> culled_s, all_s, choice_s, culled_cpu_s, all_cpu_s;
    std::vector<double> perfect_s;                    // drawing nothing but the triangles that are seen
    std::vector<double> views_culled_s, views_all_s;  // slices and overview with it
    std::vector<double> even_cpu_s,
        occluded_cpu_s;  // drawing the chosen part alone, without ambient occlusion and with
};

std::vector<ViewPose> posesOf(const PreparedScan& scan, double step_mm)
{
    const Lumen lumen = scan.lumen();
    auto poses = planFlight(scan.frames(), lumen, step_mm, Heading::caecum);
    const auto back = planFlight(scan.frames(), lumen, step_mm, Heading::rectum);
    poses.insert(poses.end(), back.begin(), back.end());
    return poses;
}

CellSurface onlyThese(const CellSurface& surface, const std::vector<std::uint32_t>& triangles)
{
    CellSurface some;
    some.points_mm = surface.points_mm;
    some.normals = surface.normals;
    for (const std::uint32_t t : triangles) {
        some.segment.push_back(surface.segment[t]);
        for (std::size_t n = 0; n < 3; ++n)
            some.triangles.push_back(surface.triangles[3 * std::size_t(t) + n]);
    }
    return some;
}

// The floor of every choice: what is left to do when each triangle drawn is seen. The first picture fills the driver's
// buffers.
double secondsToDraw(const CellSurface& surface, const Pose& pose, const Settings& settings)
{
    SurfaceScene scene(surface);
    Offscreen picture(scene.renderer());
    scene.lookFrom(pose, settings.angle_deg);
    picture.draw(settings.side, settings.side);
    picture.draw(settings.side, settings.side);
    return picture.seconds();
}

double cpuSecondsToDraw(SurfaceScene& scene, Offscreen& picture, const Pose& pose, const VisibleParts& shown,
                        const Settings& settings)
{
    scene.lookFrom(pose, settings.angle_deg);
    scene.showSeen(shown);
    const double begin = cpuSeconds();
    picture.draw(settings.side, settings.side);
    return cpuSeconds() - begin;
}

std::vector<std::size_t> trianglesOfCells(const CellSurface& surface)
{
    std::vector<std::size_t> count(65536, 0);
    for (const std::uint16_t s : surface.segment)
        ++count[s];
    return count;
}

/// The scenes of a scan, and the poses at which each way of drawing is measured.
class Measured {
public:
    Measured(const PreparedScan& scan, const Settings& settings)
        : settings_(settings),
          surface_(scan.cells()),
          triangles_of_(trianglesOfCells(surface_)),
          poses_(posesOf(scan, settings.step_mm)),
          visibility_(scan),
          others_(scan)
    {
        occluded_.shadeByOpenness(surface_, scan.openness());
        scene_.lookFrom(poses_[0].pose, settings_.angle_deg);
        scene_.showSeen(ahead_.visibleFrom(poses_[0].pose, lens_));
        scene_.sendAll();  // as the reading room does before one flies
        picture_.draw(settings_.side, settings_.side);
        for (const ViewPose& view : poses_)
            chosen_.push_back(visibility_.visibleFrom(view.pose, lens_));
    }

    /// Each way of drawing flies the whole flight, frame after frame, as a reader does.
    Flight flyThrough()
    {
        for (int n = 0; n < settings_.flights; ++n) {
            flyChosen();
            flyAll();
            flyWithOthers(true);
            flyWithOthers(false);
        }
        for (std::size_t n = 0; n < poses_.size(); ++n)
            measureFrame(n);
        return std::move(flight_);
    }

private:
    void prepareAfter(std::size_t n) { ahead_.prepare(poses_[(n + 1) % poses_.size()].pose, lens_); }

    void flyChosen()
    {
        ahead_.prepare(poses_[0].pose, lens_);
        for (std::size_t n = 0; n < poses_.size(); ++n) {
            const VisibleParts shown = ahead_.visibleFrom(poses_[n].pose, lens_);
            const double cpu_begin = cpuSeconds();
            // A frame is over when it is drawn and the next one's parts are chosen.
            const double s = secondsOf([&] {
                prepareAfter(n);
                scene_.lookFrom(poses_[n].pose, settings_.angle_deg);
                scene_.showSeen(shown);
                picture_.draw(settings_.side, settings_.side);
                ahead_.wait();
            });
            flight_.culled_s.push_back(s);
            flight_.culled_cpu_s.push_back(cpuSeconds() - cpu_begin);
        }
    }

    void flyAll()
    {
        scene_.showOnly({});
        for (const ViewPose& view : poses_) {
            const double cpu_begin = cpuSeconds();
            const double s = secondsOf([&] {
                scene_.lookFrom(view.pose, settings_.angle_deg);
                picture_.draw(settings_.side, settings_.side);
            });
            flight_.all_s.push_back(s);
            flight_.all_cpu_s.push_back(cpuSeconds() - cpu_begin);
        }
    }

    double drawWithOthers(std::size_t n, bool choose)
    {
        return secondsOf([&] {
            others_.begin(poses_[n]);
            if (choose)
                prepareAfter(n);
            scene_.lookFrom(poses_[n].pose, settings_.angle_deg);
            if (choose)
                scene_.showSeen(chosen_[n]);
            picture_.draw(settings_.side, settings_.side);
            others_.end(poses_[n]);
            ahead_.wait();
        });
    }

    void flyWithOthers(bool choose)
    {
        if (!choose)
            scene_.showOnly({});
        for (std::size_t n = 0; n < poses_.size(); ++n)
            (choose ? flight_.views_culled_s : flight_.views_all_s).push_back(drawWithOthers(n, choose));
    }

    /// What a frame draws and what of it is seen, and what its parts take by themselves.
    void measureFrame(std::size_t n)
    {
        const Pose& pose = poses_[n].pose;
        const double choice = secondsOf([&] { visibility_.visibleFrom(pose, lens_); });
        const double even_cpu = cpuSecondsToDraw(scene_, picture_, pose, chosen_[n], settings_);
        flight_.cells += double(scene_.cellsShown());
        flight_.triangles += double(scene_.trianglesShown());
        const double occluded_cpu = cpuSecondsToDraw(occluded_, occluded_picture_, pose, chosen_[n], settings_);
        ids_.lookFrom(pose, settings_.angle_deg);
        const auto seen = IdScene::trianglesIn(id_picture_.render(settings_.side, settings_.side));
        countSeen(seen, chosen_[n]);
        if (flight_.frames++ == 0)
            return;  // the first frame of each scene fills the driver's buffers
        flight_.perfect_s.push_back(secondsToDraw(onlyThese(surface_, seen), pose, settings_));
        flight_.choice_s.push_back(choice);
        flight_.even_cpu_s.push_back(even_cpu);
        flight_.occluded_cpu_s.push_back(occluded_cpu);
    }

    void countSeen(const std::vector<std::uint32_t>& seen, const VisibleParts& shown)
    {
        std::set<int> cells;
        for (const std::uint32_t t : seen)
            cells.insert(surface_.segment[t]);
        for (const int cell : cells) {
            flight_.seen_cells_triangles += double(triangles_of_[std::size_t(cell)]);
            if (!shown.everything &&
                std::find(shown.segments.begin(), shown.segments.end(), cell) == shown.segments.end())
                ++flight_.missing;
        }
        flight_.seen_cells += double(cells.size());
        flight_.seen += double(seen.size());
    }

    const Settings& settings_;
    const CellSurface& surface_;
    std::vector<std::size_t> triangles_of_;
    std::vector<ViewPose> poses_;
    SurfaceScene scene_{surface_}, occluded_{surface_};
    Offscreen picture_{scene_.renderer()}, occluded_picture_{occluded_.renderer()};
    IdScene ids_{surface_};
    Offscreen id_picture_{ids_.renderer()};
    const CellVisibility visibility_;
    Lens lens_{settings_.angle_deg, settings_.side, settings_.side};
    SightAhead ahead_{visibility_};
    OtherViews others_;
    std::vector<VisibleParts> chosen_;
    Flight flight_;
};

void printHead()
{
    std::printf(
        "| scan | triangles / cells | cells a frame | triangles a frame | of all | of those seen | of cells with "
        "anything seen | ms a frame, median / 95 %% | all drawn | ratio | frames a second | all drawn | CPU ms a frame "
        "/ "
        "all drawn | choosing alone, ms |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print(const PreparedScan& scan, const Flight& f)
{
    const double n = double(f.frames), all = double(scan.cells().triangleCount());
    const double culled = quantile(f.culled_s, 0.5), everything = quantile(f.all_s, 0.5);
    std::printf(
        "| %s | %zu / %zu | %.1f (%.3f) | %.0f | %.3f | %.2f | %.2f | %.1f / %.1f | %.1f / %.1f | %.2f | %.1f | "
        "%.1f | %.1f / %.1f | %.1f |\n",
        scan.folder().filename().c_str(), scan.cells().triangleCount(), scan.subdivision().segments.size(), f.cells / n,
        f.cells / n / double(scan.subdivision().segments.size()), f.triangles / n, f.triangles / n / all,
        f.triangles / f.seen, f.triangles / f.seen_cells_triangles, 1e3 * culled, 1e3 * quantile(f.culled_s, 0.95),
        1e3 * everything, 1e3 * quantile(f.all_s, 0.95), culled / everything, 1 / culled, 1 / everything,
        1e3 * quantile(f.culled_cpu_s, 0.5), 1e3 * quantile(f.all_cpu_s, 0.5), 1e3 * quantile(f.choice_s, 0.5));
    std::printf(
        "  %zu frames; seen a frame: %.0f triangles (%.3f of all), %.1f cells (%.3f of all triangles); seen but "
        "not drawn: %zu\n",
        f.frames, f.seen / n, f.seen / n / all, f.seen_cells / n, f.seen_cells_triangles / n / all, f.missing);
    const double perfect = quantile(f.perfect_s, 0.5);
    std::printf("  nothing but what is seen: %.1f / %.1f ms a frame (median / 95 %%), ratio %.2f to everything drawn\n",
                1e3 * perfect, 1e3 * quantile(f.perfect_s, 0.95), perfect / everything);
    const double views = quantile(f.views_culled_s, 0.5), views_all = quantile(f.views_all_s, 0.5);
    std::printf("  all views together: %.1f / %.1f ms a frame (median / 95 %%), all drawn %.1f / %.1f, ratio %.2f\n",
                1e3 * views, 1e3 * quantile(f.views_culled_s, 0.95), 1e3 * views_all,
                1e3 * quantile(f.views_all_s, 0.95), views / views_all);
    std::printf("  drawing alone: %.1f CPU ms a frame (median), with ambient occlusion %.1f\n",
                1e3 * quantile(f.even_cpu_s, 0.5), 1e3 * quantile(f.occluded_cpu_s, 0.5));
}

std::vector<fs::path> scansIn(const fs::path& folder)
{
    if (fs::exists(folder / "cells.vtp"))
        return {folder};
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().filename() == "cells.vtp")
            found.push_back(entry.path().parent_path());
    std::sort(found.begin(), found.end());
    return found;
}

Settings settingsFrom(int argc, char** argv)
{
    Settings settings;
    for (int n = 1; n < argc; ++n) {
        const std::string word = argv[n];
        if (word == "--step" && n + 1 < argc)
            settings.step_mm = std::atof(argv[++n]);
        else if (word == "--side" && n + 1 < argc)
            settings.side = std::atoi(argv[++n]);
        else if (word == "--angle" && n + 1 < argc)
            settings.angle_deg = std::atof(argv[++n]);
        else if (word == "--flights" && n + 1 < argc)
            settings.flights = std::atoi(argv[++n]);
        else
            for (const fs::path& scan : scansIn(word))
                settings.folders.push_back(scan);
    }
    return settings;
}

}  // namespace

int main(int argc, char** argv)
try {
    const Settings settings = settingsFrom(argc, argv);
    const Display display;
    printHead();
    for (const fs::path& folder : settings.folders) {
        const auto scan = PreparedScan::open(folder);
        print(scan, Measured(scan, settings).flyThrough());
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
