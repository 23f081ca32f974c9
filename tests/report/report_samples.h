#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vicon/report/pdf_writer.h"

namespace vicon::report::samples {

/// Writes a PNG whose four quarters have these colours (RGB): top left, top right, bottom left, bottom right.
void writeQuarters(const std::filesystem::path& file, int width, int height,
                   const std::array<std::array<std::uint8_t, 3>, 4>& colors);

/// A case with one prepared scan and no marker; pictures lie in `folder`.
ReportContent plainCase(const std::filesystem::path& folder);
/// Marker number `n` (from 1) of that scan, with both pictures.
MarkerEntry plainMarker(const std::filesystem::path& folder, int n);

/// Adds finding number `n` (from 1), which marker `n` and, where there is one, marker `n + 1` show.
void addFinding(ReportContent& content, int n);
/// The scan gets named parts and a lumen along its centreline, with fluid and, where there is any, a collapsed stretch.
void addLumen(ScanEntry& entry, double collapsed_from_mm = 0, double collapsed_to_mm = 0);
/// The scans get quality, and the reader's assessment is that of a normal study.
void makeNormal(ReportContent& content);

struct Word {
    double left, top, right, bottom;  ///< points, from the upper left corner
    std::string text;
};

/// What other programs make of a PDF: its text, direction marks removed, whole and by page.
std::string textOf(const std::filesystem::path& pdf);
std::vector<std::string> pageTexts(const std::filesystem::path& pdf);
/// Where each word of each page stands.
std::vector<std::vector<Word>> wordsByPage(const std::filesystem::path& pdf);

/// A rendered page, RGB.
struct Raster {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
    const std::uint8_t* at(int x, int y) const
    {
        return &rgb[3 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
    }
};
Raster render(const std::filesystem::path& pdf, int page, int dpi);

}  // namespace vicon::report::samples
