// Triangle strips, as the thesis draws the surface, against indexed triangles, in one run.
//   vicon_strips_bench [--step MM] [--side PX] FOLDER...
// FOLDER is a prepared scan's folder. All cells are drawn from along the centreline, both ways in turn, so that a
// machine whose speed changes does so for both; medians over all frames.
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkStripper.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "cell_actors.h"
#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/scene/display.h"
#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/prepared_scan.h"

using namespace vicon;
using namespace vicon::viewer;

namespace {

struct Settings {
    double step_mm = 60;
    int side = 768;
    std::vector<std::string> folders;
};

double cpuSeconds()
{
    timespec t{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// One way of drawing: a picture of all cells.
class Drawing {
public:
    explicit Drawing(const std::vector<vtkSmartPointer<vtkPolyData>>& cells)
    {
        for (const auto& cell : cells) {
            vtkNew<vtkPolyDataMapper> mapper;
            mapper->SetInputData(cell);
            mapper->SetStatic(1);
            vtkNew<vtkActor> actor;
            actor->SetMapper(mapper);
            renderer_->AddActor(actor);
        }
    }
    double cpuSecondsFrom(const Pose& pose, int side)
    {
        placeCamera(renderer_->GetActiveCamera(), pose, 90);
        const double begin = cpuSeconds();
        picture_.draw(side, side);
        return cpuSeconds() - begin;
    }

private:
    vtkNew<vtkRenderer> renderer_;
    Offscreen picture_{renderer_};
};

void measure(const std::string& folder, const Settings& settings)
{
    const auto scan = PreparedScan::open(folder);
    std::vector<vtkSmartPointer<vtkPolyData>> triangles, strips;
    for (const CellActor& cell : cellActors(scan.cells()))
        triangles.push_back(cell.data);
    vtkIdType count = 0, corners = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& cell : triangles) {
        vtkNew<vtkStripper> stripper;
        stripper->SetInputData(cell);
        stripper->SetMaximumLength(100000);
        stripper->PassThroughCellIdsOff();
        stripper->Update();
        strips.push_back(stripper->GetOutput());
        count += strips.back()->GetNumberOfStrips();
        corners += strips.back()->GetStrips()->GetNumberOfConnectivityIds();
    }
    const double stripping_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    Drawing as_triangles(triangles), as_strips(strips);
    std::vector<double> triangles_s, strips_s;
    const auto poses = planFlight(scan.frames(), scan.lumen(), settings.step_mm, Heading::caecum);
    for (std::size_t n = 0; n < poses.size(); ++n) {
        const double a = as_triangles.cpuSecondsFrom(poses[n].pose, settings.side),
                     b = as_strips.cpuSecondsFrom(poses[n].pose, settings.side);
        if (n == 0)
            continue;  // the first frame fills the driver's buffers
        triangles_s.push_back(a);
        strips_s.push_back(b);
    }
    const double all = double(scan.cells().triangleCount());
    std::printf("| %s | %.0f | %lld | %.1f | %.2f | %.1f | %.1f | %.1f | %.2f |\n", scan.folder().filename().c_str(),
                all, static_cast<long long>(count), all / double(count), double(corners) / all, stripping_s,
                1e3 * median(triangles_s), 1e3 * median(strips_s), median(strips_s) / median(triangles_s));
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
        else
            settings.folders.push_back(word);
    }
    return settings;
}

}  // namespace

int main(int argc, char** argv)
try {
    const Settings settings = settingsFrom(argc, argv);
    const Display display;
    std::printf(
        "| scan | triangles | strips | triangles a strip | corners a triangle in strips | stripping, s | CPU ms a "
        "frame "
        "as triangles | as strips | ratio |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& folder : settings.folders)
        measure(folder, settings);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
