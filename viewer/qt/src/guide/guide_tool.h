#pragma once

#include <QStringList>

#include "reading/reading_tool.h"

namespace vicon::viewer {

/// F1: the guide, at what the reader does or looks at.
class GuideTool : public ReadingTool {
    Q_OBJECT
public:
    explicit GuideTool(Reading& reading) : ReadingTool(reading) {}

    void addTo(ReadingLayout& layout) override;
    /// All headings that it opens the guide at.
    static QStringList headings();

private:
    /// Of the guide.
    QString headingHere() const;
};

}  // namespace vicon::viewer
