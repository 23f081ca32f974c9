#include "vicon/core/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace fs = std::filesystem;

namespace vicon {

fs::path makeTemporaryFolder(std::string_view begins, ErrorCode code)
{
    std::error_code failure;
    const fs::path place = fs::temp_directory_path(failure);
    std::string name = (place / begins).string() + "XXXXXX";
    if (!failure && ::mkdtemp(name.data()))
        return name;
    const std::string why = failure ? failure.message() : std::strerror(errno);
    throw Error(code, "no temporary folder can be made (" + why + ")", failure ? "TMPDIR" : place.string(),
                "set TMPDIR to a folder that this user may write");
}

}  // namespace vicon
