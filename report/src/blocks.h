#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "page_flow.h"
#include "vicon/report/print_pictures.h"
#include "vicon/report/statements.h"

namespace vicon::report {

/// A statement set in lines.
struct StatementBlock {
    TextLine label;
    std::vector<TextLine> lines;
};

/// Statements as a table of two columns, the label on the left.
class StatementTable {
public:
    StatementTable(Typesetter& type, const std::vector<Statement>& statements, double width,
                   double label_width = look::kLabelWidth);
    double height() const;
    /// Draws it at the flow's place and moves on, over pages where needed.
    void draw(PageFlow& flow, double x) const;

private:
    double label_width_;
    std::vector<StatementBlock> blocks_;
};

/// A section's heading with a rule below it, and its bookmark; kept with `following` points of what comes next.
void drawSection(PageFlow& flow, const std::string& title, double following);

/// A tinted box with lines of text.
void drawNotice(PageFlow& flow, const std::vector<std::string>& lines);

/// The report's pictures: each file is embedded once.
class PictureShelf {
public:
    /// @param begun pictures that are being made ready; may be none
    explicit PictureShelf(PdfDocument& pdf, const PrintPictures* begun = nullptr) : pdf_(pdf), begun_(begun) {}

    struct Shelved {
        int number = -1;               ///< in the document; below 0: there is no picture
        double width = 0, height = 0;  ///< pixels
        bool unreadable = false;
    };
    /// Reads a picture that will be printed at most `print_width` points wide.
    const Shelved& get(const std::filesystem::path& file, double print_width);

private:
    PdfDocument& pdf_;
    const PrintPictures* begun_;
    std::map<std::string, Shelved> shelf_;
};

/// A picture with its caption, as large as fits into the box, or a frame that says why there is none.
struct FramedPicture {
    PictureShelf::Shelved picture;
    std::string caption;
    std::string absent;  ///< said instead of the picture

    /// Width over height; a square stands for one that is absent.
    double aspect() const { return picture.number >= 0 ? picture.width / picture.height : 1; }
    /// Size of the picture within a box.
    Box fitted(double width, double height) const;
    /// Draws at (x, y) = left, top; returns the height used, caption included.
    double draw(PageFlow& flow, double x, double y, double width, double height) const;
};

}  // namespace vicon::report
