#include "report/report_form.h"

#include <QGridLayout>
#include <QGroupBox>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "report/category_part.h"
#include "report/distension_part.h"
#include "report/extracolonic_part.h"
#include "report/findings_part.h"
#include "report/study_part.h"
#include "vicon/cases/printed.h"
#include "widgets/controls_area.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

template <class Category>
CategoryPart::State stateOf(const Proposal<Category>& proposal, const std::optional<Chosen<Category>>& chosen)
{
    CategoryPart::State state;
    state.reason = proposal.reason;
    if (proposal.category)
        state.proposed = nameOf(*proposal.category);
    if (chosen) {
        state.chosen = nameOf(chosen->category);
        state.why = chosen->why;
    }
    return state;
}

template <class Category>
void accept(std::optional<Chosen<Category>>& chosen, const Proposal<Category>& proposal)
{
    if (proposal.category && (!chosen || chosen->category != *proposal.category))
        chosen = {*proposal.category, "", proposal.category};
}

std::vector<std::string> colonNames()
{
    std::vector<std::string> names;
    for (const auto category : {ColonCategory::c0, ColonCategory::c1, ColonCategory::c2a, ColonCategory::c2b,
                                ColonCategory::c3, ColonCategory::c4})
        names.push_back(nameOf(category));
    return names;
}

std::vector<std::string> outsideNames()
{
    std::vector<std::string> names;
    for (const auto category :
         {ExtracolonicCategory::e0, ExtracolonicCategory::e1, ExtracolonicCategory::e3, ExtracolonicCategory::e4})
        names.push_back(nameOf(category));
    return names;
}

}  // namespace

ReportForm::ReportForm(const ReportTexts& texts, QWidget* parent) : QWidget(parent), texts_(texts)
{
    setObjectName("reportForm");
    build();
    connectParts();
}

void ReportForm::build()
{
    auto* all = new QVBoxLayout(this);
    state_ = new QLabel(this);
    state_->setObjectName("reportState");
    state_->setWordWrap(true);
    all->addWidget(state_);
    all->addWidget(buildScrolled(), 1);
    missed_ = new QLabel(this);
    missed_->setObjectName("reportMissed");
    missed_->setWordWrap(true);
    missed_->setToolTip(tr("Regions of the wall that you did not review; F3 leads from one to the next"));
    missed_->hide();
    all->addWidget(missed_);
    missing_ = new QLabel(this);
    missing_->setObjectName("reportMissing");
    missing_->setWordWrap(true);
    missing_->setStyleSheet("color: #ff9a4a;");
    all->addWidget(missing_);
    buildButtons(all);
}

QWidget* ReportForm::buildScrolled()
{
    auto* inside = new QWidget;
    auto* area = new ControlsArea(inside);  // never narrower than what it holds
    auto* column = new QVBoxLayout(inside);
    const auto group = [&](const QString& title, std::initializer_list<QWidget*> parts) {
        auto* box = new QGroupBox(title, inside);
        auto* rows = new QVBoxLayout(box);
        for (QWidget* part : parts)
            rows->addWidget(part);
        column->addWidget(box);
    };
    findings_ = new FindingsPart(inside);
    extracolonic_ = new ExtracolonicPart(inside);
    colon_ = new CategoryPart("colonCategory", tr("Colon"), colonNames(), inside);
    outside_ = new CategoryPart("outsideCategory", tr("Outside it"), outsideNames(), inside);
    study_ = new StudyPart(inside);
    distension_ = new DistensionPart(inside);
    group(tr("Findings"), {findings_});
    group(tr("Outside the colon"), {extracolonic_});
    group(tr("C-RADS"), {colon_, outside_});
    group(tr("Study"), {study_});
    group(tr("Distension"), {distension_});
    column->addStretch(1);
    return area;
}

void ReportForm::buildButtons(QVBoxLayout* below)
{
    auto* grid = new QGridLayout;
    const auto add = [&](int row, int column, const char* name, const QString& title, const QString& tip) {
        auto* button = new QPushButton(title, this);
        button->setObjectName(name);
        button->setToolTip(tip);
        grid->addWidget(button, row, column);
        return button;
    };
    fill_ = add(0, 0, "reportFill", tr("F&ill in"),
                tr("Indication, technique, dose, coverage and reading time, where nothing was said yet"));
    normal_ = add(0, 1, "reportNormal", tr("Norma&l study"), {});
    accept_ = add(0, 2, "reportAccept", tr("&Accept categories"), tr("Choose both categories as proposed"));
    cancel_ = add(2, 2, "reportCancel", tr("Take back"), tr("Without the amendment: all as it was signed"));
    preview_ = add(1, 0, "reportPreview", tr("&Preview"), tr("The pages as they are printed"));
    text_ = add(1, 1, "reportCopy", tr("Copy as &text"), tr("For another system, by pasting"));
    // Never both at once.
    sign_ = add(1, 2, "reportSign", tr("Si&gn ..."), tr("After that the report can only be amended"));
    amend_ = add(1, 2, "reportAmend", tr("Amen&d ..."), tr("Open the signed report again; it stays as it is"));
    below->addLayout(grid);
}

void ReportForm::connectParts()
{
    connect(extracolonic_, &ExtracolonicPart::said, this, &ReportForm::said);
    connect(study_, &StudyPart::said, this, &ReportForm::said);
    connect(distension_, &DistensionPart::said, this, &ReportForm::said);
    connect(colon_, &CategoryPart::chosen, this,
            [this](const std::optional<std::string>& name, const std::string& why) {
                emit said([name, why, proposed = page_.read.colon_proposal.category](Assessment& a) {
                    a.colon_category.reset();
                    if (name)
                        a.colon_category = {colonCategoryFrom(*name), why, proposed};
                });
            });
    connect(outside_, &CategoryPart::chosen, this,
            [this](const std::optional<std::string>& name, const std::string& why) {
                emit said([name, why, proposed = page_.read.extracolonic_proposal.category](Assessment& a) {
                    a.extracolonic_category.reset();
                    if (name)
                        a.extracolonic_category = {extracolonicCategoryFrom(*name), why, proposed};
                });
            });
    connect(fill_, &QPushButton::clicked, this, &ReportForm::knownWanted);
    connect(normal_, &QPushButton::clicked, this, &ReportForm::normalWanted);
    connect(accept_, &QPushButton::clicked, this,
            [this] { emit said([this, read = page_.read](Assessment& a) { acceptCategories(a, read); }); });
    connect(preview_, &QPushButton::clicked, this, &ReportForm::previewWanted);
    connect(text_, &QPushButton::clicked, this, &ReportForm::textWanted);
    connect(sign_, &QPushButton::clicked, this, &ReportForm::signWanted);
    connect(amend_, &QPushButton::clicked, this, &ReportForm::amendWanted);
    connect(cancel_, &QPushButton::clicked, this, &ReportForm::cancelWanted);
}

void ReportForm::acceptCategories(Assessment& said, const ReadCase& read) const
{
    accept(said.colon_category, read.colon_proposal);
    accept(said.extracolonic_category, read.extracolonic_proposal);
}

KnownStudy ReportForm::knownWith(const ReaderWork& work) const
{
    KnownStudy known = page_.known;
    known.reading_minutes = work.minutes;
    known.coverage_percent = work.coverage_percent;
    return known;
}

void ReportForm::fillKnown(const ReaderWork& work)
{
    emit said([known = knownWith(work)](Assessment& a) { fillIn(a, known); });
}

void ReportForm::fillNormal(const ReaderWork& work)
{
    emit said([this, read = page_.read, known = knownWith(work)](Assessment& a) {
        fillAsNormal(a, texts_);  // the site's words go before those of the images
        fillIn(a, known);
        acceptCategories(a, read);
    });
}

void ReportForm::show(const ReportPage& page)
{
    page_ = page;
    findings_->show(page.read);
    extracolonic_->show(page.read);
    study_->show(page.read, page.known);
    distension_->show(page.read);
    orderTabs();
    colon_->show(stateOf(page.read.colon_proposal, page.read.assessment.colon_category));
    outside_->show(stateOf(page.read.extracolonic_proposal, page.read.assessment.extracolonic_category));
    showState(page);
}

// Some controls come with the scans.
void ReportForm::orderTabs()
{
    const std::vector<QWidget*> order = reachableIn(this);
    for (std::size_t n = 1; n < order.size(); ++n)
        QWidget::setTabOrder(order[n - 1], order[n]);
}

void ReportForm::showState(const ReportPage& page)
{
    const bool open = page.status.open();
    if (!open && hasKeyboard() && !qobject_cast<QPushButton*>(window()->focusWidget()))
        setFocus();  // its controls are disabled
    QString state = tr("Report: %1").arg(QString::fromStdString(textOf(page.status)));
    if (!page.delivery.empty())
        state += tr("; PACS: %1").arg(QString::fromStdString(page.delivery));
    state_->setText(state);
    QStringList missing;
    for (const std::string& line : page.missing)
        missing << QString::fromStdString(line);
    missing_->setText(tr("Before it can be signed: %1").arg(missing.join("; ")));
    missing_->setVisible(open && !missing.empty());
    findings_->setReadOnly(!open);
    for (QWidget* part : std::initializer_list<QWidget*>{extracolonic_, colon_, outside_, study_, distension_})
        part->setEnabled(open);
    for (QPushButton* button : {fill_, normal_, accept_, sign_})
        button->setVisible(open);
    amend_->setVisible(!open);
    cancel_->setVisible(page.status.amending);
    const bool normal = page.read.findings.empty() && page.read.colon_proposal.category == ColonCategory::c1;
    normal_->setEnabled(!busy_ && normal);
    normal_->setToolTip(normal ? tr("Fill in what the site says of a study without findings, and choose both "
                                    "categories as proposed")
                               : QString::fromStdString(page.read.colon_proposal.reason));
    fill_->setEnabled(!busy_);
    accept_->setEnabled(!busy_ && (page.read.colon_proposal.category || page.read.extracolonic_proposal.category));
    sign_->setEnabled(making_ == ReportBooks::Making::signature || (!busy_ && missing.empty()));
}

void ReportForm::setMaking(ReportBooks::Making what)
{
    using Making = ReportBooks::Making;
    making_ = what;
    preview_->setText(what == Making::pages ? tr("Sto&p") : tr("&Preview"));
    preview_->setEnabled(!busy_ || what == Making::pages);
    sign_->setText(what == Making::signature ? tr("Stop si&gning") : tr("Si&gn ..."));
    if (!page_.read.record.id.empty())
        showState(page_);
}

void ReportForm::setBusy(bool busy)
{
    busy_ = busy;
    // What is pressed is disabled while it acts: the next control that is not would be the choice of the scan.
    if (auto* pressed = qobject_cast<QPushButton*>(window()->focusWidget());
        busy && pressed && hasKeyboard() && pressed != preview_) {
        pressed_ = pressed;
        setFocus();
    }
    preview_->setEnabled(!busy || making_ == ReportBooks::Making::pages);
    for (QPushButton* button : {text_, amend_, cancel_})
        button->setEnabled(!busy);
    if (!page_.read.record.id.empty())
        showState(page_);
    if (busy)
        return;
    if (pressed_ && hasFocus() && pressed_->isEnabled() && pressed_->isVisible())
        pressed_->setFocus();
    pressed_ = nullptr;
}

void ReportForm::setMissed(const QString& words)
{
    missed_->setText(words);
    missed_->setVisible(!words.isEmpty());
}

void ReportForm::setDelivery(const QString& brief)
{
    if (page_.read.record.id.empty() || brief.toStdString() == page_.delivery)
        return;
    page_.delivery = brief.toStdString();
    showState(page_);
}

void ReportForm::commit()
{
    if (hasKeyboard())
        setFocus();
}

bool ReportForm::hasKeyboard() const
{
    return isAncestorOf(window()->focusWidget());
}

QString ReportForm::summary() const
{
    const Assessment& said = page_.read.assessment;
    const auto name = [](const auto& chosen) {
        return chosen ? QString::fromStdString(nameOf(chosen->category)) : QString();
    };
    const auto count = page_.read.findings.size();
    QStringList lines{QString::fromStdString(printedPatientName(page_.read.record.patient.name)),
                      tr("%1, colon %2, outside the colon %3.")
                          .arg(count == 1 ? tr("1 finding") : tr("%1 findings").arg(count), name(said.colon_category),
                               name(said.extracolonic_category))};
    QStringList loose;
    for (const std::string& marker : page_.read.loose_markers)
        loose << QString::fromStdString(marker);
    if (!loose.isEmpty())
        lines << tr("Markers not assigned to a finding: %1.").arg(loose.join(", "));
    if (!missed_->text().isEmpty())
        lines << QString() << missed_->text();
    lines << QString() << tr("After this it can only be amended.");
    return lines.join("\n");
}

void ReportForm::takeKeyboard()
{
    setFocus(Qt::TabFocusReason);
    focusNextChild();
}

bool ReportForm::event(QEvent* event)
{
    if (event->type() == QEvent::ShortcutOverride) {
        const auto& key = *static_cast<QKeyEvent*>(event);
        const bool with_others = key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
        const bool function_key = key.key() >= Qt::Key_F1 && key.key() <= Qt::Key_F35;
        if (!with_others && !function_key) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void ReportForm::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Escape)
        emit leaveWanted();
    // No key of the form's means anything to the window.
    event->accept();
}

}  // namespace vicon::viewer
