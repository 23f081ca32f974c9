#pragma once

#include "session/drawing_thread.h"
#include "slices/measured_line.h"

namespace vicon::viewer {

// The line that is measured, over a picture from inside. Nothing where it lies in another scan than `scan`, the picture
// shows another one, or the wall hides both ends.

std::optional<Calliper> lineFromInside(const std::optional<MeasuredLine>& line, const std::shared_ptr<OpenScan>& scan,
                                       const ShownPicture& shown);
/// @param shown its lens: as wide and high as the cube
std::optional<Calliper> lineOnCube(const std::optional<MeasuredLine>& line, const std::shared_ptr<OpenScan>& scan,
                                   const ShownPicture& shown);

}  // namespace vicon::viewer
