#include "job_owner.h"

#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <string>

#include "vicon/cases/job_queue.h"

namespace vicon {
namespace {

/// When the process started, in the kernel's ticks since boot, so that a pid used again is not taken for the old
/// process; empty when there is no such process. Field 22 of /proc/PID/stat, see proc(5).
std::string startOf(const std::string& pid)
{
    std::ifstream stat("/proc/" + pid + "/stat");
    std::string line;
    if (!std::getline(stat, line) || line.rfind(')') == std::string::npos)
        return {};
    std::istringstream fields(line.substr(line.rfind(')') + 2));
    std::string field;
    for (int n = 3; n <= 22 && fields >> field; ++n)
        if (n == 3 && field == "Z")
            return {};  // dead, only not yet reaped by its parent
    return field;
}

std::string thisMachine()
{
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    std::ifstream boot("/proc/sys/kernel/random/boot_id");
    std::string boot_id;
    std::getline(boot, boot_id);
    return std::string(host.data()) + "/" + boot_id.substr(0, 8);
}

}  // namespace

std::string thisOwner()
{
    const std::string pid = std::to_string(::getpid());
    return thisMachine() + "/" + pid + "/" + startOf(pid);
}

std::string machineOf(const std::string& owner)
{
    return owner.substr(0, owner.rfind('/', owner.rfind('/') - 1));
}

bool ownerIsGone(const std::string& owner)
{
    const std::string machine = thisMachine() + "/";
    if (!owner.starts_with(machine))
        return false;
    const std::string rest = owner.substr(machine.size());
    const auto slash = rest.find('/');
    return slash == std::string::npos || startOf(rest.substr(0, slash)) != rest.substr(slash + 1);
}

}  // namespace vicon
