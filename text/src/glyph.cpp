#include "vicon/text/glyph.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_ADVANCES_H
#include FT_OUTLINE_H

#include <cmath>

#include "font_size.h"

namespace vicon::text {
namespace {

using Point = OutlinePart::Point;

/// Collects an outline as FreeType walks along it.
struct Walk {
    std::vector<OutlinePart> parts;
    double scale = 1;
    Point at;

    void add(OutlinePart::Kind kind, const Point& a, const Point& b, const Point& end)
    {
        parts.push_back({kind, {a, b, end}});
        at = end;
    }
    Point scaled(const FT_Vector* p) const { return {double(p->x) * scale, double(p->y) * scale}; }
};

/// A third of the way from a quadratic curve's control point to one of its ends is the control point of the same curve
/// as a cubic one.
Point towards(const Point& control, const Point& end)
{
    return {(2 * control.x + end.x) / 3, (2 * control.y + end.y) / 3};
}

const FT_Outline_Funcs kWalking{[](const FT_Vector* to, void* data) {
                                    auto& walk = *static_cast<Walk*>(data);
                                    walk.add(OutlinePart::Kind::move, {}, {}, walk.scaled(to));
                                    return 0;
                                },
                                [](const FT_Vector* to, void* data) {
                                    auto& walk = *static_cast<Walk*>(data);
                                    walk.add(OutlinePart::Kind::line, {}, {}, walk.scaled(to));
                                    return 0;
                                },
                                [](const FT_Vector* control, const FT_Vector* to, void* data) {
                                    auto& walk = *static_cast<Walk*>(data);
                                    const Point c = walk.scaled(control), end = walk.scaled(to);
                                    walk.add(OutlinePart::Kind::curve, towards(c, walk.at), towards(c, end), end);
                                    return 0;
                                },
                                [](const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* data) {
                                    auto& walk = *static_cast<Walk*>(data);
                                    walk.add(OutlinePart::Kind::curve, walk.scaled(first), walk.scaled(second),
                                             walk.scaled(to));
                                    return 0;
                                },
                                0,
                                0};

void addComponents(FT_Face face, unsigned glyph, std::vector<unsigned>& out)
{
    if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_RECURSE) != 0 ||
        face->glyph->format != FT_GLYPH_FORMAT_COMPOSITE)
        return;
    std::vector<unsigned> parts;
    for (FT_UInt n = 0; n < face->glyph->num_subglyphs; ++n) {
        FT_Int part = 0, argument1 = 0, argument2 = 0;
        FT_UInt flags = 0;
        FT_Matrix transform;
        if (FT_Get_SubGlyph_Info(face->glyph, n, &part, &flags, &argument1, &argument2, &transform) == 0)
            parts.push_back(unsigned(part));
    }
    for (const unsigned part : parts) {  // loading them replaces the glyph that was asked
        out.push_back(part);
        addComponents(face, part, out);
    }
}

}  // namespace

void setSize(FT_Face face, double size_px)
{
    FT_Set_Char_Size(face, 0, FT_F26Dot6(std::lround(size_px * kFixed)), 72, 72);
}

GlyphMask glyphMaskOf(const FontSet& fonts, int font, unsigned glyph, double size_px, double right_px, double up_px)
{
    FT_Face face = fonts.face(font);
    setSize(face, size_px);
    if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING) != 0)
        return {};
    FT_Outline_Translate(&face->glyph->outline, FT_Pos(right_px * kFixed), FT_Pos(up_px * kFixed));
    if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) != 0)
        return {};
    const FT_Bitmap& bitmap = face->glyph->bitmap;
    GlyphMask out{face->glyph->bitmap_left, face->glyph->bitmap_top, int(bitmap.width), int(bitmap.rows), {}};
    for (unsigned row = 0; row < bitmap.rows; ++row) {
        const std::uint8_t* const begin = bitmap.buffer + std::ptrdiff_t(row) * bitmap.pitch;
        out.cover.insert(out.cover.end(), begin, begin + bitmap.width);
    }
    return out;
}

std::vector<OutlinePart> outlineOf(const FontSet& fonts, int font, unsigned glyph)
{
    FT_Face face = fonts.face(font);
    if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) != 0 || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
        return {};
    Walk walk{.parts = {}, .scale = 1.0 / face->units_per_EM, .at = {}};
    FT_Outline_Decompose(&face->glyph->outline, &kWalking, &walk);
    return std::move(walk.parts);
}

unsigned glyphOf(const FontSet& fonts, int font, char32_t c)
{
    return FT_Get_Char_Index(fonts.face(font), c);
}

double advance_em(const FontSet& fonts, int font, unsigned glyph)
{
    FT_Face face = fonts.face(font);
    FT_Fixed advance = 0;
    if (FT_Get_Advance(face, glyph, FT_LOAD_NO_SCALE, &advance) != 0)
        return 0;
    return double(advance) / face->units_per_EM;
}

std::vector<unsigned> componentsOf(const FontSet& fonts, int font, unsigned glyph)
{
    std::vector<unsigned> out;
    addComponents(fonts.face(font), glyph, out);
    return out;
}

}  // namespace vicon::text
