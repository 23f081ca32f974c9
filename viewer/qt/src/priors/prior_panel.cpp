#include "priors/prior_panel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>

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
    const int before = table_->currentRow();
    page_ = page;
    rows_.clear();
    for (std::size_t r = 0; r < page.list.reports.size(); ++r) {
        const std::size_t findings = page.list.reports[r].findings.size();
        for (std::size_t f = 0; f < findings; ++f)
            rows_.push_back({r, f});
        if (findings == 0)
            rows_.push_back({r, {}});
    }
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
    if (before >= 0 && before < table_->rowCount())
        table_->setCurrentCell(before, 0);
    choose();
}

QString PriorPanel::todayOf(const Row& row) const
{
    const PriorMatch& match = page_.matches[row.report][*row.finding];
    QStringList out;
    for (const ComparedFinding* one : page_.saidOf(match.report_uid, match.prior_uid))
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
    const int row = table_->currentRow();
    return row >= 0 && row < int(rows_.size()) ? std::optional(rows_[std::size_t(row)]) : std::nullopt;
}

std::string PriorPanel::today() const
{
    return findings_->currentData().toString().toStdString();
}

void PriorPanel::choose()
{
    const auto row = chosen();
    QStringList words;
    findings_->clear();
    const bool can = row && row->finding && page_.open && !page_.read.findings.empty();
    if (row && row->finding) {
        const PriorMatch& match = page_.matches[row->report][*row->finding];
        const auto said = page_.saidOf(match.report_uid, match.prior_uid);
        fillFindings(match, said);
        for (const ComparedFinding* one : said)
            if (one->said.confirmed)
                words << QString::fromStdString(growthWords(one->growth));
        take_back_->setEnabled(can && !said.empty());
    } else {
        take_back_->setEnabled(false);
    }
    if (rows_.empty())
        words << tr("No earlier report of this patient; 'vicon retrieve PEER STUDY --reports' fetches one.");
    for (const std::string& line : page_.list.left_out)
        words << QString::fromStdString(line);
    if (row)
        for (const std::string& line : page_.list.reports[row->report].not_read)
            words << tr("not read of it: %1").arg(line.c_str());
    words_->setText(words.join("\n"));
    for (QPushButton* button : {confirm_, reject_})
        button->setEnabled(can);
    findings_->setEnabled(can);
}

/// The one that was spoken of, then those within the window, then the others.
void PriorPanel::fillFindings(const PriorMatch& match, const std::vector<const ComparedFinding*>& said)
{
    QStringList ids;
    for (const ComparedFinding* one : said)
        ids << one->said.finding_id.c_str();
    for (const PriorCandidate& candidate : match.candidates)
        ids << candidate.finding_id.c_str();
    for (const FindingWithFacts& one : page_.read.findings)
        ids << one.finding.id.c_str();
    ids.removeDuplicates();
    for (const QString& id : ids)
        findings_->addItem(tr("Finding %1").arg(id), id);
}

}  // namespace vicon::viewer
