#pragma once

#include <QTimer>

#include "coverage/coverage_keeper.h"
#include "reading/reading_tool.h"

class QLabel;

namespace vicon::viewer {

class CoveragePanel;

/// How much of the wall this reader has seen, what not, and where; kept from session to session.
class CoverageTool : public ReadingTool {
    Q_OBJECT
public:
    explicit CoverageTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;
    void useWords(const OrganWords& words) override;
    void scanLeft() override { keep(); }
    void scanOpened(const Arrival&) override;
    void style(EndoscopicRequest& request) const override;
    void stop() override { keep_timer_.stop(); }

private:
    void connectPanel();
    void listUnseen();
    void showSeen();
    void keep();

    CoveragePanel* panel_;
    QLabel* seen_text_;
    CoverageKeeper keeper_{this};
    QTimer keep_timer_;
};

}  // namespace vicon::viewer
