#pragma once

#include <span>
#include <string>
#include <vector>

#include "page_flow.h"

namespace vicon::report {

/// A column of a table: its title, and its left edge as a fraction of the page's width.
struct TableColumn {
    const char* title;
    double at;
};

/// The text cut to a width, with an ellipsis.
TextLine cutTo(Typesetter& type, const std::string& text, TextStyle style, double width);

/// A table of one line a row, or two where a cell needs them, whose heading stands again on each page that it reaches.
class RowTable {
public:
    RowTable(PageFlow& flow, std::span<const TableColumn> columns) : flow_(flow), columns_(columns) {}

    static double headHeight();
    double rowHeight(const std::vector<std::string>& cells) const;
    void drawHead();
    /// Starts a page where this one has no room for the row.
    void beginRow(const std::vector<std::string>& cells);
    /// As many cells as there are; the columns after them stay empty. Moves on.
    void drawRow(const std::vector<std::string>& cells);
    double left(std::size_t column) const { return flow_.left() + columns_[column].at * flow_.width(); }

private:
    std::vector<TextLine> linesOf(std::size_t column, const std::string& cell) const;
    double right(std::size_t column) const
    {
        return column + 1 < columns_.size() ? left(column + 1) : flow_.left() + flow_.width();
    }

    PageFlow& flow_;
    std::span<const TableColumn> columns_;
};

}  // namespace vicon::report
