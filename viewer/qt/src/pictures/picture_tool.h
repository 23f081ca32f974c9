#pragma once

#include <QImage>

#include "reading/reading_tool.h"

namespace vicon::viewer {

/// The view from inside as it is on the screen: kept with the case, or copied.
class PictureTool : public ReadingTool {
    Q_OBJECT
public:
    using ReadingTool::ReadingTool;
    void addTo(ReadingLayout& layout) override;

private:
    void save();
    void copy();
    QImage named() const;
};

}  // namespace vicon::viewer
