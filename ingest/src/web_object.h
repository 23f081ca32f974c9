#pragma once

#include <string>

#include "multipart.h"
#include "web_client.h"

namespace vicon::ingest {

struct FetchedObjects {
    WebClient::Answer answer;
    int count = 0;
};

/// Fetches objects (WADO-RS) as the peer keeps them; each is a part of its answer.
/// @param path of a series or an object
/// @throws Error{peer} when the peer breaks off, or its answer is none; Error{cancelled}, and what `parts` throw
FetchedObjects fetchObjects(WebClient& client, const std::string& path, const MultipartReader::Parts& parts);

}  // namespace vicon::ingest
