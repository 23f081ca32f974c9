#pragma once

#include <future>

#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/scene/reading_pictures.h"

namespace vicon::viewer {

/// What the reading room draws beside the endoscopic view: three slices on a thread of their own, and the overview.
class OtherViews {
public:
    explicit OtherViews(const PreparedScan& scan) : scan_(scan), pictures_(scan) {}

    void begin(const ViewPose& view)
    {
        slices_ = std::async(std::launch::async, [this, view] {
            for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::coronal, SlicePlane::sagittal}) {
                SliceRequest request;
                request.plane = plane;
                request.point_mm = view.pose.eye_mm;
                request.pose = view.pose;
                request.view = sliceThrough(scan_.volume().grid, plane, request.point_mm, kSide, kSide);
                slicePicture(scan_.volume(), request);
            }
        });
    }

    /// Draws the overview, and waits for the slices.
    void end(const ViewPose& view)
    {
        SnapshotRequest request;
        request.width = kSide;
        request.height = kSide;
        pictures_.overview(request, {view.pose, view.station_mm, view.clearance_mm, true});
        slices_.get();
    }

private:
    static constexpr int kSide = 384;  ///< as in a window of 1920 x 1200
    const PreparedScan& scan_;
    ReadingPictures pictures_;
    std::future<void> slices_;
};

}  // namespace vicon::viewer
