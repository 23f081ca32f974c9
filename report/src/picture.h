#pragma once

#include <filesystem>

#include "vicon/picture/png_file.h"

namespace vicon::report {

using picture::Picture;

/// Whether all pixels of three channels are grey.
bool isGrey(const Picture& picture);
/// The first of three channels alone.
Picture inGrey(Picture picture);

/// Reads a PNG for print: with at most `max_width` pixels a row, each the mean of those it covers. A picture whose
/// pixels are all grey comes with one channel. Throws as picture::readPng().
Picture readForPrint(const std::filesystem::path& file, int max_width);

}  // namespace vicon::report
