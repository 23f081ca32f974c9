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
    void scanLeft() override;
    void scanOpened(const Arrival& arrival) override;
    void pointLeft() override;
    void markerShown(const Marker& marker) override;
    void draw(bool still) override;
    void annotate(SnapshotRequest& request, const OpenScan& scan) const override;

private:
    /// The partner of the marker that is shown, in the scan beside.
    struct Partner {
        ViewPose view;
        Point3 at_mm;
    };
    void connectView();
    void connectLine();
    void drawLine();
    /// Not where it lies in a scan that is not beside, until that comes.
    void showPartner();
    /// The key: the other scan; of several the next one; after the last none.
    void switched(bool on);
    void compare(bool on);
    /// Of the case's scans but the one that is read the next after this; empty: the first.
    const ScanRecord* otherAfter(const std::string& beside) const;
    void followLayout(bool elsewhere);
    void arrange();
    /// Where the place that is read lies in the scan beside.
    StationInterval corresponding() const;
    /// The partner's, else what corresponds.
    NavigationState place() const;
    void drawBeside(bool still);
    void sayPlace(const StationInterval& place);
    void clicked(Pixel at, Qt::KeyboardModifiers modifiers);
    /// To what corresponds to the place of the other scan's way that is nearest in its projection.
    void clickedOverview(Pixel at);
    /// What is beside; nothing, which is said, where it is of an earlier examination and the click measures nothing.
    const OpenScan* clickableScan();

    BesideView* view_;
    QAction* on_ = nullptr;
    bool by_layout_ = false;               // the reader did not ask for the other scan alone
    std::vector<Marker> partner_markers_;  // in whatever scans
    std::optional<Partner> partner_;
    std::optional<StationMap> map_;  // from the scan that is read to the one beside
    std::shared_ptr<OpenScan> left_;
    std::optional<PriorPlace> came_to_;  // from the same place of another scan; until the eye moves on
    double came_to_mm_ = 0;
    ShownPicture shown_;
    Point3 eye_mm_;                                  // of the picture that is wanted by now
    std::optional<ShownProjection> shown_overview_;  // of the other scan
};

}  // namespace vicon::viewer
