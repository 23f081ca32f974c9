// Whatever a file holds, the walk over its elements ends, within its memory.
#include "memory_file.h"
#include "structure_scan.h"

using namespace vicon;
using ingest::Structure;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    file.fill(data, size);
    const Structure found = ingest::scanStructure(file.path());
    fuzz::require(found.fate != Structure::Fate::refused || !found.why.empty());
    fuzz::require(found.trailing_bytes <= size);
    return 0;
}
