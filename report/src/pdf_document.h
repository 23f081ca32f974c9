#pragma once

#include <memory>
#include <string>
#include <vector>

#include "picture.h"
#include "vicon/report/print_pictures.h"
#include "vicon/text/typesetter.h"

namespace vicon::report {

using text::TextLine, text::TextStyle, text::Typesetter;

struct Color {
    float red = 0, green = 0, blue = 0;
};

/// A rectangle on a page: points, origin at the lower left corner of the page.
struct Box {
    double x = 0, y = 0, width = 0, height = 0;
};

struct Corner {
    double x = 0, y = 0;
};

/// What the document says about itself; no patient data.
struct PdfInfo {
    std::string title, subject, creator, created_utc;
};

/// A PDF in memory, drawn on with libharu. Throws Error{no_memory} and Error{internal}.
class PdfDocument {
public:
    PdfDocument(text::FontSet& fonts, const PdfInfo& info);
    ~PdfDocument();
    PdfDocument(const PdfDocument&) = delete;
    PdfDocument& operator=(const PdfDocument&) = delete;

    /// Returns the page's number, from 0; pages can be drawn on in any order.
    int addPage(double width, double height);
    int pages() const;

    /// `x`, `y`: left end of the baseline.
    void text(int page, double x, double y, const TextLine& line, Color color);
    void fill(int page, Box box, Color color);
    void line(int page, double x0, double y0, double x1, double y1, double width, Color color);
    /// A filled area within straight lines from point to point.
    void polygon(int page, const std::vector<Corner>& corners, Color color);
    /// A filled disc with a thin dark rim.
    void disc(int page, double x, double y, double radius, Color color);
    /// Embeds a picture once; the number that it returns can be drawn anywhere.
    int addPicture(Picture picture);
    int addPicture(const PrintPictures::Ready& picture);
    void draw(int page, int picture, Box box);
    /// An entry of the document's outline, which leads to `y` of the page. ASCII.
    /// @param below the last entry that is below none
    void bookmark(int page, double y, const std::string& title, bool below = false);

    /// The whole file. Nothing can be drawn afterwards.
    std::string finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace vicon::report
