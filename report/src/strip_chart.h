#pragma once

#include <string>
#include <vector>

#include "page_flow.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/scan_quality.h"

namespace vicon::report {

/// Something at a place of the colon: a finding's number.
struct StripMark {
    std::string label;
    double station_mm = 0;
};

/// A scan's colon, laid straight.
struct StripColon {
    std::string title;
    std::string about;  ///< below the title; may be empty
    LumenAlong along;
    ColonPartRanges parts;
    double length_mm = 0;
    std::vector<StripMark> marks;
};

/// Colons laid straight, one below the other, rectal ends on the left, all to one scale: as wide as the cross-section
/// is large, with the fluid at the bottom, collapsed stretches, the names of the parts and what was found where.
class StripChart {
public:
    /// @param half_height of each colon, from its middle to the end of the scale: points; wider ends are cut
    StripChart(Typesetter& type, const std::vector<StripColon>& colons, double width, double half_height);

    double height() const;
    /// At the flow's place, which has the height, and moves on.
    void draw(PageFlow& flow) const;

private:
    /// A word with its middle at `x`, in a row; rows count away from the colon.
    struct Placed {
        TextLine line;
        double x = 0;
        std::size_t row = 0;
    };
    struct Panel {
        StripColon colon;
        TextLine title;
        std::vector<TextLine> about;
        std::vector<Placed> names, marks;
        std::size_t name_rows = 0, mark_rows = 0;
    };

    Panel panelOf(Typesetter& type, const StripColon& colon) const;
    double heightOf(const Panel& panel) const;
    double xAt(double station_mm) const;
    void drawPanel(PageFlow& flow, const Panel& panel) const;
    void drawLumen(PageFlow& flow, const StripColon& colon, double middle) const;
    void drawParts(PageFlow& flow, const Panel& panel, double bottom) const;
    void drawMarks(PageFlow& flow, const Panel& panel, double top, double middle) const;
    void drawScale(PageFlow& flow, const StripColon& colon, double middle) const;
    void drawAxis(PageFlow& flow) const;

    double width_, half_height_;
    double longest_mm_ = 0, widest_mm_ = 0;
    std::vector<Panel> panels_;
};

}  // namespace vicon::report
