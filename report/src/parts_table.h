#pragma once

#include <string>
#include <vector>

#include "page_flow.h"
#include "vicon/report/content.h"

namespace vicon::report {

/// How far open and how wet each part of the colon is in one scan, a line each, for a column beside a picture.
class PartsTable {
public:
    PartsTable(Typesetter& type, const ScanEntry& scan, double width);
    /// In which its words have the room that they need.
    static double leastWidth(const ScanEntry& scan);
    double height() const;
    /// Draws it with its top at `y`. It does not leave the page.
    void draw(PageFlow& flow, double x, double y) const;

private:
    struct Cell {
        TextLine line;
        Color color;
    };
    double leftOf(std::size_t column) const;

    double width_;
    std::size_t columns_ = 0;
    std::vector<std::vector<Cell>> rows_;  ///< the head first
};

}  // namespace vicon::report
