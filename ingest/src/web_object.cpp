#include "web_object.h"

#include <optional>

#include "association.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr const char* kAsTheyAre = "multipart/related; type=\"application/dicom\"; transfer-syntax=*";

[[noreturn]] void failed(const std::string& what, const WebClient& client, int count)
{
    throw Error(ErrorCode::peer, what + " after " + std::to_string(count) + " objects", nameOf(client.peer()),
                "try again");
}

}  // namespace

FetchedObjects fetchObjects(WebClient& client, const std::string& path, const MultipartReader::Parts& parts)
{
    FetchedObjects fetched;
    std::optional<MultipartReader> reader;
    const MultipartReader::Parts counted{parts.begin, parts.bytes, [&] {
                                             parts.end();
                                             ++fetched.count;
                                         }};
    const auto take = [&](const std::string& content_type, std::string_view bytes) {
        if (!reader) {
            const std::string boundary = boundaryOf(content_type);
            if (boundary.empty())
                failed("the peer's answer is no multipart/related, but '" + content_type + "',", client, 0);
            reader.emplace(boundary, counted);
        }
        reader->feed(bytes);
    };
    try {
        fetched.answer = client.get(path, kAsTheyAre, take);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::bad_input)
            failed(std::string("the peer's answer cannot be read (") + e.what() + ")", client, fetched.count);
        throw;
    }
    if (fetched.answer.good() && reader && !reader->complete())
        failed("the transfer broke off", client, fetched.count);
    return fetched;
}

}  // namespace vicon::ingest
