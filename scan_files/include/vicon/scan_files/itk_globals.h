#pragma once

namespace vicon::scan_files {

/// ITK makes its globals when they are first asked for, into a list that two threads must not write to at once, be it
/// for different ones. Makes those that VICON uses; before the first thread that uses ITK. Again: nothing.
void makeItkGlobals();

}  // namespace vicon::scan_files
