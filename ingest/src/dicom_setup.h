#pragma once

namespace vicon::ingest {

/// Registers DCMTK's decoders and silences its log, once per process. Call before any use of DCMTK.
void setUpDicom();

}  // namespace vicon::ingest
