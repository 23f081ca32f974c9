#pragma once

#include <QTimer>

#include "coverage/coverage_keeper.h"
#include "reading/reading_tool.h"
#include "vicon/viewer/model/missed_regions.h"
#include "widgets/rest_timer.h"

class QLabel;

namespace vicon::viewer {

class CoveragePanel;
class ReadingLayout;

/// How much of the wall this reader has reviewed, and what was missed, to be gone through; kept from session to
/// session.
class CoverageTool : public ReadingTool {
    Q_OBJECT
public:
    explicit CoverageTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;
    void useWords(const OrganWords& words) override;
    void scanLeft() override;
    void scanOpened(const Arrival&) override;
    void pointLeft() override;
    void markerShown(const Marker&) override { leaveRegion(); }
    void escape() override;
    void style(EndoscopicRequest& request) const override;
    void complete(EndoscopicRequest& request) const override;
    void stop() override;

    /// What this reader has reviewed of the case's scans, also of those that are not open; summedUp() follows.
    void sumUp();

    /// For the log of the reading: how many regions were listed and looked at.
    QString visitsInWords() const;

signals:
    void summedUp(const std::vector<vicon::viewer::ReviewedScan>& scans);

private:
    void addActions(ReadingLayout& layout);
    void connectPanel();
    void connectDrawing();
    void listMissed();
    void showList(const std::vector<UnseenPatch>& patches);
    /// The list's next picture; one after the other, between those that the reader waits for.
    void drawPicture(int region);
    void next();
    void flyTo(std::size_t region);
    void leaveRegion();
    void showSeen();
    void countStill();
    void keep();

    ReadingLayout* layout_ = nullptr;
    CoveragePanel* panel_;
    QLabel* seen_text_;
    MissedRegions missed_;
    int list_ = 0;  // of how many, since the program began
    bool next_when_listed_ = false;
    std::shared_ptr<const std::vector<std::uint8_t>> highlighted_;
    CoverageKeeper keeper_{this};
    QTimer keep_timer_;
    RestTimer still_timer_;  // a picture that stays counts when it has been there for long enough
};

}  // namespace vicon::viewer
