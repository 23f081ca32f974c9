#include "report/report_tool.h"

#include <QApplication>
#include <QClipboard>
#include <QDockWidget>
#include <QFontInfo>
#include <QInputDialog>
#include <QMainWindow>
#include <QMessageBox>
#include <QPushButton>
#include <utility>

#include "coverage/coverage_tool.h"
#include "reading/reading.h"
#include "reading_time/reading_time_tool.h"
#include "report/findings_part.h"
#include "report/report_form.h"
#include "report/report_preview.h"
#include "vicon/cases/printed.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

ReportTool::ReportTool(Reading& reading, const ReadingServices& services, const std::string& case_id,
                       CoverageTool& coverage, const ReadingTimeTool& time)
    : ReadingTool(reading),
      coverage_(coverage),
      time_(time),
      books_(services, case_id, this),
      form_(new ReportForm(services.reporting.texts))
{
    constexpr int kLookAtDelivery_ms = 1000;
    delivery_.setInterval(kLookAtDelivery_ms);
    connect(&delivery_, &QTimer::timeout, this, [this] {
        if (dock_->isVisible())
            books_.lookAtDelivery();
    });
    connect(&coverage_, &CoverageTool::summedUp, this, &ReportTool::workKnown);
}

void ReportTool::whenWorkIsKnown(UseWork use)
{
    waiting_.push_back(std::move(use));
    coverage_.sumUp();
}

void ReportTool::workKnown(const std::vector<ReviewedScan>& scans)
{
    const ReaderWork work = readerWork(scans, time_.caseRead_s());
    form_->setMissed(work.missed);
    for (const UseWork& use : std::exchange(waiting_, {}))
        use(work);
}

void ReportTool::addTo(ReadingLayout& layout)
{
    dock_ = layout.addForm(form_, tr("Report"));
    layout.addAction(ReadingMenu::a_case, tr("Report: findings, categories, signature"), QKeySequence("Ctrl+R"),
                     [this] { toggle(); });
    layout.addAction(ReadingMenu::a_case, tr("Write report (again: cancel)"), QKeySequence("Ctrl+P"), [this] {
        if (!reading_.session().giveUpReport()) {
            reading_.say(tr("Writing the report ..."));
            reading_.session().writeReport();
        }
    });
    connect(&reading_.session(), &CaseSession::reportWritten, this,
            [this](const QString& file) { reading_.say(tr("Report written: %1").arg(file)); });
    connectBooks();
    connectForm();
    delivery_.start();
}

void ReportTool::connectBooks()
{
    connect(&books_, &ReportBooks::shown, form_, &ReportForm::show);
    connect(&books_, &ReportBooks::deliveryLookedAt, form_, &ReportForm::setDelivery);
    connect(&books_, &ReportBooks::makingChanged, form_, &ReportForm::setMaking);
    connect(&books_, &ReportBooks::busyChanged, form_, &ReportForm::setBusy);
    connect(&books_, &ReportBooks::said, &reading_, &Reading::say);
    connect(&books_, &ReportBooks::warned, &reading_, &Reading::warn);
    connect(&books_, &ReportBooks::pdfMade, this, &ReportTool::preview);
    connect(&books_, &ReportBooks::textMade, this, [this](const QString& text) {
        QApplication::clipboard()->setText(text);
        reading_.say(tr("The report is on the clipboard, as text"));
    });
}

void ReportTool::connectForm()
{
    connect(form_, &ReportForm::said, &books_, &ReportBooks::say);
    connect(form_, &ReportForm::textWanted, &books_, &ReportBooks::makeText);
    connect(form_, &ReportForm::previewWanted, this, &ReportTool::makePages);
    connect(form_, &ReportForm::knownWanted, this,
            [this] { whenWorkIsKnown([this](const ReaderWork& work) { form_->fillKnown(work); }); });
    connect(form_, &ReportForm::normalWanted, this,
            [this] { whenWorkIsKnown([this](const ReaderWork& work) { form_->fillNormal(work); }); });
    connect(form_, &ReportForm::signWanted, this, [this] {
        if (books_.making() == ReportBooks::Making::signature) {
            books_.giveUpSigning();
            return;
        }
        form_->commit();
        whenWorkIsKnown([this](const ReaderWork& work) { confirmSigning(work); });
    });
    connect(form_, &ReportForm::amendWanted, this, &ReportTool::askWhyAmend);
    connect(form_, &ReportForm::cancelWanted, &books_, &ReportBooks::cancelAmendment);
    connect(form_, &ReportForm::leaveWanted, this, &ReportTool::leave);
    FindingsPart* findings = form_->findings();
    connect(findings, &FindingsPart::changed, &books_, &ReportBooks::changeFinding);
    connect(findings, &FindingsPart::addWanted, &books_, &ReportBooks::addFindings);
    connect(findings, &FindingsPart::removeWanted, &books_, &ReportBooks::removeFinding);
    connect(findings, &FindingsPart::joinWanted, this, [this](const std::string& finding) {
        if (shown_marker_.empty())
            reading_.say(tr("Go to the marker first, in the list of markers"));
        else
            books_.join(finding, {shown_marker_});
    });
    connect(findings, &FindingsPart::pictureWanted, this, &ReportTool::drawFinding);
    connect(&reading_.drawing(), &DrawingThread::findingDrawn, this,
            [this](const QString& which, const Picture& drawn) {
                form_->findings()->showPicture(
                    which,
                    QImage(drawn.rgb.data(), drawn.width, drawn.height, 3 * drawn.width, QImage::Format_RGB888).copy());
            });
    connect(findings, &FindingsPart::flyWanted, this, [this](const QString& id) {
        if (const auto marker = reading_.session().marker(id.toStdString()))
            reading_.showMarker(*marker);
    });
}

void ReportTool::useWords(const OrganWords& words)
{
    has_report_ = words.organ.isColon();
    if (!has_report_)
        dock_->hide();
}

void ReportTool::scanOpened(const Arrival&)
{
    form_->findings()->askForPicture();
}

void ReportTool::markersChanged()
{
    if (dock_->isVisible())
        books_.refresh();
}

void ReportTool::markerShown(const Marker& marker)
{
    shown_marker_ = marker.id;
}

void ReportTool::stop()
{
    delivery_.stop();
    form_->commit();
}

void ReportTool::toggle()
{
    if (!has_report_) {
        reading_.say(tr("There is a report of a colon only."));
        return;
    }
    if (dock_->isVisible() && form_->isAncestorOf(QApplication::focusWidget())) {
        leave();
        width_px_ = dock_->width();
        dock_->hide();
        return;
    }
    dock_->show();
    takeWidth();
    books_.refresh();
    coverage_.sumUp();
    form_->takeKeyboard();
}

/// As the reader left it; else its fields need not be long. Not as wide as what was beside the views before.
void ReportTool::takeWidth()
{
    constexpr int kUsual_px = 480, kPartOfWindow = 4;  // a quarter of a large window
    auto* window = qobject_cast<QMainWindow*>(dock_->parentWidget());
    const int usual_px = window->width() / kPartOfWindow < kUsual_px ? form_->minimumSizeHint().width() : kUsual_px;
    if (!dock_->isFloating())
        window->resizeDocks({dock_}, {width_px_ > 0 ? width_px_ : usual_px}, Qt::Horizontal);
}

void ReportTool::leave()
{
    form_->commit();
    reading_.views().first()->setFocus();
}

void ReportTool::drawFinding(const QString& which, const std::vector<Marker>& markers)
{
    constexpr int kSide_px = 360;
    const CaseSession& session = reading_.session();
    for (const Marker& marker : markers)
        for (const auto& scan : {session.sharedScan(), session.sharedBeside()}) {
            if (!scan || marker.scan_id != scan->record.id)
                continue;
            const ViewPose view = viewOfMarker(*scan, marker);
            NavigationState at;
            at.pose = view.pose;
            at.station_mm = view.station_mm;
            at.clearance_mm = view.clearance_mm;
            EndoscopicRequest request = reading_.requestFor(*scan, at, QSize(kSide_px, kSide_px), true);
            request.snapshot.captioned = false;  // it is small, and the form is this patient's
            constexpr double kShrunk = double(FindingsPart::kPicture_px) / kSide_px;
            request.snapshot.text_px = QFontInfo(form_->font()).pixelSize() / kShrunk;
            request.snapshot.markers = {marker};
            request.snapshot.priors.clear();
            request.snapshot.peel.preset.clear();
            reading_.drawing().drawFinding(scan, request, which);
            return;
        }
}

void ReportTool::confirmSigning(const ReaderWork& work)
{
    constexpr const char* kName = "confirmSigning";
    if (form_->window()->findChild<QMessageBox*>(kName))
        return;  // it was pressed twice
    const QString question = work.complete ? form_->summary() : form_->summary() + tr("\nSign it all the same?");
    auto* box =
        new QMessageBox(QMessageBox::Question, tr("Sign the report"), question, QMessageBox::Cancel, form_->window());
    box->setObjectName(kName);
    box->setAttribute(Qt::WA_DeleteOnClose);
    QPushButton* sign = box->addButton(tr("Sign"), QMessageBox::AcceptRole);
    sign->setObjectName("confirmSign");
    box->setDefaultButton(sign);
    connect(sign, &QPushButton::clicked, this, [this] {
        reading_.say(tr("Signing ..."));
        books_.sign();
    });
    box->open();
}

void ReportTool::askWhyAmend()
{
    auto* ask = new QInputDialog(form_->window());
    ask->setObjectName("whyAmend");
    ask->setAttribute(Qt::WA_DeleteOnClose);
    ask->setWindowTitle(tr("Amend the report"));
    ask->setLabelText(tr("Why is it amended? The signed version stays, and the new one refers to it."));
    connect(ask, &QInputDialog::textValueSelected, &books_, &ReportBooks::amend);
    ask->open();
}

void ReportTool::makePages()
{
    if (books_.making() == ReportBooks::Making::pages) {
        books_.giveUpPdf();
        return;
    }
    reading_.say(tr("Drawing the pages ..."));
    books_.makePdf();
}

void ReportTool::preview(const QByteArray& pdf)
{
    auto* pages = new ReportPreview(pdf, form_->window());
    pages->show();
    reading_.say({});
}

}  // namespace vicon::viewer
