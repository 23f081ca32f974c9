#include "vicon/viewer/scene/picture_coverage.h"

#include <algorithm>

#include "vicon/viewer/scene/id_scene.h"
#include "vicon/viewer/scene/offscreen.h"

namespace vicon::viewer {
namespace {

// Green is far from mucosa and from the markers' rings by its darkness; the shading under it stays readable.
constexpr Rgb kSeenTint{70, 190, 110};
constexpr double kTintStrength = 0.55;

std::uint8_t tinted(std::uint8_t brightness, std::uint8_t own, std::uint8_t tint)
{
    const double wanted = double(brightness) * tint / 190;
    return std::uint8_t(std::clamp(own + kTintStrength * (wanted - own), 0.0, 255.0));
}

}  // namespace

struct PictureCoverage::Parts {
    IdScene ids;
    Offscreen offscreen;
    Picture picture;

    explicit Parts(const PreparedScan& scan) : ids(scan.cells()), offscreen(ids.renderer()) {}
};

PictureCoverage::PictureCoverage(const PreparedScan& scan) : parts_(std::make_unique<Parts>(scan)) {}
PictureCoverage::~PictureCoverage() = default;

void PictureCoverage::look(const VisibleParts& shown, const Pose& pose, const Lens& lens)
{
    parts_->ids.showSeen(shown);
    parts_->ids.lookFrom(pose, lens.view_angle_deg);
    parts_->picture = parts_->offscreen.render(lens.width, lens.height);
}

std::vector<std::uint32_t> PictureCoverage::triangles() const
{
    return IdScene::trianglesIn(parts_->picture);
}

void PictureCoverage::tint(Picture& picture, const std::vector<std::uint8_t>& earlier) const
{
    const Picture& ids = parts_->picture;
    for (std::size_t n = 0; n < std::min(picture.rgb.size(), ids.rgb.size()); n += 3) {
        const auto* p = ids.rgb.data() + n;
        const std::uint32_t id = p[0] | std::uint32_t(p[1]) << 8 | std::uint32_t(p[2]) << 16;
        if (id == 0 || id > earlier.size() || !earlier[id - 1])
            continue;
        auto* color = picture.rgb.data() + n;
        const std::uint8_t brightness = std::max({color[0], color[1], color[2]});
        color[0] = tinted(brightness, color[0], kSeenTint.red);
        color[1] = tinted(brightness, color[1], kSeenTint.green);
        color[2] = tinted(brightness, color[2], kSeenTint.blue);
    }
}

}  // namespace vicon::viewer
