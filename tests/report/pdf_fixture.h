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
        for (int n = 1; n <= count; ++n)
            content_.markers.push_back(samples::plainMarker(folder_.path(), n));
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

}  // namespace vicon::report
