// Whatever a DICOMDIR names, only files below its folder are listed.
#include <nlohmann/json.hpp>

#include <fstream>

#include "input_files.h"
#include "memory_file.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

/// A folder with a file that the seeds name, and one beside it that nothing may reach.
struct Disc {
    fs::path outside = fs::temp_directory_path() / ("vicon-fuzz-disc-" + std::to_string(::getpid()));
    fs::path folder = outside / "disc";
    Disc()
    {
        fs::create_directories(folder / "IMAGES");
        std::ofstream(folder / "IMAGES" / "IM1") << "an image";
        std::ofstream(outside / "IM1") << "outside";
    }
    ~Disc() { fs::remove_all(outside); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Disc disc;
    const fs::path dicomdir = disc.folder / "DICOMDIR";
    std::ofstream(dicomdir, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
    std::vector<ingest::ImportLine> lines;
    for (const ingest::InputFile& file : ingest::listFiles({dicomdir}, lines))
        fuzz::require(fs::canonical(file.path).string().starts_with(disc.folder.string() + "/"));
    for (const ingest::ImportLine& line : lines)
        (void)nlohmann::json({line.subject, line.text}).dump();
    return 0;
}
