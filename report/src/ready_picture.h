#pragma once

#include <cstdint>
#include <vector>

#include "vicon/report/print_pictures.h"

namespace vicon::report {

/// A picture as the PDF takes it.
struct PrintPictures::Ready {
    int width = 0, height = 0, channels = 0;
    std::vector<std::uint8_t> stream;  ///< see packed()
};

}  // namespace vicon::report
