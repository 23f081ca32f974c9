#pragma once

#include "reading/reading_tool.h"

namespace vicon::viewer {

/// Whose the pictures are and of which scan, once for all of them; and what a person must decide about the case.
class BannerTool : public ReadingTool {
    Q_OBJECT
public:
    explicit BannerTool(Reading& reading);

    void addTo(ReadingLayout& layout) override { layout_ = &layout; }
    void scanOpened(const Arrival&) override;

private:
    void show();

    ReadingLayout* layout_ = nullptr;
};

}  // namespace vicon::viewer
