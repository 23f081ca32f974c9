#include "this_person.h"

#include <pwd.h>
#include <unistd.h>

namespace vicon {

std::string thisPerson()
{
    const passwd* entry = getpwuid(getuid());
    return entry ? entry->pw_name : std::to_string(getuid());
}

}  // namespace vicon
