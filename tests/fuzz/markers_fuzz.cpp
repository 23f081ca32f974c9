// Whatever a file of markers holds, what is read of it can be written and read again.
#include "memory_file.h"
#include "vicon/cases/marker.h"
#include "vicon/core/error.h"

using namespace vicon;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file, again;
    file.fill(data, size);
    try {
        const std::vector<Marker> markers = readMarkers(file.path());
        const std::string text = toJson(markers).dump(2);
        again.fill(text.data(), text.size());
        fuzz::require(toJson(readMarkers(again.path())).dump(2) == text);
    } catch (const Error&) {
    }
    return 0;
}
