#pragma once

namespace vicon {

/// Reads DCMTK's dictionary and silences its log, once per process. Call before any use of DCMTK. No decoder is
/// registered: compressed pixels are decoded in the decoder program alone.
void setUpDicom();

}  // namespace vicon
