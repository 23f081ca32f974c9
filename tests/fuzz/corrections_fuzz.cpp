// Whatever a file of corrections holds, what is read of it can be written and read again.
#include "json_folder.h"
#include "vicon/cases/corrections.h"
#include "vicon/core/error.h"

using namespace vicon;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::JsonFolder file("corrections.json");
    const std::filesystem::path& folder = file.fill(data, size);
    try {
        const Corrections corrections = readCorrections(folder);
        writeCorrections(folder, corrections);
        fuzz::require(readCorrections(folder) == corrections);
    } catch (const Error&) {
    }
    return 0;
}
