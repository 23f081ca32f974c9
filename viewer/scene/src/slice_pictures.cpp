#include "vicon/viewer/scene/slice_pictures.h"

#include <cmath>

namespace vicon::viewer {

Picture SlicePictures::draw(const std::shared_ptr<const PreparedScan>& scan, const SliceRequest& request,
                            const Progress* wanted)
{
    if (scan_.lock() != scan) {
        plane_.reset();
        slab_.reset();
    }
    scan_ = scan;
    earlier_plane_ = plane_;
    plane_ = SliceSlab::planeOf(scan->volume().grid, request.view);
    const bool thin = request.thick.kind == ThickSlice::Kind::one_plane;
    const bool held = thin && plane_ && slab_ && slab_->holds(*plane_);
    const InsideView inside = request.tracks ? scan->inside() : InsideView();
    return slicePicture(held ? HuView(slab_->volume()) : scan->volume(), request, scan->cleansed(), &inside, wanted);
}

void SlicePictures::readAhead(const Progress* wanted)
{
    const auto scan = scan_.lock();
    constexpr double kNear = SliceSlab::kPlanes / 2.0;  // a slab around the one holds the other
    const bool scrolled = plane_ && earlier_plane_ && std::abs(*plane_ - *earlier_plane_) < kNear;
    if (scan && scrolled && !(slab_ && slab_->holds(*plane_)))
        slab_.emplace(scan->volume(), *plane_, wanted);
}

}  // namespace vicon::viewer
