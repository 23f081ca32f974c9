// Whatever a file of bridges' reviews holds, what is read of it can be written and read again.
#include "bridge_reviews_file.h"
#include "json_folder.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

using namespace vicon;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::JsonFolder file("bridge_reviews.json");
    const std::filesystem::path& folder = file.fill(data, size);
    try {
        writeBridgeReviews(folder, readBridgeReviews(folder));
        const std::string text = readFile(folder / "bridge_reviews.json");
        writeBridgeReviews(folder, readBridgeReviews(folder));
        fuzz::require(readFile(folder / "bridge_reviews.json") == text);
    } catch (const Error&) {
    }
    return 0;
}
