#pragma once

#include "reading/reading_tool.h"

class QAction;

namespace vicon::viewer {

class BesideView;

/// Both scans of a case side by side: the other one shows what corresponds to the place that is read.
class ComparisonTool : public ReadingTool {
    Q_OBJECT
public:
    explicit ComparisonTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;
    void scanOpened(const Arrival&) override;
    void pointLeft() override { partner_.reset(); }
    void markerShown(const Marker& marker) override;
    void draw(bool still) override;

private:
    /// The partner of the marker that is shown.
    struct Partner {
        ViewPose view;
        Point3 at_mm;
    };
    void connectView();
    void compare(bool on);
    void arrange();
    /// The partner's, else what corresponds.
    NavigationState place() const;
    void clicked(Pixel at, Qt::KeyboardModifiers modifiers);

    BesideView* view_;
    QAction* on_ = nullptr;
    std::optional<Partner> partner_;
    ShownPicture shown_;
};

}  // namespace vicon::viewer
