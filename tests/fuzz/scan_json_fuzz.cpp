// Whatever stands in a scan's JSON files - scan.json, subdivision.json, the corrections, the bridges' reviews - it is
// read as what it means, or refused by an Error.
#include <cstdlib>
#include <fstream>

#include "memory_file.h"
#include "vicon/cases/bridges.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/core/json_text.h"
#include "vicon/scan_files/description_file.h"
#include "vicon/scan_files/subdivision_file.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

template <class Read>
void tryTo(Read read)
{
    try {
        read();
    } catch (const Error&) {
    }
}

void readSteps(const nlohmann::json& scan)
{
    for (const char* step : {"resample", "segment", "tissue", "skeleton", "quality", "subdivide", "potential"})
        tryTo([&] {
            StepRecord record;
            record.step = step;
            record.result = scan.contains("steps") && scan["steps"].is_object() && scan["steps"].contains(step)
                                ? scan["steps"][step]
                                : scan;
            const StepResults results = resultsOf({record});
            (void)results.warning();
            (void)results.organ();
        });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    static const fs::path folder = [] {
        const fs::path made = fs::temp_directory_path() / ("vicon-fuzz-scan-" + std::to_string(::getpid()));
        fs::create_directories(made);
        return made;
    }();
    file.fill(data, size);
    tryTo([&] { (void)scan_files::readSubdivision(file.path()); });
    std::ofstream(folder / "corrections.json").write(reinterpret_cast<const char*>(data), std::streamsize(size));
    tryTo([&] { (void)readCorrections(folder); });
    std::ofstream(folder / "scan.json").write(reinterpret_cast<const char*>(data), std::streamsize(size));
    tryTo([&] {
        const scan_files::ScanDescription read = scan_files::readDescription(folder);
        scan_files::writeDescription(folder, read);
        if (!scan_files::isDescribedBy(folder, read))
            std::abort();
    });
    const nlohmann::json scan = parsedJson({reinterpret_cast<const char*>(data), size});
    if (!scan.is_object())
        return 0;
    readSteps(scan);
    return 0;
}
