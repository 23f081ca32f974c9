#include "vicon/viewer/scene/picture_coverage.h"

#include <algorithm>

#include "seen_tint.h"
#include "vicon/viewer/scene/id_scene.h"
#include "vicon/viewer/scene/offscreen.h"

namespace vicon::viewer {

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

void PictureCoverage::tint(Picture& picture, const std::vector<std::uint8_t>& which, Tint as) const
{
    const Picture& ids = parts_->picture;
    for (std::size_t n = 0; n < std::min(picture.rgb.size(), ids.rgb.size()); n += 3) {
        const auto* p = ids.rgb.data() + n;
        const std::uint32_t id = p[0] | std::uint32_t(p[1]) << 8 | std::uint32_t(p[2]) << 16;
        if (id == 0 || id > which.size() || !which[id - 1])
            continue;
        auto* color = picture.rgb.data() + n;
        const Rgb own{color[0], color[1], color[2]};
        const Rgb tinted = as == Tint::seen ? seenTint(own) : missedTint(own);
        color[0] = tinted.red;
        color[1] = tinted.green;
        color[2] = tinted.blue;
    }
}

}  // namespace vicon::viewer
