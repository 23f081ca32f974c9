#include "priors/prior_panel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <utility>

#include "vicon/cases/printed.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

enum PriorColumn { kPriorWhen, kPriorWhat, kPriorSize, kPriorSite, kPriorToday, kPriorColumns };
constexpr int kLeastPriors = 3;

QString siteOf(const PriorFinding& finding)
{
    const PriorSight* lead = finding.lead();
    return QString::fromStdString(!lead ? "" : lead->part ? nameOf(*lead->part) : lead->site);
}

}  // namespace

PriorPanel::PriorPanel(QWidget* parent) : QWidget(parent)
{
    build();
    for (const auto chosen : {&QTableWidget::cellClicked, &QTableWidget::cellActivated})
        connect(table_, chosen, this, [this](int row, int) {
            if (row < int(rows_.size()) && rows_[std::size_t(row)].finding)
                emit flyWanted(rows_[std::size_t(row)].report, *rows_[std::size_t(row)].finding);
        });
    connect(table_, &QTableWidget::itemSelectionChanged, this, &PriorPanel::choose);
    connect(findings_, qOverload<int>(&QComboBox::activated), this, [this] { allow(); });
    for (const bool confirmed : {true, false})
        connect(confirmed ? confirm_ : reject_, &QPushButton::clicked, this, [this, confirmed] {
            if (const auto row = chosen(); row && row->finding)
                emit confirmWanted(today(), row->report, *row->finding, confirmed);
        });
    connect(take_back_, &QPushButton::clicked, this, [this] {
        if (const auto row = chosen(); row && row->finding)
            emit takeBackWanted(today(), row->report, *row->finding);
    });
}

void PriorPanel::build()
{
    const auto named = [](auto* widget, const char* name, const QString& title, const QString& tip) {
        widget->setObjectName(name);
        widget->setAccessibleName(title);
        widget->setToolTip(tip);
        return widget;
    };
    table_ = named(new QTableWidget(0, kPriorColumns, this), "priors", tr("Earlier reports"),
                   tr("Click or Return: fly to where it should lie today"));
    table_->setHorizontalHeaderLabels({tr("When"), tr("What"), tr("mm"), tr("Site"), tr("Today")});
    setUpList(table_, kLeastPriors);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    findings_ = named(new QComboBox(this), "priorToday", tr("Today's finding"),
                      tr("Which of today's findings is meant; those within the window come first"));
    confirm_ = named(new QPushButton(tr("Same"), this), "priorConfirm", tr("Confirm"),
                     tr("They are one thing: the report compares them"));
    reject_ = named(new QPushButton(tr("Not the same"), this), "priorReject", tr("Reject"), tr("They are two things"));
    take_back_ = named(new QPushButton(tr("Take back"), this), "priorTakeBack", tr("Take back"),
                       tr("Forget what was said of these two"));
    words_ = named(new QLabel(this), "priorWords", tr("Comparison"), {});
    words_->setWordWrap(true);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    grid->addWidget(table_, 0, 0, 1, 4);
    grid->addWidget(findings_, 1, 0);
    grid->addWidget(confirm_, 1, 1);
    grid->addWidget(reject_, 1, 2);
    grid->addWidget(take_back_, 1, 3);
    grid->addWidget(words_, 2, 0, 1, 4);
}

void PriorPanel::fillRow(int row, const QStringList& cells)
{
    for (int column = 0; column < kPriorColumns; ++column)
        table_->setItem(row, column, new QTableWidgetItem(cells.value(column)));
}

void PriorPanel::show(const PriorPage& page)
{
    const auto before = chosenUids();
    page_ = page;
    rows_.clear();
    for (std::size_t r = 0; r < page.list.reports.size(); ++r) {
        const std::size_t findings = page.list.reports[r].findings.size();
        for (std::size_t f = 0; f < findings; ++f)
            rows_.push_back({r, f});
        if (findings == 0)
            rows_.push_back({r, {}});
    }
    const QSignalBlocker filling(table_);  // until the chosen line is chosen again
    table_->setRowCount(int(rows_.size()));
    for (std::size_t n = 0; n < rows_.size(); ++n) {
        const PriorReport& report = page.list.reports[rows_[n].report];
        const QString when = QString::fromStdString(report.when().empty() ? "?" : printedDate(report.when()));
        if (!rows_[n].finding) {
            fillRow(int(n), {when, tr("no findings")});
            continue;
        }
        const PriorFinding& finding = report.findings[*rows_[n].finding];
        fillRow(int(n), {when, QString::fromStdString(finding.kind ? nameOf(*finding.kind) : finding.what),
                         finding.size_mm ? QString::number(*finding.size_mm, 'f', 1) : QString(), siteOf(finding),
                         todayOf(rows_[n])});
        table_->item(int(n), kPriorWhen)->setToolTip(QString::fromStdString(inBrief(report)));
    }
    table_->clearSelection();  // where the chosen finding is gone, another one is in its row
    for (std::size_t n = 0; before && n < rows_.size(); ++n)
        if (uidsOf(rows_[n]) == *before)
            table_->selectRow(int(n));
    choose();
}

PriorPanel::Uids PriorPanel::uidsOf(const Row& row) const
{
    const PriorReport& report = page_.list.reports[row.report];
    return {report.sop_uid, row.finding ? report.findings[*row.finding].uid : std::string()};
}

std::optional<PriorPanel::Uids> PriorPanel::chosenUids() const
{
    const auto row = chosen();
    return row ? std::optional(uidsOf(*row)) : std::nullopt;
}

QString PriorPanel::todayOf(const Row& row) const
{
    const PriorMatch& match = page_.matches[row.report][*row.finding];
    QStringList out;
    for (const ComparedFinding* one : saidOf(row))
        out << (one->said.confirmed ? tr("%1, confirmed") : tr("not %1")).arg(one->said.finding_id.c_str());
    if (!out.empty())
        return out.join("; ");
    for (const PriorCandidate& candidate : match.candidates)
        out << candidate.finding_id.c_str();
    if (out.empty())
        return tr("none near");
    return (match.alone ? tr("%1?") : tr("one of %1?")).arg(out.join(", "));
}

std::optional<PriorPanel::Row> PriorPanel::chosen() const
{
    const auto rows = table_->selectionModel()->selectedRows();
    if (rows.empty() || rows.front().row() >= int(rows_.size()))
        return std::nullopt;
    return rows_[std::size_t(rows.front().row())];
}

std::string PriorPanel::today() const
{
    return findings_->currentData().toString().toStdString();
}

void PriorPanel::choose()
{
    const auto row = chosen();
    QStringList words;
    fillFindings();
    if (row && row->finding)
        for (const ComparedFinding* one : saidOf(*row))
            if (one->said.confirmed)
                words << QString::fromStdString(growthWords(one->growth));
    if (rows_.empty())
        words << tr("No earlier report of this patient; 'vicon retrieve PEER STUDY --reports' fetches one.");
    for (const std::string& line : page_.list.left_out)
        words << QString::fromStdString(line);
    if (row)
        for (const std::string& line : page_.list.reports[row->report].not_read)
            words << tr("not read of it: %1").arg(line.c_str());
    words_->setText(words.join("\n"));
    allow();
}

void PriorPanel::allow()
{
    const auto row = chosen();
    const bool can = row && row->finding && page_.open && !page_.read.findings.empty();
    findings_->setEnabled(can);
    const bool names_one = can && findings_->currentIndex() >= 0;
    for (QPushButton* button : {confirm_, reject_})
        button->setEnabled(names_one);
    take_back_->setEnabled(names_one && !saidOf(*row).empty());
}

std::vector<const ComparedFinding*> PriorPanel::saidOf(const Row& row) const
{
    const PriorMatch& match = page_.matches[row.report][*row.finding];
    return page_.saidOf(match.report_uid, match.prior_uid);
}

/// The one that was spoken of, then those within the window, then the others. What stood there for this line stays;
/// where it is gone, nothing is there: another one is not taken for it.
void PriorPanel::fillFindings()
{
    const QVariant before = findings_->currentData();
    const bool stays = std::exchange(filled_for_, chosenUids()) == chosenUids() && findings_->count() > 0;
    findings_->clear();
    const auto row = chosen();
    if (!row || !row->finding)
        return;
    QStringList ids;
    for (const ComparedFinding* one : saidOf(*row))
        ids << one->said.finding_id.c_str();
    for (const PriorCandidate& candidate : page_.matches[row->report][*row->finding].candidates)
        ids << candidate.finding_id.c_str();
    for (const FindingWithFacts& one : page_.read.findings)
        ids << one.finding.id.c_str();
    ids.removeDuplicates();
    for (const QString& id : ids)
        findings_->addItem(tr("Finding %1").arg(id), id);
    if (stays)
        findings_->setCurrentIndex(before.isValid() ? findings_->findData(before) : -1);
}

}  // namespace vicon::viewer
