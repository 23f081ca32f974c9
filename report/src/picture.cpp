#include "picture.h"

#include <algorithm>
#include <cmath>

namespace vicon::report {
namespace {

/// The source interval [from, to) that a target pixel covers, as weights of whole source pixels.
struct Cover {
    int first = 0;
    std::vector<double> weight;  ///< sums to 1
};

std::vector<Cover> covers(int from_size, int to_size)
{
    std::vector<Cover> out;
    const double step = double(from_size) / to_size;
    for (int n = 0; n < to_size; ++n) {
        const double from = n * step, to = std::min((n + 1) * step, double(from_size));
        Cover cover{.first = int(from)};
        for (int s = cover.first; s < to; ++s)
            cover.weight.push_back((std::min(to, s + 1.0) - std::max(from, double(s))) / (to - from));
        out.push_back(std::move(cover));
    }
    return out;
}

Picture reduced(Picture picture, int max_width)
{
    if (picture.width <= max_width)
        return picture;
    Picture out{max_width,
                std::max(1, int(std::lround(double(picture.height) * max_width / picture.width))),
                picture.channels,
                {}};
    const std::vector<Cover> columns = covers(picture.width, out.width), rows = covers(picture.height, out.height);
    for (const Cover& row : rows)
        for (const Cover& column : columns)
            for (int c = 0; c < out.channels; ++c) {
                double sum = 0;
                for (std::size_t j = 0; j < row.weight.size(); ++j)
                    for (std::size_t i = 0; i < column.weight.size(); ++i) {
                        const auto y = std::size_t(row.first) + j, x = std::size_t(column.first) + i;
                        sum += row.weight[j] * column.weight[i] *
                               picture.pixels[(y * std::size_t(picture.width) + x) * std::size_t(out.channels) +
                                              std::size_t(c)];
                    }
                out.pixels.push_back(std::uint8_t(std::lround(sum)));
            }
    return out;
}

}  // namespace

bool isGrey(const Picture& picture)
{
    const std::vector<std::uint8_t>& rgb = picture.pixels;
    for (std::size_t n = 0; n + 2 < rgb.size(); n += 3)
        if (rgb[n] != rgb[n + 1] || rgb[n] != rgb[n + 2])
            return false;
    return true;
}

Picture inGrey(Picture picture)
{
    for (std::size_t n = 0; n < picture.pixels.size() / 3; ++n)
        picture.pixels[n] = picture.pixels[3 * n];
    picture.pixels.resize(picture.pixels.size() / 3);
    picture.channels = 1;
    return picture;
}

Picture readForPrint(const std::filesystem::path& file, int max_width)
{
    Picture picture = picture::readPng(file);
    return reduced(isGrey(picture) ? inGrey(std::move(picture)) : std::move(picture), max_width);
}

}  // namespace vicon::report
