#include "worklist/worklist_window.h"

#include <QCloseEvent>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QShortcut>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "guide/guide.h"
#include "widgets/kept_settings.h"
#include "window/reading_window.h"
#include "worklist/worklist_columns.h"
#include "worklist/worklist_hint.h"

namespace vicon::viewer {
namespace {

constexpr int kRefresh_ms = 2000;
constexpr QSize kFirstWorklistSize{1000, 500};
constexpr const char* kWorklistGeometry = "worklist/geometry";
constexpr int kPage = 100;  // lines; a table of 1,000 takes the window's thread longer to fill than a reader waits

QLabel* makeLabel(const char* name, QWidget* parent)
{
    auto* label = new QLabel(parent);
    label->setObjectName(name);
    label->setWordWrap(true);
    return label;
}

}  // namespace

WorklistWindow::WorklistWindow(const ReadingServices& services, const std::string& open_case)
    : services_(services), open_case_(open_case), books_(this, services.store)
{
    setObjectName("worklist");
    setWindowTitle(tr("VICON - worklist"));
    buildControls();
    layOut();
    connectControls();
    addKeys();
    timer_.setInterval(kRefresh_ms);
    connect(&timer_, &QTimer::timeout, this, &WorklistWindow::refresh);
    timer_.start();
    updateButtons();
    refresh();
}

void WorklistWindow::buildControls()
{
    search_ = new QLineEdit(this);
    search_->setObjectName("search");
    search_->setAccessibleName(tr("Search"));
    search_->setPlaceholderText(tr("Beginnings of name, ID, accession number or date (Ctrl+F)"));
    search_->setClearButtonEnabled(true);
    state_ = new QComboBox(this);
    state_->setObjectName("state");
    state_->setAccessibleName(tr("State of the cases shown"));
    state_->addItem(tr("all"));
    for (const WorkState state : {WorkState::done, WorkState::running, WorkState::queued, WorkState::failed})
        state_->addItem(QString::fromStdString(nameOf(state)), int(state));
    table_ = makeCaseTable(this);
    hint_ = makeLabel("hint", table_->viewport());
    hint_->setText(tr("Reading the worklist ..."));
    hint_->setAlignment(Qt::AlignCenter);
    hint_->setTextInteractionFlags(Qt::TextSelectableByMouse);  // commands are copied
    (new QVBoxLayout(table_->viewport()))->addWidget(hint_);
    reason_ = makeLabel("reason", this);
    message_ = makeLabel("message", this);
    message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    const auto button = [this](const QString& title, const char* name, const QString& tip) {
        auto* made = new QPushButton(title, this);
        made->setObjectName(name);
        made->setToolTip(tip);
        made->setAutoDefault(true);  // Return presses it as well
        return made;
    };
    open_ = button(tr("Open"), "open", tr("Read the case (Return)"));
    retry_ = button(tr("Retry"), "retry", tr("Put its failed jobs back into the queue"));
    report_ = button(tr("Report"), "report", tr("Write the report as PDF"));
    newer_ = button(tr("Newer"), "newer", tr("The page before"));
    older_ = button(tr("Older"), "older", tr("The next page"));
    page_ = makeLabel("page", this);
    page_->setWordWrap(false);
}

void WorklistWindow::layOut()
{
    auto* top = new QHBoxLayout;
    top->addWidget(search_, 1);
    top->addWidget(state_);
    for (QWidget* w : std::initializer_list<QWidget*>{page_, newer_, older_})
        top->addWidget(w);
    auto* bottom = new QHBoxLayout;
    bottom->addWidget(message_, 1);
    for (QPushButton* b : {retry_, report_, open_})
        bottom->addWidget(b);
    auto* column = new QVBoxLayout(this);
    column->addLayout(top);
    column->addWidget(table_, 1);
    column->addWidget(reason_);
    column->addLayout(bottom);
    if (!restoreGeometry(keptSetting(kWorklistGeometry).toByteArray()))
        resize(kFirstWorklistSize);
    QWidget* const order[] = {search_, state_, newer_, older_, table_, retry_, report_, open_};
    for (std::size_t n = 1; n < std::size(order); ++n)
        setTabOrder(order[n - 1], order[n]);
}

void WorklistWindow::connectControls()
{
    connect(search_, &QLineEdit::textChanged, this, [this] { turnTo({}); });
    connect(state_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] { turnTo({}); });
    connect(newer_, &QPushButton::clicked, this, [this] { turnTo({pages_.begin(), pages_.end() - 1}); });
    connect(older_, &QPushButton::clicked, this, [this] {
        auto pages = pages_;
        pages.push_back(rows_.back().record.id);
        turnTo(pages);
    });
    connect(table_, &QTableWidget::itemSelectionChanged, this, &WorklistWindow::updateButtons);
    connect(table_, &QTableWidget::itemActivated, this, &WorklistWindow::openSelected);
    connect(open_, &QPushButton::clicked, this, &WorklistWindow::openSelected);
    connect(search_, &QLineEdit::returnPressed, this, &WorklistWindow::openSelected);
    connect(retry_, &QPushButton::clicked, this, &WorklistWindow::retry);
    connect(report_, &QPushButton::clicked, this, &WorklistWindow::report);
    connect(books_.worker(), &Worker::failed, message_, &QLabel::setText);
}

void WorklistWindow::addKeys()
{
    for (const auto key : {Qt::Key_Escape, Qt::Key_Down})
        connect(new QShortcut(key, search_, {}, {}, Qt::WidgetShortcut), &QShortcut::activated, this,
                [this] { table_->setFocus(Qt::ShortcutFocusReason); });
    connect(new QShortcut(QKeySequence("Ctrl+F"), this), &QShortcut::activated, search_, [this] {
        search_->setFocus(Qt::ShortcutFocusReason);
        search_->selectAll();
    });
    connect(new QShortcut(QKeySequence("F1"), this), &QShortcut::activated, this,
            [this] { showGuide(*this, "The worklist"); });
    connect(new QShortcut(QKeySequence("Ctrl+Q"), this), &QShortcut::activated, this, &QWidget::close);
}

/// What is typed and opened at once is not what was chosen before it was typed.
void WorklistWindow::openSelected()
{
    open_when_listed_ = !isListed();
    if (const WorklistCase* row = selected(); row && readable(*row) && isListed())
        open(*row);
}

WorklistWindow::~WorklistWindow()
{
    for (const auto& window : made_)
        delete window.data();
}

void WorklistWindow::closeEvent(QCloseEvent* event)
{
    keepSettings(settings_worker_, {{kWorklistGeometry, saveGeometry()}});
    event->accept();
}

WorklistPageWanted WorklistWindow::wanted() const
{
    WorklistPageWanted wanted{.most = kPage, .words = search_->text().trimmed().toStdString()};
    if (!pages_.empty())
        wanted.after = pages_.back();
    if (state_->currentData().isValid())
        wanted.state = WorkState(state_->currentData().toInt());
    return wanted;
}

/// Whether the lines are those that are wanted now.
bool WorklistWindow::isListed() const
{
    return shown_ == wanted();
}

/// The buttons wait for it: they mean what is shown.
void WorklistWindow::turnTo(std::vector<std::string> pages)
{
    pages_ = std::move(pages);
    open_when_listed_ = false;
    updateButtons();
    refresh();
}

std::vector<std::string> WorklistWindow::casesInHand() const
{
    std::vector<std::string> cases;
    for (const auto& [id, window] : windows_)
        cases.push_back(id);
    if (!open_case_.empty())
        cases.push_back(open_case_);
    return cases;
}

void WorklistWindow::refresh()
{
    books_.post("list",
                [this, wanted = wanted(), shown = isListed(), in_hand = casesInHand()](Books& books) -> Worker::Work {
                    // Asked for first: what changes while the rows are read is read the next time.
                    std::optional<std::string> version;
                    if (services_.worklist_version)
                        version = services_.worklist_version(books.store());
                    if (version && version == books.version && wanted == books.wanted && shown)
                        return {};
                    Listed listed{wanted, services_.worklist(books.store(), wanted), {}};
                    for (const std::string& id : in_hand)
                        if (!listed.has(id) && services_.worklist_case)
                            if (auto row = services_.worklist_case(books.store(), id))
                                listed.beside.push_back(std::move(*row));
                    books.version = version;
                    books.wanted = wanted;
                    return [this, listed = std::move(listed)] { show(listed); };
                });
}

bool WorklistWindow::Listed::has(const std::string& id) const
{
    return std::ranges::any_of(page.cases, [&](const WorklistCase& row) { return row.record.id == id; });
}

void WorklistWindow::show(const Listed& listed)
{
    if (listed.wanted != wanted())  // typed on meanwhile: what is wanted now comes next
        return;
    const WorklistCase* chosen = selected();
    const std::string chosen_id = chosen && listed.has(chosen->record.id) ? chosen->record.id : "";
    const QSignalBlocker quiet(table_);
    rows_ = listed.page.cases;
    bool changed = table_->rowCount() != int(rows_.size());
    table_->setRowCount(int(rows_.size()));
    for (int n = 0; n < int(rows_.size()); ++n) {
        const WorklistCase& row = rows_[std::size_t(n)];
        changed = fillLine(*table_, n, row) || changed;
        if (row.record.id == chosen_id || (chosen_id.empty() && n == 0))
            table_->selectRow(n);  // what was chosen is not shown: the first that is found is opened by Return
    }
    // Once for all: a header that keeps to its contents measures every line again for each cell that is filled.
    if (changed)
        fitColumns(*table_);
    shown_ = listed.wanted;
    more_ = listed.page.more;
    showPlace();
    hint_->setVisible(rows_.empty());
    if (rows_.empty())
        hint_->setText(hintOfNothing());
    updateButtons();
    renewWindows(listed);
    if (std::exchange(open_when_listed_, false))
        openSelected();
}

/// Which page it is, where there are several.
void WorklistWindow::showPlace()
{
    const bool searched = !search_->text().trimmed().isEmpty(), several = more_ || !pages_.empty();
    const int before = kPage * int(pages_.size());
    page_->setText(searched ? tr("more are found: type more")
                            : tr("%1 to %2").arg(before + 1).arg(before + int(rows_.size())));
    page_->setVisible(several);
    newer_->setVisible(several && !searched);
    older_->setVisible(several && !searched);
}

QString WorklistWindow::hintOfNothing() const
{
    const QString words = search_->text().trimmed();
    const bool any_state = !state_->currentData().isValid();
    if (words.isEmpty() && any_state && pages_.empty())
        return hintOfEmptyStore(services_);
    return hintOfNothingFound(words, any_state ? QString() : state_->currentText());
}

void WorklistWindow::renewWindows(const Listed& listed)
{
    std::vector<const WorklistCase*> rows;
    for (const std::vector<WorklistCase>* all : {&std::as_const(rows_), &listed.beside})
        for (const WorklistCase& row : *all)
            rows.push_back(&row);
    for (const WorklistCase* row : rows)
        if (const auto window = windows_.find(row->record.id); window != windows_.end())
            window->second->renew(*row);
    const auto asked = std::ranges::find_if(
        rows, [&](const WorklistCase* row) { return !open_case_.empty() && row->record.id == open_case_; });
    open_case_.clear();
    if (asked != rows.end())
        open(**asked);
}

const WorklistCase* WorklistWindow::selected() const
{
    const auto chosen = table_->selectionModel()->selectedRows();
    if (chosen.empty() || chosen.front().row() >= int(rows_.size()))
        return nullptr;
    return &rows_[std::size_t(chosen.front().row())];
}

void WorklistWindow::updateButtons()
{
    const bool listed = isListed();
    newer_->setEnabled(listed && !pages_.empty());
    older_->setEnabled(listed && more_);
    const WorklistCase* row = listed ? selected() : nullptr;
    open_->setEnabled(row && readable(*row));
    report_->setEnabled(report_wanted_ || (row && readable(*row)));
    report_->setText(report_wanted_ ? tr("Stop") : tr("Report"));
    retry_->setEnabled(row && (row->state == WorkState::failed || spoiled(*row)));
    reason_->setText(row ? wordsOf(*row, true) : QString());
}

void WorklistWindow::open(const WorklistCase& row)
{
    const std::string id = row.record.id;
    if (const auto window = windows_.find(id); window != windows_.end()) {
        window->second->raise();
        window->second->activateWindow();
        return;
    }
    for (const auto& [other, open] : windows_)
        open->keep();
    auto* window = new ReadingWindow(services_, row);
    windows_[id] = window;
    made_.erase(std::remove(made_.begin(), made_.end(), nullptr), made_.end());
    made_.emplace_back(window);
    connect(window, &ReadingWindow::closed, this, [this, id] { windows_.erase(id); });
    if (services_.opened)
        books_.postAlways([this, id](Books& books) -> Worker::Work {
            services_.opened(books.store(), id);
            return {};
        });
    // Making and laying out take some 15 ms each: as two events, so that none blocks for long.
    QTimer::singleShot(0, window, &QWidget::show);
}

void WorklistWindow::retry()
{
    books_.postAlways([this, id = selected()->record.id](Books& books) -> Worker::Work {
        services_.retry(books.store(), id);
        return [this] {
            message_->setText(tr("Back in the queue; 'vicon work' runs it."));
            refresh();
        };
    });
}

void WorklistWindow::report()
{
    if (report_wanted_) {
        report_wanted_->giveUp();
        return;
    }
    message_->setText(tr("Writing the report ..."));
    report_wanted_ = std::make_shared<Wanted>();
    updateButtons();
    books_.postAlways([this, wanted = report_wanted_, id = selected()->record.id](Books& books) -> Worker::Work {
        QString said;
        try {
            const auto file = services_.report(books.store(), id, *wanted);
            said = tr("Report written: %1").arg(QString::fromStdString(file.string()));
        } catch (const std::exception& e) {
            said = wanted->cancelled() ? tr("The report was given up; nothing was written.") : QString(e.what());
        }
        return [this, said] {
            report_wanted_.reset();
            message_->setText(said);
            refresh();
            updateButtons();
        };
    });
}

}  // namespace vicon::viewer
