#pragma once

#include <string>

namespace vicon::viewer {

class Display;

/// What draws on a display, as its driver calls it: "llvmpipe (LLVM 15.0.6, 256 bits)", "NVIDIA RTX A2000/PCIe/SSE2".
/// Throws Error{no_display} where it cannot be made to draw.
std::string openGlRenderer(const Display& display);

/// Whether that is the processor, and no graphics card.
bool drawsInSoftware(const std::string& renderer);

}  // namespace vicon::viewer
