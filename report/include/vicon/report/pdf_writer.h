#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/report/content.h"
#include "vicon/report/options.h"
#include "vicon/report/print_pictures.h"

namespace vicon::report {

struct PdfResult {
    std::vector<std::string> warnings;  ///< what could not be printed as it is, a line each, without patient data
    int unreadable_pictures = 0;        ///< among them
    int pages = 0;
};

/// Writes the report as PDF, by replaceFile(): `pdf` holds the old report or the whole new one. The same content gives
/// the same bytes. A character that no font has is printed as its code point in brackets, a picture that cannot be
/// read as a line that says so, and both are in the warnings.
/// Throws Error{store} when the file cannot be written and Error{not_found} when the basic font is not installed.
/// @param begun pictures that are being made ready already; they make it quicker and change nothing
PdfResult writePdf(const ReportContent& content, const std::filesystem::path& pdf, const ReportOptions& options,
                   const PrintPictures* begun = nullptr);
/// The same into memory: `pdf` becomes what would be written.
/// @param wanted asked at every page; throws Error{cancelled} where it says so, and `pdf` is as it was
PdfResult drawPdf(const ReportContent& content, std::string& pdf, const ReportOptions& options,
                  const PrintPictures* begun, const Progress& wanted);

}  // namespace vicon::report
