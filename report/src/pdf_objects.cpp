#include "pdf_objects.h"

#include <hpdf_font.h>
#include <hpdf_fontdef.h>
#include <hpdf_objects.h>
#include <hpdf_streams.h>
#include <libdeflate.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "vicon/core/error.h"

namespace vicon::report {
namespace {

/// PNG's filter type "Paeth" and PDF's predictor for rows with a filter type each (PDF 32000-1, 7.4.4.4).
constexpr std::uint8_t kPaethRow = 4;
constexpr int kPngPredictor = 15;
/// Endoscopic pictures and slices: smaller than zlib's 3 by 5 % and more, in less than half its time; 6 takes twice as
/// long for another 5 %.
constexpr int kPictureLevel = 3;

std::uint8_t paeth(int left, int above, int above_left)
{
    const int estimate = left + above - above_left;
    const int to_left = std::abs(estimate - left), to_above = std::abs(estimate - above),
              to_above_left = std::abs(estimate - above_left);
    return std::uint8_t(to_left <= to_above && to_left <= to_above_left ? left
                        : to_above <= to_above_left                     ? above
                                                                        : above_left);
}

/// Each row preceded by its filter type.
std::vector<std::uint8_t> predicted(const Picture& picture)
{
    const auto step = std::size_t(picture.channels), row = step * std::size_t(picture.width);
    std::vector<std::uint8_t> out;
    out.reserve((row + 1) * std::size_t(picture.height));
    for (std::size_t y = 0; y < std::size_t(picture.height); ++y) {
        out.push_back(kPaethRow);
        const std::uint8_t* now = picture.pixels.data() + y * row;
        const std::uint8_t* above = y ? now - row : nullptr;
        for (std::size_t n = 0; n < row; ++n)
            out.push_back(std::uint8_t(now[n] - paeth(n < step ? 0 : now[n - step], above ? above[n] : 0,
                                                      above && n >= step ? above[n - step] : 0)));
    }
    return out;
}

std::string hex(char32_t code)
{
    std::array<char, 12> digits{};
    std::snprintf(digits.data(), digits.size(), "%04X", unsigned(code));
    return digits.data();
}

/// UTF-16: above the basic plane as two surrogates.
std::string hexUtf16(char32_t c)
{
    constexpr char32_t kBeyond = 0x10000;
    return c < kBeyond ? hex(c) : hex(0xd800 + ((c - kBeyond) >> 10)) + hex(0xdc00 + ((c - kBeyond) & 0x3ff));
}

}  // namespace

std::vector<std::uint8_t> packed(const Picture& picture)
{
    const std::vector<std::uint8_t> rows = predicted(picture);
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
        libdeflate_alloc_compressor(kPictureLevel), libdeflate_free_compressor);
    if (!compressor)
        throw Error(ErrorCode::no_memory, "there is not enough memory for the report");
    const std::size_t most = libdeflate_zlib_compress_bound(compressor.get(), rows.size());
    const auto out = std::make_unique_for_overwrite<std::uint8_t[]>(most);
    const std::size_t size = libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), out.get(), most);
    if (size == 0)
        throw Error(ErrorCode::internal, "a picture of the report cannot be compressed");
    return {out.get(), out.get() + size};
}

HPDF_Image addImage(HPDF_Doc document, int width, int height, int channels)
{
    // libharu knows neither predictors nor data deflated already. One grey pixel is then described as what it becomes.
    const HPDF_BYTE pixel = 0;
    HPDF_Image image = HPDF_LoadRawImageFromMem(document, &pixel, 1, 1, HPDF_CS_DEVICE_GRAY, 8);
    if (!image)
        return nullptr;
    HPDF_Dict_AddNumber(image, "Width", width);
    HPDF_Dict_AddNumber(image, "Height", height);
    HPDF_Dict_AddName(image, "ColorSpace", channels == 1 ? "DeviceGray" : "DeviceRGB");
    HPDF_Array parameters = HPDF_Array_New(image->mmgr);
    HPDF_Dict predictor = HPDF_Dict_New(image->mmgr);
    HPDF_Dict_AddNumber(predictor, "Predictor", kPngPredictor);
    HPDF_Dict_AddNumber(predictor, "Colors", channels);
    HPDF_Dict_AddNumber(predictor, "BitsPerComponent", 8);
    HPDF_Dict_AddNumber(predictor, "Columns", width);
    HPDF_Array_Add(parameters, predictor);
    HPDF_Dict_Add(image, "DecodeParms", parameters);
    image->filter = HPDF_STREAM_FILTER_NONE;  // for libharu, which would deflate it, and take another entry out
    image->write_fn = [](HPDF_Dict, HPDF_Stream stream) {
        return HPDF_Stream_WriteStr(stream, "/Filter [ /FlateDecode ]\012");
    };
    return image;
}

void setPacked(HPDF_Image image, const std::vector<std::uint8_t>& stream)
{
    HPDF_MemStream_FreeData(image->stream);
    HPDF_Stream_Write(image->stream, stream.data(), HPDF_UINT(stream.size()));
}

void embedGlyphs(HPDF_Font font, const std::vector<unsigned>& glyphs)
{
    const auto* definition = static_cast<HPDF_FontAttr>(font->attr)->fontdef;
    const auto* attributes = static_cast<HPDF_TTFontDefAttr>(definition->attr);
    for (const unsigned glyph : glyphs)
        if (glyph < attributes->num_glyphs)
            attributes->glyph_tbl.flgs[glyph] = 1;
}

void setToUnicode(HPDF_Font font, const std::map<char16_t, char32_t>& meaning)
{
    auto* map = static_cast<HPDF_Dict>(HPDF_Dict_GetItem(font, "ToUnicode", HPDF_OCLASS_DICT));
    if (!map || !map->stream)
        throw Error(ErrorCode::internal, "libharu gave a font without a map to Unicode");
    std::string text =
        "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
        "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
        "/CMapName /Adobe-Identity-UCS def\n/CMapType 2 def\n"
        "1 begincodespacerange\n<0000> <FFFF>\nendcodespacerange\n";
    constexpr std::size_t kMostInBlock = 100;  // a limit of the format
    const std::vector<std::pair<char16_t, char32_t>> list(meaning.begin(), meaning.end());
    for (std::size_t from = 0; from < list.size(); from += kMostInBlock) {
        const std::size_t to = std::min(from + kMostInBlock, list.size());
        text += std::to_string(to - from) + " beginbfchar\n";
        for (std::size_t n = from; n < to; ++n)
            text.append("<").append(hex(list[n].first)).append("> <").append(hexUtf16(list[n].second)).append(">\n");
        text += "endbfchar\n";
    }
    text += "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n";
    HPDF_MemStream_FreeData(map->stream);
    HPDF_Stream_Write(map->stream, reinterpret_cast<const HPDF_BYTE*>(text.data()), HPDF_UINT(text.size()));
}

}  // namespace vicon::report
