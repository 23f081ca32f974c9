#pragma once

#include <string>
#include <vector>

#include "pdf_document.h"
#include "vicon/core/progress.h"

namespace vicon::report {

/// The look of the report, in one place. Lengths are points.
namespace look {
inline constexpr Color kInk{0.12F, 0.13F, 0.15F}, kMuted{0.40F, 0.43F, 0.46F}, kAccent{0.09F, 0.24F, 0.39F},
    kRule{0.80F, 0.82F, 0.85F}, kPale{0.955F, 0.96F, 0.97F};
inline constexpr Color kDraftFill{1.0F, 0.94F, 0.78F}, kDraftInk{0.50F, 0.23F, 0.0F};
inline constexpr Color kNoticeFill{0.99F, 0.90F, 0.88F}, kNoticeInk{0.55F, 0.08F, 0.06F};
inline constexpr TextStyle kTitle{18, true}, kSection{12.5, true}, kEntry{10.5, true}, kBody{9, false}, kBold{9, true},
    kSmall{8, false};
inline constexpr double kLeading = 1.36;  ///< of the font size, from baseline to baseline
inline constexpr double kAscent = 1.05;   ///< of the font size, from a line's top to its baseline
inline constexpr double kMargin = 46;
inline constexpr double kLabelWidth = 82, kNarrowLabelWidth = 64;
inline constexpr double kGap = 14;  ///< between blocks
inline constexpr double kThinLine = 0.6;
}  // namespace look

inline double leadingOf(TextStyle style)
{
    return style.size * look::kLeading;
}

/// Fills pages from the top; what stands on every page is drawn at the end, when their number is known.
class PageFlow {
public:
    struct Paper {
        double width = 0, height = 0;
        double top = 0, bottom = 0;  ///< kept free for header and footer
    };

    /// @param wanted asked at every page
    PageFlow(PdfDocument& pdf, Typesetter& typesetter, Paper paper, const Progress& wanted)
        : pdf(pdf), type(typesetter), paper_(paper), wanted_(wanted)
    {
        newPage();
    }

    PdfDocument& pdf;
    Typesetter& type;

    int page() const { return page_; }
    /// Top of what comes next.
    double y() const { return y_; }
    double left() const { return look::kMargin; }
    double width() const { return paper_.width - 2 * look::kMargin; }
    double room() const { return y_ - paper_.bottom; }
    double wholePage() const { return paper_.height - paper_.top - paper_.bottom; }
    bool atTop() const { return y_ >= paper_.height - paper_.top; }

    /// Throws Error{cancelled} once nobody wants the pages any more.
    void newPage();
    void skip(double height) { y_ -= height; }
    /// Starts a page unless this one is still empty.
    void startPage()
    {
        if (!atTop())
            newPage();
    }
    /// Starts a page when less than `height` is left, unless this one is still empty.
    void need(double height);

    /// Draws a line at `x` with its top at `y`.
    void put(double x, double y, const TextLine& line, Color color);
    void putRight(double right, double y, const TextLine& line, Color color);
    /// Draws lines below each other and moves on; starts pages where needed. Text that runs from right to left stands
    /// at the right edge of `width`.
    void paragraph(double x, double width, const std::vector<TextLine>& lines, TextStyle style, Color color);

private:
    Paper paper_;
    const Progress& wanted_;
    int page_ = -1;
    double y_ = 0;
};

}  // namespace vicon::report
