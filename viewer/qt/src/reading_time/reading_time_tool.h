#pragma once

#include <QElapsedTimer>
#include <QTimer>

#include "reading/reading_tool.h"

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

protected:
    bool eventFilter(QObject* object, QEvent* event) override;

private:
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
    double read_s_ = 0, slices_first_s_ = 0;
};

}  // namespace vicon::viewer
