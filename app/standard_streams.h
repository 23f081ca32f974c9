#pragma once

#include <string>

namespace vicon::app {

/// Opens again what was closed of input, output and errors when VICON was started: else the first file that is opened
/// takes the number, and what is printed goes into it. What is printed to a closed output counts as not printed.
void openStandardStreams();

/// Why what was printed did not get out. Empty where it did, or where whoever read it has seen enough and left.
std::string whyNotPrinted();

}  // namespace vicon::app
