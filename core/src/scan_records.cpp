#include "vicon/core/scan_records.h"

#include "vicon/core/error.h"

namespace vicon {

std::string nameOf(ScanRole role)
{
    switch (role) {
        case ScanRole::scan:
            return "scan";
        case ScanRole::kept:
            return "kept";
        case ScanRole::refused:
            break;
    }
    return "refused";
}

ScanRole scanRoleFrom(const std::string& name)
{
    for (const ScanRole role : {ScanRole::scan, ScanRole::kept, ScanRole::refused})
        if (nameOf(role) == name)
            return role;
    throw Error(ErrorCode::bad_input, "a scan has no such role", "'" + name + "'");
}

}  // namespace vicon
