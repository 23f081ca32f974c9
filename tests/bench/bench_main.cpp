// Runs the benchmarks and prints, for every pair "WHAT/vicon" and "WHAT/stock...", how many times faster VICON was in
// this run.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>

namespace {

class RatioReporter : public benchmark::ConsoleReporter {
public:
    void ReportRuns(const std::vector<Run>& runs) override
    {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs) {
            const std::string name = run.benchmark_name();
            const auto slash = name.find('/');
            if (slash == std::string::npos || run.error_occurred)
                continue;
            const std::string who = name.substr(slash + 1, name.find('/', slash + 1) - slash - 1);
            const double unit = benchmark::GetTimeUnitMultiplier(run.time_unit);
            times_[name.substr(0, slash)][who] = {run.GetAdjustedRealTime() / unit, run.GetAdjustedCPUTime() / unit};
        }
    }

    void Finalize() override
    {
        std::printf("\n%-20s %9s %9s %7s %9s %9s %7s\n", "step", "vicon s", "stock s", "ratio", "vicon cpu",
                    "stock cpu", "ratio");
        for (const auto& [what, times] : times_) {
            const auto own = times.find("vicon");
            if (own == times.end())
                continue;
            if (times.size() == 1)
                std::printf("%-20s %9.3f %9s %7s %9.3f\n", what.c_str(), own->second.real_s, "-", "-",
                            own->second.cpu_s);
            for (const auto& [who, time] : times)
                if (who != "vicon")
                    std::printf("%-20s %9.3f %9.3f %7.1f %9.3f %9.3f %7.1f  %s\n", what.c_str(), own->second.real_s,
                                time.real_s, time.real_s / own->second.real_s, own->second.cpu_s, time.cpu_s,
                                time.cpu_s / own->second.cpu_s, who.c_str());
        }
    }

private:
    /// CPU time is of all threads together; on a busy machine its ratio tells more than that of the time passed.
    struct Times {
        double real_s, cpu_s;
    };
    std::map<std::string, std::map<std::string, Times>> times_;
};

}  // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    RatioReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    return 0;
}
