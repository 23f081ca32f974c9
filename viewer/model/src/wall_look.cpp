#include "vicon/viewer/model/wall_look.h"

#include <array>

#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {
constexpr std::array<const char*, 3> kColorNames{"mucosa", "bone", "depth"};
}  // namespace

std::string nameOf(WallColors colors)
{
    return kColorNames[std::size_t(colors)];
}

WallColors wallColorsFrom(const std::string& name)
{
    for (std::size_t n = 0; n < kColorNames.size(); ++n)
        if (name == kColorNames[n])
            return WallColors(n);
    throw Error(ErrorCode::wrong_use, "a look must be mucosa, bone or depth", "'" + name + "'");
}

}  // namespace vicon::viewer
