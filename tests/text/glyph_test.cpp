#include "vicon/text/glyph.h"

#include <gtest/gtest.h>

#include <numeric>

#include "vicon/text/typesetter.h"

namespace vicon::text {
namespace {

struct Glyphs : testing::Test {
    FontSet fonts{{"/usr/share/fonts"}, FontSet::Medium::paper};
};

/// Area that an outline's contours wind around, in square em; curves as polygons of some points.
double areaOf(const std::vector<OutlinePart>& outline)
{
    using Point = OutlinePart::Point;
    double area = 0;
    Point begin, at;
    const auto to = [&](Point next) {
        area += (at.x * next.y - next.x * at.y) / 2;
        at = next;
    };
    for (const auto& [kind, p] : outline) {
        if (kind == OutlinePart::Kind::move) {
            to(begin);
            begin = at = p[2];
        } else if (kind == OutlinePart::Kind::line) {
            to(p[2]);
        } else {
            const Point from = at;
            for (int n = 1; n <= 16; ++n) {
                const double t = n / 16.0, s = 1 - t;
                const double a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
                to({a * from.x + b * p[0].x + c * p[1].x + d * p[2].x,
                    a * from.y + b * p[0].y + c * p[1].y + d * p[2].y});
            }
        }
    }
    to(begin);
    return std::abs(area);
}

TEST_F(Glyphs, HaveOutlinesOfTheAreaThatTheyCover)
{
    constexpr double kSize = 200;
    for (const char32_t c : {U'I', U'O', U'8', U'न', U'ก', U'ع', U'山', U'に'}) {
        const int font = fonts.find(c).value();
        const unsigned glyph = glyphOf(fonts, font, c);
        const GlyphMask coverage = glyphMaskOf(fonts, font, glyph, kSize, 0, 0);
        const double ink = std::accumulate(coverage.cover.begin(), coverage.cover.end(), 0.0) / 255 / kSize / kSize;
        ASSERT_GT(ink, 0.02);
        EXPECT_NEAR(areaOf(outlineOf(fonts, font, glyph)), ink, 0.02 * ink) << std::hex << unsigned(c);
    }
}

TEST_F(Glyphs, MoveByPartsOfAPixel)
{
    const int font = fonts.find(U'I').value();
    const unsigned glyph = glyphOf(fonts, font, U'I');
    const auto middle = [&](double right_px) {
        const GlyphMask c = glyphMaskOf(fonts, font, glyph, 20, right_px, 0);
        double sum = 0, weight = 0;
        for (std::size_t n = 0; n < c.cover.size(); ++n) {
            sum += c.cover[n] * (c.left + double(n % std::size_t(c.width)));
            weight += c.cover[n];
        }
        return sum / weight;
    };
    EXPECT_NEAR(middle(0.5) - middle(0), 0.5, 0.05);
}

TEST_F(Glyphs, OfSpacesDrawNothing)
{
    const int font = fonts.find(U' ').value();
    const unsigned glyph = glyphOf(fonts, font, U' ');
    EXPECT_TRUE(outlineOf(fonts, font, glyph).empty());
    EXPECT_TRUE(glyphMaskOf(fonts, font, glyph, 20, 0, 0).cover.empty());
    EXPECT_GT(advance_em(fonts, font, glyph), 0.2);
}

}  // namespace
}  // namespace vicon::text
