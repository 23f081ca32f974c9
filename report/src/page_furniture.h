#pragma once

#include <string>
#include <vector>

#include "pdf_document.h"
#include "vicon/report/content.h"

namespace vicon::report {

/// What stands on every page: whose report it is, that it is a draft, and which page of how many.
class PageFurniture {
public:
    PageFurniture(const ReportContent& content, Typesetter& type, double page_width);

    double topHeight() const;
    double bottomHeight() const;
    void draw(PdfDocument& pdf, Typesetter& type, int page, double page_height) const;

private:
    double drawIdentity(PdfDocument& pdf, int page, double top) const;
    void drawFooter(PdfDocument& pdf, Typesetter& type, int page) const;

    double page_width_;
    std::vector<TextLine> name_, details_;  ///< on the left
    std::vector<TextLine> study_;           ///< on the right
    TextLine draft_;                        ///< without runs: this is no draft
    std::string made_by_;
};

}  // namespace vicon::report
