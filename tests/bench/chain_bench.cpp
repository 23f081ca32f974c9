// From the DICOM files of a synthetic scan to the last result, `vicon import` and `vicon work`, against the chain of
// stock filters: in turn, several times, each in processes of its own. Prints a table for
// docs/evaluation/time-and-memory.md.
//
// vicon_chain_bench VICON [--size COLUMNSxROWSxSLICES]... [--repeats N] [--folder DIR]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "child_process.h"
#include "stock_chain.h"
#include "vicon/core/progress.h"
#include "vicon/phantom/phantom.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

/// The studies are as wide as a patient; more slices than the default make them longer, not finer.
constexpr double kField_mm = 379, kHeight_mm = 430;

std::string contentOf(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

fs::path seriesOf(const std::array<int, 3>& size, const fs::path& folder)
{
    const fs::path study =
        folder / (std::to_string(size[0]) + "x" + std::to_string(size[1]) + "x" + std::to_string(size[2]));
    if (!fs::exists(study)) {
        NoProgress quiet;
        phantom::PhantomOptions options;
        options.seed = 1;
        options.size = size;
        options.spacing_mm[2] = std::max(kHeight_mm / size[2], kField_mm / size[0]);
        options.prone = false;
        options.extras = false;
        options.gaps = 0;
        options.folds = size[0] > 300;
        phantom::writeStudy(study, options, quiet);
    }
    for (const auto& entry : fs::directory_iterator(study))
        if (entry.is_directory())
            return entry.path();
    return {};
}

/// Bytes that a copy moves in a second (read and written), with all that this machine has.
double bytesPerSecond()
{
    std::vector<char> from(256 << 20, 1), to(256 << 20, 2);
    double best = 0;
    for (int n = 0; n < 5; ++n) {
        const auto start = std::chrono::steady_clock::now();
        std::memcpy(to.data(), from.data(), from.size());
        const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        best = std::max(best, 2.0 * double(from.size()) / s);
    }
    return best + to[12345] * 1e-9;
}

struct StepUse {
    double wall_s = 0, cpu_s = 0, peak_mb = 0;
};

struct OwnRun {
    bench::Usage import, work;
    std::map<std::string, StepUse> steps;
    std::map<std::string, double> megabytes;  ///< of files, as they are in memory
};

const std::vector<std::string> kSteps = {"resample", "segment",   "tissue",   "skeleton",
                                         "quality",  "subdivide", "potential"};

/// Steps follow each other, and the process ends with the last: so what it used between two moments is a step's.
void shareOut(OwnRun& run)
{
    double end = run.work.wall_s;
    for (auto step = kSteps.rbegin(); step != kSteps.rend(); ++step) {
        StepUse& use = run.steps[*step];
        const double begin = end - use.wall_s;
        double before_s = 0, after_s = 0;
        for (const bench::Sample& sample : run.work.samples) {
            if (sample.at_s <= begin)
                before_s = sample.cpu_s;
            if (sample.at_s <= end)
                after_s = sample.cpu_s;
            if (sample.at_s >= begin && sample.at_s <= end)
                use.peak_mb = std::max(use.peak_mb, sample.resident_mb);
        }
        use.cpu_s = after_s - before_s;
        end = begin;
    }
}

/// Import and work in a fresh store, with further options of `vicon work`.
void prepare(OwnRun& run, const std::string& vicon, const fs::path& series, const fs::path& folder,
             const std::vector<std::string>& options)
{
    const std::string store = (folder / "store").string(), out = (folder / "output.txt").string();
    fs::remove_all(store);
    run.import = bench::runToEnd({vicon, "import", series.string(), "--store", store}, out);
    std::vector<std::string> work{vicon, "work", "--until-idle", "--store", store};
    work.insert(work.end(), options.begin(), options.end());
    run.work = bench::runToEnd(work, out);
    if (run.import.exit_code != 0 || run.work.exit_code != 0) {
        std::fprintf(stderr, "vicon failed:\n%s\n", contentOf(out).c_str());
        std::exit(1);
    }
}

/// What each step uses is seen in a run of one step at a time, what the whole uses in a run as users have it.
OwnRun runOwn(const std::string& vicon, const fs::path& series, const fs::path& folder)
{
    const std::string store = (folder / "store").string();
    OwnRun run;
    prepare(run, vicon, series, folder, {"--set", "work.steps_at_once=1"});
    for (const auto& entry : fs::recursive_directory_iterator(store)) {
        if (entry.path().filename() == "scan.json") {
            const auto scan = nlohmann::json::parse(contentOf(entry.path()));
            for (const auto& [step, about] : scan["steps"].items())
                run.steps[step].wall_s = about["seconds"];
        }
        if (entry.is_regular_file()) {
            const bool dicom = entry.path().parent_path().filename() == "dicom";
            run.megabytes[dicom ? "dicom" : entry.path().filename().string()] += double(entry.file_size()) / 1e6;
        }
    }
    shareOut(run);
    prepare(run, vicon, series, folder, {});
    fs::remove_all(store);
    return run;
}

struct StockRun {
    bench::Usage all;
    std::vector<std::pair<std::string, double>> step_s;
};

StockRun runStock(const std::string& self, const fs::path& series, const fs::path& folder)
{
    StockRun run;
    const fs::path out = folder / "output.txt";
    run.all = bench::runToEnd({self, "--stock", series.string()}, out.string());
    std::istringstream lines(contentOf(out));
    std::string step;
    for (double seconds = 0; lines >> step >> seconds;)
        run.step_s.emplace_back(step, seconds);
    if (run.all.exit_code != 0) {
        std::fprintf(stderr, "the stock chain failed:\n%s\n", contentOf(out).c_str());
        std::exit(1);
    }
    return run;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

template <class Runs, class Get>
double medianOf(const Runs& runs, Get get)
{
    std::vector<double> values;
    for (const auto& run : runs)
        values.push_back(get(run));
    return median(values);
}

/// Least megabytes that a step reads and writes: its inputs and outputs, once each.
double leastMegabytes(const std::string& step, std::map<std::string, double> mb, double inside_mb)
{
    const double fields = mb["exit_distance.mha"] + mb["wall_distance.mha"];
    if (step == "import")
        return 2 * mb["dicom"];
    if (step == "resample")
        return mb["dicom"] + mb["volume.mha"];
    if (step == "segment")
        return mb["volume.mha"] + inside_mb;
    if (step == "tissue")  // the densities of the crop and the cleansed ones; labels and fractions
        return 4 * inside_mb + 2 * inside_mb;
    if (step == "skeleton" || step == "quality")
        return inside_mb;
    if (step == "subdivide")  // the densities of the crop; labels; 16-bit segments; the surface
        return 2 * inside_mb + inside_mb + 2 * inside_mb + mb["cells.vtp"];
    return inside_mb + fields;
}

void printTable(const std::string& title, const std::vector<OwnRun>& own, const std::vector<StockRun>& stock)
{
    const double rate = bytesPerSecond();
    // A field holds 4 bytes a voxel of the crop, the labels one.
    auto mb = own.front().megabytes;
    const double inside_mb = mb["wall_distance.mha"] / 4;
    std::printf("\n### %s, median of %zu runs in turn\n\n", title.c_str(), own.size());
    std::printf("| step | wall s | CPU s | peak MB | least MB moved | floor s |\n|---|---|---|---|---|---|\n");
    const auto row = [&](const std::string& step, auto use) {
        const double least = leastMegabytes(step, mb, inside_mb);
        std::printf("| %s | %.2f | %.2f | %.0f | %.0f | %.2f |\n", step.c_str(),
                    medianOf(own, [&](const OwnRun& r) { return use(r).wall_s; }),
                    medianOf(own, [&](const OwnRun& r) { return use(r).cpu_s; }),
                    medianOf(own, [&](const OwnRun& r) { return use(r).peak_mb; }), least, least * 1e6 / rate);
    };
    row("import", [](const OwnRun& r) { return r.import; });
    for (const std::string& step : kSteps)
        row(step, [&](const OwnRun& r) { return r.steps.at(step); });
    std::printf("\n| stock filter | s |\n|---|---|\n");
    for (std::size_t n = 0; n < stock.front().step_s.size(); ++n)
        std::printf("| %s | %.2f |\n", stock.front().step_s[n].first.c_str(),
                    medianOf(stock, [&](const StockRun& r) { return r.step_s[n].second; }));
    const auto both = [](auto get) { return [get](const OwnRun& r) { return get(r.import) + get(r.work); }; };
    const double wall = medianOf(own, both([](const bench::Usage& u) { return u.wall_s; }));
    const double cpu = medianOf(own, both([](const bench::Usage& u) { return u.cpu_s; }));
    const double peak = medianOf(own, [](const OwnRun& r) { return std::max(r.import.peak_mb, r.work.peak_mb); });
    const double stock_wall = medianOf(stock, [](const StockRun& r) { return r.all.wall_s; });
    const double stock_cpu = medianOf(stock, [](const StockRun& r) { return r.all.cpu_s; });
    const double stock_peak = medianOf(stock, [](const StockRun& r) { return r.all.peak_mb; });
    std::vector<double> ratios;
    for (std::size_t n = 0; n < own.size(); ++n)
        ratios.push_back((own[n].import.wall_s + own[n].work.wall_s) / stock[n].all.wall_s);
    std::printf("\n| whole | vicon | stock chain | ratio |\n|---|---|---|---|\n");
    std::printf("| wall s | %.1f | %.1f | %.2f |\n", wall, stock_wall, median(ratios));
    std::printf("| CPU s | %.1f | %.1f | %.2f |\n", cpu, stock_cpu, cpu / stock_cpu);
    std::printf("| peak MB | %.0f | %.0f | %.2f |\n", peak, stock_peak, peak / stock_peak);
    std::printf("\nA copy moved %.1f GB/s in this run; volume.mha holds %.0f million voxels.\n", rate / 1e9,
                mb["volume.mha"] / 2);
    std::fflush(stdout);
}

std::array<int, 3> sizeFrom(const std::string& text)
{
    std::array<int, 3> size{};
    if (std::sscanf(text.c_str(), "%dx%dx%d", &size[0], &size[1], &size[2]) != 3) {
        std::fprintf(stderr, "a size is COLUMNSxROWSxSLICES\n");
        std::exit(2);
    }
    return size;
}

}  // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() == 2 && words[0] == "--stock") {
        bench::runStockChain(words[1]);
        return 0;
    }
    if (words.empty() || words.size() % 2 == 0) {
        std::fprintf(stderr, "vicon_chain_bench VICON [--size CxRxS]... [--repeats N] [--folder DIR]\n");
        return 2;
    }
    std::vector<std::string> sizes;
    int repeats = 3;
    fs::path folder = fs::temp_directory_path() / "vicon-chain-bench";
    for (std::size_t n = 1; n + 1 < words.size(); n += 2) {
        if (words[n] == "--size")
            sizes.push_back(words[n + 1]);
        else if (words[n] == "--repeats")
            repeats = std::max(1, std::atoi(words[n + 1].c_str()));
        else if (words[n] == "--folder")
            folder = words[n + 1];
    }
    if (sizes.empty())
        sizes = {"256x256x200", "512x512x430", "512x512x1000"};
    fs::create_directories(folder);
    for (const std::string& size : sizes) {
        const fs::path series = seriesOf(sizeFrom(size), folder);
        std::vector<OwnRun> own;
        std::vector<StockRun> stock;
        for (int n = 0; n < repeats; ++n) {
            own.push_back(runOwn(words[0], series, folder));
            stock.push_back(runStock(fs::canonical("/proc/self/exe").string(), series, folder));
        }
        printTable(size, own, stock);
    }
    return 0;
}
