// Whatever a scan's lumen.json holds: the mask that it names lies in the scan's folder, and its origin can be written,
// read again and shown.
#include "json_folder.h"
#include "vicon/cases/given_lumen.h"
#include "vicon/core/error.h"

using namespace vicon;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::JsonFolder file("lumen.json");
    const std::filesystem::path& folder = file.fill(data, size);
    try {
        const auto given = readGivenLumen(folder);
        fuzz::require(given.has_value());
        fuzz::require(given->mask_file.parent_path() == folder &&
                      given->mask_file.lexically_normal() == given->mask_file);
        const std::string said = toJson(given->origin).dump();
        fuzz::require(toJson(lumenOriginFromJson(nlohmann::json::parse(said))).dump() == said);
        fuzz::require(!textOf(given->origin).empty());
    } catch (const Error&) {
    }
    return 0;
}
