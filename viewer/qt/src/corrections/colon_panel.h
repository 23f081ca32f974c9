#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/viewer/qt/reading_room.h"

class QLabel;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

/// What the pipeline took for the colon: its bridges, to be judged, and corrections by a click.
class ColonPanel : public QWidget {
    Q_OBJECT
public:
    explicit ColonPanel(QWidget* parent = nullptr);
    /// @param skeleton of the same scan
    void show(const std::vector<ReviewedBridge>& bridges, const Skeleton& skeleton);
    /// @param fraction below 0: nothing is under way
    void showProgress(const QString& what, double fraction);

signals:
    void flyWanted(vicon::Point3 point);
    void reviewed(const vicon::ReviewedBridge& bridge, bool confirmed);
    void correctionWanted(vicon::Correction kind);
    void forgetWanted();
    void stopWanted();

private:
    QPushButton* button(const QString& title, const char* name, const QString& tip);
    std::optional<ReviewedBridge> selected() const;
    void updateButtons();

    std::vector<ReviewedBridge> bridges_;
    QTableWidget* table_;
    QPushButton *confirm_, *reject_, *stop_;
    QLabel* state_;
    QProgressBar* bar_;
};

}  // namespace vicon::viewer
