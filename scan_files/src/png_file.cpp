#include "png_file.h"

#include <png.h>

#include <cstdio>
#include <memory>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::scan_files {
namespace {

constexpr int kLevel = 3;  // of zlib's 9: the projections of the 512 x 512 x 430 phantom in half the time of 6

[[noreturn]] void fail(png_structp, png_const_charp what)
{
    throw Error(ErrorCode::store, std::string("picture cannot be written: ") + what);
}

/// libpng's writer; its errors are thrown, which libpng, built with unwind tables, allows.
class Writer {
public:
    Writer() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr))
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
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

void writePng(const std::filesystem::path& file, int width, int height, const std::vector<std::uint8_t>& rgba,
              const std::string& keyword, const std::string& text)
{
    replaceFile(file, [&](const std::filesystem::path& temporary) {
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(temporary.c_str(), "wb"), std::fclose);
        if (!out)
            throw Error(ErrorCode::store, "cannot be written", file.string());
        Writer writer;
        png_init_io(writer.png(), out.get());
        png_set_IHDR(writer.png(), writer.info(), png_uint_32(width), png_uint_32(height), 8, PNG_COLOR_TYPE_RGBA,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_compression_level(writer.png(), kLevel);
        std::string key = keyword, value = text;
        png_text chunk{};
        chunk.compression = PNG_TEXT_COMPRESSION_NONE;
        chunk.key = key.data();
        chunk.text = value.data();
        chunk.text_length = value.size();
        png_set_text(writer.png(), writer.info(), &chunk, 1);
        png_write_info(writer.png(), writer.info());
        for (int y = 0; y < height; ++y)
            png_write_row(writer.png(), &rgba[std::size_t(y) * std::size_t(width) * 4]);
        png_write_end(writer.png(), nullptr);
    });
}

std::vector<std::uint8_t> readPng(const std::filesystem::path& file, int width, int height)
{
    if (!std::filesystem::exists(file))
        throw Error(ErrorCode::not_found, "no such file", file.string(), "run 'vicon work' to make it");
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    std::vector<std::uint8_t> rgba;
    bool read = png_image_begin_read_from_file(&image, file.c_str()) != 0;
    if (read && int(image.width) == width && int(image.height) == height) {
        image.format = PNG_FORMAT_RGBA;
        rgba.resize(PNG_IMAGE_SIZE(image));
        read = png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr) != 0;
    } else {
        read = false;
    }
    png_image_free(&image);
    if (!read)
        throw Error(ErrorCode::bad_input, "is damaged, or not the picture that its description speaks of",
                    file.string(), "run 'vicon work' to make it anew");
    return rgba;
}

}  // namespace vicon::scan_files
