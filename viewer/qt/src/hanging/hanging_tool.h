#pragma once

#include <array>

#include "reading/reading_tool.h"
#include "vicon/viewer/model/hanging.h"

namespace vicon::viewer {

class SliceTool;

/// How the case hangs: a key for each layout of the views and how slices look in it, kept for the reader.
class HangingTool : public ReadingTool {
    Q_OBJECT
public:
    /// @param slices must outlive it
    HangingTool(Reading& reading, SliceTool& slices);

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;

private:
    void hang(const Hanging& hanging);
    void keepAs(std::size_t which);
    void nextPlane();
    Hanging now() const;

    SliceTool& slices_;
    std::array<Hanging, kHangings> hangings_ = usualHangings();
};

}  // namespace vicon::viewer
