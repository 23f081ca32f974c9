#include "point_argument.h"

#include <cmath>
#include <sstream>

#include "vicon/core/error.h"

namespace vicon::app {

Point3 pointFrom(const std::string& text, const char* option)
{
    Point3 p;
    char comma1 = 0, comma2 = 0;
    std::istringstream in(text);
    if (!(in >> p.x >> comma1 >> p.y >> comma2 >> p.z) || comma1 != ',' || comma2 != ',' || !(in >> std::ws).eof() ||
        !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Error(ErrorCode::wrong_use, "'" + text + "' is not a point", option,
                    std::string("write X,Y,Z in LPS mm, as in ") + option + "=12.5,-30,410");
    return p;
}

}  // namespace vicon::app
