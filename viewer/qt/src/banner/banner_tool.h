#pragma once

#include "reading/reading_tool.h"

namespace vicon::viewer {

/// Whose the pictures are and of which scan, once for all of them.
class BannerTool : public ReadingTool {
    Q_OBJECT
public:
    explicit BannerTool(Reading& reading) : ReadingTool(reading) {}

    void addTo(ReadingLayout& layout) override { layout_ = &layout; }
    void scanOpened(const Arrival&) override;

private:
    ReadingLayout* layout_ = nullptr;
};

}  // namespace vicon::viewer
