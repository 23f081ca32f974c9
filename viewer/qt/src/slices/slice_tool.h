#pragma once

#include <QString>

#include "reading/reading_tool.h"

class QComboBox;

namespace vicon::viewer {

/// How the slices show densities, and that they show all of the scan again.
class SliceTool : public ReadingTool {
    Q_OBJECT
public:
    explicit SliceTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void restore() override;
    QVariantMap kept() const override;
    void useWords(const OrganWords& words) override;
    void scanOpened(const Arrival&) override { kept_window_.clear(); }

private:
    QComboBox* window_;    // and level
    QString kept_window_;  // of the last reading, until the scan and with it the organ are known
};

}  // namespace vicon::viewer
