// The unfolded cube, drawn face by face.
#include "session/drawing_thread.h"
#include "vicon/viewer/scene/cube_picture.h"

namespace vicon::viewer {

struct DrawingThread::Cube {
    std::shared_ptr<OpenScan> scan;
    EndoscopicRequest request;
    Picture picture;
    std::size_t faces = 0;  // drawn so far
};

void DrawingThread::drawCube(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request)
{
    auto cube = std::make_shared<Cube>();
    cube->scan = std::move(scan);
    cube->request = request;
    cube->picture = Picture(request.snapshot.width, request.snapshot.height);
    {
        const std::lock_guard lock(cube_mutex_);
        cube_wanted_ = std::move(cube);
    }
    drawFaces();
}

// One face, and then what else waits is drawn before the next one.
void DrawingThread::drawFaces()
{
    worker_.post(kCubeWork, [this](AllPictures& all, const Progress& wanted) -> Worker::Work {
        std::shared_ptr<Cube> cube;
        {
            const std::lock_guard lock(cube_mutex_);
            cube = cube_wanted_;
        }
        if (!cube)
            return {};
        drawFace(*cube, all, wanted);
        if (cube->faces < kCubeFaces.size()) {
            drawFaces();
            return {};
        }
        {
            const std::lock_guard lock(cube_mutex_);
            if (cube_wanted_ == cube)
                cube_wanted_.reset();
        }
        return finished(cube);
    });
}

void DrawingThread::drawFace(Cube& cube, AllPictures& all, const Progress& wanted)
{
    const EndoscopicRequest& request = cube.request;
    const SnapshotRequest& snapshot = request.snapshot;
    const CubeFace face = kCubeFaces[cube.faces];
    const EndoscopicLook look{request.paint_seen ? &cube.scan->coverage : nullptr,
                              request.structure,
                              request.lamp_factor,
                              nullptr,
                              true,
                              &wanted};
    const Picture drawn = picturesOf(all, cube.scan)
                              .cubeFace(snapshot, request.place, face, request.still, look,
                                        request.count_seen ? &cube.scan->coverage : nullptr);
    placeFace(cube.picture, {snapshot.width, snapshot.height}, face, drawn);
    ++cube.faces;
}

Worker::Work DrawingThread::finished(const std::shared_ptr<Cube>& cube)
{
    const SnapshotRequest& snapshot = cube->request.snapshot;
    paint(cube->picture, cubeOverlay(cube->scan->files, snapshot, cube->request.place));
    const Lens lens{snapshot.view_angle_deg, snapshot.width, snapshot.height};
    return
        [this, cube, shown = ShownPicture{cube->scan, cube->request.place, lens, {}, false, snapshot.wall.acquired}] {
            if (cube->request.count_seen)
                emit seenChanged();
            emit cubeDrawn(cube->picture, shown);
        };
}

}  // namespace vicon::viewer
