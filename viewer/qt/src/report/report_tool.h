#pragma once

#include <QElapsedTimer>
#include <QTimer>

#include "reading/reading_tool.h"
#include "report/report_books.h"

class QDockWidget;

namespace vicon::viewer {

class ReportForm;

/// The case's report: its form beside the views, its pages, its signature.
class ReportTool : public ReadingTool {
    Q_OBJECT
public:
    ReportTool(Reading& reading, const ReadingServices& services, const std::string& case_id);

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
    void leave();
    /// Of the first of these markers whose scan is open.
    void drawFinding(const QString& finding, const QStringList& markers);
    /// Adds what this reader's work says.
    void addSeen(KnownStudy& known) const;
    void confirmSigning();
    void askWhyAmend();
    void preview(const QByteArray& pdf);

    ReportBooks books_;
    ReportForm* form_;
    QDockWidget* dock_ = nullptr;
    bool has_report_ = true;
    QElapsedTimer reading_time_;  ///< since the case was opened
    QTimer delivery_;             ///< while the form is there: what the PACS has
    std::string shown_marker_;    ///< the one that was gone to last
};

}  // namespace vicon::viewer
