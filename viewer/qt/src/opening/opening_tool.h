#pragma once

#include "reading/reading_tool.h"
#include "vicon/cases/worklist.h"

class QComboBox;
class QProgressBar;

namespace vicon::viewer {

/// Which scan of the case is read: offers those that can be, opens them, and says how far it is.
class OpeningTool : public ReadingTool {
    Q_OBJECT
public:
    explicit OpeningTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    QVariantMap kept() const override;
    void scanOpened(const Arrival& arrival) override;

    /// The scan that was read last, where it is among those that can be read.
    void openFirst();
    /// As the worklist shows the case by now: scans that became ready are offered, one that was done again for another
    /// reader is shown anew.
    void renew(const WorklistCase& row);

signals:
    void closeWanted();

private:
    void open(const ScanRequest& request);
    void offer(const std::vector<ScanRecord>& scans);
    void takeOver(const WorklistScan& row);
    void takeOverBeside(const WorklistScan& row);
    void stayHere();
    void cancel();
    void openOther();
    void showChoice();

    QComboBox* choice_;
    QWidget* progress_;
    QProgressBar* bar_;
    ScanOpening opening_;
    std::string beside_in_work_;  // elsewhere
};

}  // namespace vicon::viewer
