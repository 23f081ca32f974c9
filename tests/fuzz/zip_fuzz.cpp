// Whatever a zip file holds, what comes out of it lies in the folder for it, within the limits.
#include "input_files.h"
#include "memory_file.h"
#include "vicon/core/progress.h"

namespace fs = std::filesystem;
using namespace vicon;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    static const fs::path incoming = fs::temp_directory_path() / ("vicon-fuzz-zip-" + std::to_string(::getpid()));
    file.fill(data, size);
    NoProgress quiet;
    ingest::ImportOptions options;
    options.archive_max_files = 20;
    options.archive_max_gb = 0.001;
    std::vector<ingest::ImportLine> lines;
    {
        ingest::UnpackFolder folder(incoming);
        const auto files = ingest::unpackZip({file.path(), "study.zip", false}, folder, options, quiet, lines);
        fuzz::require(files.size() <= std::size_t(options.archive_max_files));
        std::uintmax_t bytes = 0;
        for (const ingest::InputFile& one : files) {
            fuzz::require(one.path.parent_path().parent_path() == incoming);
            bytes += fs::file_size(one.path);
        }
        fuzz::require(bytes <= 1'000'000);
    }
    fs::remove_all(incoming);
    for (const ingest::ImportLine& line : lines)
        fuzz::require(!line.text.empty());
    return 0;
}
