#include "vicon/picture/png_file.h"

#include <png.h>

#include <cstdio>
#include <memory>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::picture {
namespace {

/// No picture that VICON makes comes near; a file that claims more is broken.
constexpr std::int64_t kMostPixels = 100'000'000;

[[noreturn]] void fail(png_structp png, png_const_charp what)
{
    throw Error(ErrorCode::store, std::string("the picture cannot be written (") + what + ")",
                static_cast<const std::filesystem::path*>(png_get_error_ptr(png))->string(),
                "check the folder and the disk's free space");
}

/// libpng's writer; its errors are thrown, which libpng, built with unwind tables, allows.
class Writer {
public:
    explicit Writer(std::filesystem::path file)
        : file_(std::move(file)), png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &file_, fail, nullptr))
    {
        if (png_)
            info_ = png_create_info_struct(png_);
        if (!info_)
            throw Error(ErrorCode::no_memory, "no memory to write a picture");
    }
    ~Writer() { png_destroy_write_struct(&png_, &info_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    png_structp png() { return png_; }
    png_infop info() { return info_; }

private:
    std::filesystem::path file_;  ///< named by errors
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

int colorTypeOf(std::size_t channels)
{
    return channels == 1 ? PNG_COLOR_TYPE_GRAY : channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA;
}

void addText(Writer& writer, std::string keyword, std::string text)
{
    png_text chunk{};
    chunk.compression = PNG_TEXT_COMPRESSION_NONE;
    chunk.key = keyword.data();
    chunk.text = text.data();
    chunk.text_length = text.size();
    png_set_text(writer.png(), writer.info(), &chunk, 1);
}

}  // namespace

void writePng(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> pixels,
              const PngOptions& options)
{
    replaceFile(file, [&](const std::filesystem::path& to) {
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(to.c_str(), "wb"), std::fclose);
        if (!out)
            throw Error(ErrorCode::store, "cannot be written", file.string());
        const std::size_t row = pixels.size() / std::size_t(height);
        Writer writer(file);
        png_init_io(writer.png(), out.get());
        png_set_IHDR(writer.png(), writer.info(), png_uint_32(width), png_uint_32(height), 8,
                     colorTypeOf(row / std::size_t(width)), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                     PNG_FILTER_TYPE_DEFAULT);
        png_set_compression_level(writer.png(), options.compression);
        if (options.says_srgb)
            png_set_sRGB(writer.png(), writer.info(), PNG_sRGB_INTENT_PERCEPTUAL);
        if (!options.keyword.empty())
            addText(writer, options.keyword, options.text);
        png_write_info(writer.png(), writer.info());
        for (std::size_t y = 0; y < std::size_t(height); ++y)
            png_write_row(writer.png(), &pixels[y * row]);
        png_write_end(writer.png(), nullptr);
        if (std::fflush(out.get()) != 0)
            fail(writer.png(), "the file is not whole");
    });
}

Picture readPng(const std::filesystem::path& file, int channels)
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
    image.format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    Picture picture{int(image.width), int(image.height), channels, {}};
    picture.pixels.resize(PNG_IMAGE_SIZE(image));
    const png_color white{255, 255, 255};
    if (!png_image_finish_read(&image, &white, picture.pixels.data(), 0, nullptr))
        throw Error(ErrorCode::bad_input, "the picture cannot be read", file.string());
    return picture;
}

}  // namespace vicon::picture
