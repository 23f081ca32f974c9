#pragma once

#include <QImage>
#include <filesystem>
#include <vector>

namespace vicon::viewer::test {

/// A film as Theora's own decoder plays it back.
struct PlayedFilm {
    double pictures_per_s = 0;
    std::vector<QImage> pictures;  ///< brightness alone, 8 bit
};

/// Throws std::runtime_error where it is no Ogg Theora file or a packet of it cannot be decoded.
PlayedFilm playFilm(const std::filesystem::path& file);

}  // namespace vicon::viewer::test
