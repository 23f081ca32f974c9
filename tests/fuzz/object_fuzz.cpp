// File to data set: whatever a file holds, it is an image that can be described and decoded, or has a reason in words.
#include <nlohmann/json.hpp>

#include "inspect.h"
#include "memory_file.h"
#include "pixels.h"
#include "vicon/core/error.h"
#include "vicon/core/volume.h"

using namespace vicon;
using ingest::Inspection;

namespace {

constexpr int kLargestMatrix = 256;  // larger ones only take longer

void decode(const ingest::ImageObject& object)
{
    try {
        ingest::FrameDecoder decoder(object);
        for (const ingest::Slice& slice : object.slices) {
            const auto densities = decoder.densities(slice);
            fuzz::require(densities.size() == std::size_t(object.pixels.rows) * std::size_t(object.pixels.columns));
            for (const std::int16_t density : densities)
                fuzz::require(density >= -1500 || density == kPaddingHu);
        }
    } catch (const Error& e) {
        fuzz::require(e.code() == ErrorCode::bad_input);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    file.fill(data, size);
    ingest::ImportOptions options;
    options.largest_matrix = kLargestMatrix;
    const Inspection found = ingest::inspectFile(file.path(), options);
    const ingest::ImageObject& object = found.object;
    // Throws where a text is no UTF-8.
    (void)nlohmann::json({found.reason, object.sop_uid, object.series.uid, object.series.description}).dump();
    const bool without_words = found.verdict == Inspection::Verdict::image ||
                               found.verdict == Inspection::Verdict::directory ||
                               found.verdict == Inspection::Verdict::archive;
    fuzz::require(without_words == found.reason.empty());
    if (found.verdict != Inspection::Verdict::image)
        return 0;
    fuzz::require(!object.sop_uid.empty() && !object.series.uid.empty() && !object.study.uid.empty());
    fuzz::require(object.pixels.rows <= kLargestMatrix && object.pixels.columns <= kLargestMatrix);
    (void)nlohmann::json({object.patient.id, object.patient.name, object.study.description}).dump();
    decode(object);
    return 0;
}
