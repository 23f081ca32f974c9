// What a peer answers by DICOMweb: bodies in parts, however they come, and lists of matches.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "multipart.h"
#include "vicon/core/error.h"
#include "web_json.h"

using namespace vicon;

namespace {

void readParts(std::string_view body, std::size_t at_a_time)
{
    std::size_t bytes = 0, open = 0;
    ingest::MultipartReader reader(
        "b", {[&] { ++open; }, [&](std::string_view more) { bytes += more.size(); }, [&] { --open; }});
    try {
        for (std::size_t from = 0; from < body.size(); from += at_a_time)
            reader.feed(body.substr(from, at_a_time));
    } catch (const Error&) {
    }
    if (bytes > body.size() || open > 1 || (reader.complete() && open > 0))
        std::abort();
}

void readMatches(std::string_view text)
{
    const nlohmann::json list = nlohmann::json::parse(text, nullptr, false);
    if (!list.is_array())
        return;
    for (const nlohmann::json& match : list) {
        const ingest::WebItem item(match);
        for (const char* tag : {"0020000D", "00100010"}) {
            item.text(tag);
            item.personName(tag);
            item.count(tag);
            for (const ingest::WebItem& inner : item.items(tag))
                inner.text(tag);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size < 2)
        return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    readParts(bytes, 1 + data[0] % 64U);
    ingest::boundaryOf(std::string(bytes));
    readMatches(bytes);
    return 0;
}
