#pragma once

#include <QWidget>
#include <functional>

#include "report/reader_work.h"
#include "report/report_books.h"
#include "vicon/cases/report_texts.h"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace vicon::viewer {

class CategoryPart;
class DistensionPart;
class ExtracolonicPart;
class FindingsPart;
class StudyPart;

/// The report beside the views: what is known is filled in, what is not is said here, and here it is signed. Plain keys
/// are its own, not the window's, while it has the keyboard; Escape gives it back.
class ReportForm : public QWidget {
    Q_OBJECT
public:
    explicit ReportForm(const ReportTexts& texts, QWidget* parent = nullptr);

    void show(const ReportPage& page);
    void setBusy(bool busy);
    /// What takes long says so on its button, which gives it up.
    void setMaking(ReportBooks::Making what);
    /// How far the signed report is on its way to the PACS, as ReportPage has it.
    void setDelivery(const QString& brief);
    FindingsPart* findings() { return findings_; }
    /// Words that are still being typed are saved.
    void commit();
    /// What would be signed, in words.
    QString summary() const;
    /// What of the wall was missed, a line each scan; it is said before a signature, too.
    void setMissed(const QString& words);
    /// What is known of the study and of this reader's work, where nothing was said yet.
    void fillKnown(const ReaderWork& work);
    /// The same, what the site says of a study without findings, and the categories as proposed.
    void fillNormal(const ReaderWork& work);
    /// The keyboard goes to the first control.
    void takeKeyboard();

signals:
    void said(const std::function<void(vicon::Assessment&)>& change);
    void knownWanted();
    void normalWanted();
    void previewWanted();
    void textWanted();
    void signWanted();
    void amendWanted();
    void cancelWanted();
    void leaveWanted();

protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void build();
    QWidget* buildScrolled();
    void buildButtons(QVBoxLayout* below);
    void connectParts();
    void acceptCategories(Assessment& said, const ReadCase& read) const;
    KnownStudy knownWith(const ReaderWork& work) const;
    void orderTabs();
    void showState(const ReportPage& page);
    bool hasKeyboard() const;

    const ReportTexts texts_;
    ReportPage page_;
    bool busy_ = false;
    ReportBooks::Making making_ = ReportBooks::Making::nothing;
    QPushButton* pressed_ = nullptr;  ///< had the keyboard, and gets it back
    QLabel *state_, *missed_, *missing_;
    FindingsPart* findings_;
    ExtracolonicPart* extracolonic_;
    CategoryPart *colon_, *outside_;
    StudyPart* study_;
    DistensionPart* distension_;
    QPushButton *fill_, *normal_, *accept_, *preview_, *text_, *sign_, *amend_, *cancel_;
};

}  // namespace vicon::viewer
