#pragma once

#include <QElapsedTimer>
#include <QTimer>

#include "reading/reading_tool.h"
#include "vicon/viewer/model/reading_clock.h"

class QLabel;

namespace vicon::viewer {

class CoverageTool;

/// How long a scan is read: while its window is in front and the reader does something, or something flies. Kept in
/// the audit trail.
class ReadingTimeTool : public ReadingTool {
    Q_OBJECT
public:
    /// @param coverage must outlive it
    ReadingTimeTool(Reading& reading, const CoverageTool& coverage);

    void addTo(ReadingLayout& layout) override;
    void scanLeft() override;
    void scanOpened(const Arrival&) override;
    void scanStays() override { left_.reset(); }
    void placeShown() override { active_.start(); }
    void stop() override;

    /// How long all scans of the case have been read since its window was opened.
    double caseRead_s() const { return clock_.case_s(); }

protected:
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    bool isOfThisCase(const QWidget* widget) const;
    void tick();
    void writeLeft();

    /// Of a scan that was left, or is about to be.
    struct Read {
        std::string scan_id;
        QString words;
    };
    const CoverageTool& coverage_;
    QLabel* text_;
    QTimer timer_;
    QElapsedTimer active_, since_tick_;
    std::optional<Read> left_;
    ReadingClock clock_;
};

}  // namespace vicon::viewer
