#pragma once

#include <QTimer>

#include "reading/reading_tool.h"
#include "report/reader_work.h"
#include "report/report_books.h"

class QDockWidget;

namespace vicon::viewer {

class CoverageTool;
class ReadingTimeTool;
class ReportForm;

/// The case's report: its form beside the views, its pages, its signature.
class ReportTool : public ReadingTool {
    Q_OBJECT
public:
    /// @param coverage, time what this reader's work says; must outlive it
    ReportTool(Reading& reading, const ReadingServices& services, const std::string& case_id, CoverageTool& coverage,
               const ReadingTimeTool& time);

    void addTo(ReadingLayout& layout) override;
    void useWords(const OrganWords& words) override;
    void scanOpened(const Arrival& arrival) override;
    void markersChanged() override;
    void markerShown(const Marker& marker) override;
    void stop() override;

private:
    void connectBooks();
    void connectForm();
    void toggle();
    void takeWidth();
    void leave();
    /// Of the first of these markers whose scan is open.
    void drawFinding(const QString& which, const std::vector<Marker>& markers);
    /// What this reader's work says is counted first: of scans that are not open, too.
    using UseWork = std::function<void(const ReaderWork&)>;
    void whenWorkIsKnown(UseWork use);
    void workKnown(const std::vector<ReviewedScan>& scans);
    void confirmSigning(const ReaderWork& work);
    void askWhyAmend();
    /// Or gives them up, while they are drawn.
    void makePages();
    void preview(const QByteArray& pdf);

    CoverageTool& coverage_;
    const ReadingTimeTool& time_;
    ReportBooks books_;
    ReportForm* form_;
    int width_px_ = 0;  ///< of the form as it was left; none yet
    QDockWidget* dock_ = nullptr;
    bool has_report_ = true;
    std::vector<UseWork> waiting_;  ///< until it is known
    QTimer delivery_;               ///< while the form is there: what the PACS has
    std::string shown_marker_;      ///< the one that was gone to last
};

}  // namespace vicon::viewer
