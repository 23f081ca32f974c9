#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "report_samples.h"
#include "vicon/support/support.h"

namespace vicon::report {

class PdfWriter : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    std::filesystem::path pdf_ = folder_ / "report.pdf";
    ReportContent content_ = samples::plainCase(folder_.path());

    void addMarkers(int count)
    {
        for (int n = 1; n <= count; ++n) {
            content_.markers.push_back(samples::plainMarker(folder_.path(), n));
            content_.read.loose_markers.push_back(content_.markers.back().marker.id);
        }
    }
    PdfResult write(const ReportOptions& options = {}) { return writePdf(content_, pdf_, options); }
};

/// What two other programs say of the file.
inline void expectSound(const std::filesystem::path& pdf)
{
    const auto qpdf = support::runCommand("qpdf --check " + pdf.string());
    EXPECT_EQ(qpdf.exit_code, 0) << qpdf.output;
    EXPECT_THAT(qpdf.output, testing::Not(testing::HasSubstr("WARNING")));
    const auto poppler = support::runCommand("pdftoppm -r 20 " + pdf.string() + " " + pdf.string() + ".pages");
    EXPECT_EQ(poppler.exit_code, 0);
    EXPECT_THAT(poppler.output, testing::IsEmpty());
    const auto text = support::runCommand("pdftotext " + pdf.string() + " /dev/null");
    EXPECT_THAT(text.output, testing::IsEmpty());
}

/// No word leaves the page's margins, and no two overlap.
inline void expectTidy(const std::filesystem::path& pdf, double page_width = 595.28, double page_height = 841.89)
{
    constexpr double kMargin = 45, kEdge = 20;
    for (std::vector<samples::Word>& words : samples::wordsByPage(pdf)) {
        ASSERT_FALSE(words.empty());
        for (samples::Word& w : words) {
            EXPECT_TRUE(w.left > kMargin && w.right < page_width - kMargin && w.top > kEdge &&
                        w.bottom < page_height - kEdge)
                << "'" << w.text << "' at " << w.left << ", " << w.top;
            const double trim = 0.2 * (w.bottom - w.top);  // boxes are as high as the highest accent
            w.top += trim;
            w.bottom -= trim;
        }
        for (std::size_t a = 0; a < words.size(); ++a)
            for (std::size_t b = a + 1; b < words.size(); ++b) {
                const auto &p = words[a], &q = words[b];
                if (p.left < q.right - 0.5 && q.left < p.right - 0.5 && p.top < q.bottom && q.top < p.bottom)
                    ADD_FAILURE() << "'" << p.text << "' over '" << q.text << "'";
            }
    }
}

}  // namespace vicon::report
