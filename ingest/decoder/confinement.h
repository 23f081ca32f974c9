#pragma once

#include <cstdint>

namespace vicon::ingest {

/// Takes from this process what a decoder does not need: memory without bounds, new files, the network, other programs.
/// From then on only what was opened before, and what is handed over, can be read. Where the kernel denies it, one that
/// has no filter of system calls too, this process ends with kNotConfined.
void confine();

/// Ends this process when it has computed for so many seconds from now on.
void limitProcessorTime(std::uint32_t seconds);

}  // namespace vicon::ingest
