#include "vicon/cases/records.h"

#include "vicon/core/error.h"

namespace vicon {

std::string positionName(const std::string& position)
{
    if (position.ends_with("DL"))
        return "left decubitus";
    if (position.ends_with("DR"))
        return "right decubitus";
    if (position == "HFS" || position == "FFS")
        return "supine";
    if (position == "HFP" || position == "FFP")
        return "prone";
    return "unknown";
}

Vector3 gravityFor(const std::string& position)
{
    const std::string name = positionName(position);
    if (name == "prone")
        return {0, -1, 0};
    if (name == "left decubitus")  // lying on the left side
        return {1, 0, 0};
    if (name == "right decubitus")
        return {-1, 0, 0};
    return {0, 1, 0};
}

std::string nameOf(ScanRole role)
{
    switch (role) {
        case ScanRole::scan:
            return "scan";
        case ScanRole::kept:
            return "kept";
        case ScanRole::refused:
            return "refused";
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
