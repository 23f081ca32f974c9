#include "published_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::pipeline {
namespace {

void require(bool done, const fs::path& place)
{
    if (!done)
        throw Error(ErrorCode::store, std::string("cannot be put in its place (") + std::strerror(errno) + ")",
                    place.string(), "check that the folder exists and is yours");
}

void flushFolder(const fs::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool flushed = descriptor >= 0 && ::fsync(descriptor) == 0;
    if (descriptor >= 0)
        ::close(descriptor);
    require(flushed, folder);
}

}  // namespace

void publishFile(const fs::path& made, const fs::path& place)
{
    const fs::path temporary =
        place.parent_path() / (std::string(kTemporaryPrefix) + "link-" + place.filename().string());
    ::unlink(temporary.c_str());
    require(::link(made.c_str(), temporary.c_str()) == 0, place);
    require(::rename(temporary.c_str(), place.c_str()) == 0, place);
    flushFolder(place.parent_path());
}

}  // namespace vicon::pipeline
