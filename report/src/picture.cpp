#include "picture.h"

#include <png.h>

#include <algorithm>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon::report {
namespace {

/// No picture that VICON makes comes near; a file that claims more is broken.
constexpr std::int64_t kMostPixels = 100'000'000;

bool isGrey(const std::vector<std::uint8_t>& rgb)
{
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

}  // namespace

Picture readPng(const std::filesystem::path& file)
{
    if (!std::filesystem::exists(file))
        throw Error(ErrorCode::not_found, "the picture does not exist", file.string());
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, file.c_str()))
        throw Error(ErrorCode::bad_input, "the picture cannot be read", file.string());
    if (std::int64_t(image.width) * image.height > kMostPixels) {
        png_image_free(&image);
        throw Error(ErrorCode::bad_input, "the picture is too large", file.string());
    }
    image.format = PNG_FORMAT_RGB;
    Picture picture{int(image.width), int(image.height), 3, {}};
    picture.pixels.resize(PNG_IMAGE_SIZE(image));
    const png_color white{255, 255, 255};
    if (!png_image_finish_read(&image, &white, picture.pixels.data(), 0, nullptr))
        throw Error(ErrorCode::bad_input, "the picture cannot be read", file.string());
    return isGrey(picture.pixels) ? inGrey(std::move(picture)) : picture;
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

}  // namespace vicon::report
