#pragma once

#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "vicon/cases/report_content.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

class FormChoice;
class FormNumber;
class FormText;

/// The findings of a case: a list, a picture of the chosen one, and what is said of it.
class FindingsPart : public QWidget {
    Q_OBJECT
public:
    explicit FindingsPart(QWidget* parent);

    void show(const ReadCase& read);
    /// @param which as it was asked for
    void showPicture(const QString& which, const QImage& picture);
    /// pictureWanted() follows where a finding is chosen: a scan was opened that may show it.
    void askForPicture();
    static constexpr int kPicture_px = 180;  ///< how wide it is shown
    /// Words that are not saved yet.
    bool unsaved() const;
    /// Nothing can be changed; the list leads to places still.
    void setReadOnly(bool on);

signals:
    void flyWanted(const QString& marker);
    /// Of the chosen finding, which these markers show, the leading one first. @param which the finding, and what is
    ///        seen of its markers
    void pictureWanted(const QString& which, const std::vector<vicon::Marker>& markers);
    void changed(const std::string& finding, const std::function<void(vicon::Finding&)>& change);
    /// Each of these markers becomes a finding, with its partners.
    void addWanted(const std::vector<std::string>& markers);
    /// The marker that is chosen in its list is to show this finding as well.
    void joinWanted(const std::string& finding);
    void removeWanted(const std::string& finding);

private:
    void build();
    void buildEditor();
    void connectEditor();
    const FindingWithFacts* chosen() const;
    std::vector<Marker> markersOf(const FindingWithFacts& one) const;
    std::string pictureOf(const FindingWithFacts& one) const;
    void choose();
    void showChosen();
    void change(const std::function<void(Finding&)>& what);

    ReadCase read_;
    std::string chosen_, pictured_;
    bool filling_ = false;
    QTableWidget* table_;
    QLabel *loose_, *picture_, *facts_;
    QPushButton *add_, *join_, *remove_;
    QWidget* editor_;
    FormChoice *kind_, *morphology_, *attenuation_, *confidence_;
    FormNumber *size_, *height_;
    QCheckBox *narrows_, *invades_;
    FormText* note_;
};

}  // namespace vicon::viewer
