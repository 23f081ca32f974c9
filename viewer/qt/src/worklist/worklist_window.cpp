#include "worklist/worklist_window.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QShortcut>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "guide/guide.h"
#include "window/reading_window.h"
#include "worklist/worklist_columns.h"
#include "worklist/worklist_hint.h"

namespace vicon::viewer {
namespace {

constexpr int kRefresh_ms = 2000;

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
    search_->setPlaceholderText(tr("Search name or ID (Ctrl+F)"));
    search_->setClearButtonEnabled(true);
    state_ = new QComboBox(this);
    state_->setObjectName("state");
    state_->setAccessibleName(tr("State of the cases shown"));
    state_->addItem(tr("all"), "");
    for (const WorkState state : {WorkState::done, WorkState::running, WorkState::queued, WorkState::failed})
        state_->addItem(QString::fromStdString(nameOf(state)), QString::fromStdString(nameOf(state)));
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
}

void WorklistWindow::layOut()
{
    auto* top = new QHBoxLayout;
    top->addWidget(search_, 1);
    top->addWidget(state_);
    auto* bottom = new QHBoxLayout;
    bottom->addWidget(message_, 1);
    for (QPushButton* b : {retry_, report_, open_})
        bottom->addWidget(b);
    auto* column = new QVBoxLayout(this);
    column->addLayout(top);
    column->addWidget(table_, 1);
    column->addWidget(reason_);
    column->addLayout(bottom);
    resize(1000, 500);
    QWidget* const order[] = {search_, state_, table_, retry_, report_, open_};
    for (std::size_t n = 1; n < std::size(order); ++n)
        setTabOrder(order[n - 1], order[n]);
}

void WorklistWindow::connectControls()
{
    connect(search_, &QLineEdit::textChanged, this, &WorklistWindow::filter);
    connect(state_, qOverload<int>(&QComboBox::currentIndexChanged), this, &WorklistWindow::filter);
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

void WorklistWindow::openSelected()
{
    if (const WorklistCase* row = selected(); row && readable(*row))
        open(*row);
}

WorklistWindow::~WorklistWindow()
{
    for (const auto& window : made_)
        delete window.data();
}

void WorklistWindow::refresh()
{
    books_.post("list", [this](Books& books) -> Worker::Work {
        // Asked for first: what changes while the rows are read is read the next time.
        std::optional<std::string> version;
        if (services_.worklist_version)
            version = services_.worklist_version(books.store());
        if (version && version == books.version)
            return {};
        auto rows = services_.worklist(books.store());
        books.version = version;
        return [this, rows = std::move(rows)] { show(rows); };
    });
}

void WorklistWindow::show(const std::vector<WorklistCase>& rows)
{
    const WorklistCase* chosen = selected();
    const std::string chosen_id = chosen ? chosen->record.id : "";
    const QSignalBlocker quiet(table_);
    rows_ = rows;
    listed_ = true;
    bool changed = table_->rowCount() != int(rows.size());
    table_->setRowCount(int(rows.size()));
    for (int n = 0; n < int(rows.size()); ++n) {
        const WorklistCase& row = rows[std::size_t(n)];
        changed = fillLine(*table_, n, row) || changed;
        if (row.record.id == chosen_id || (chosen_id.empty() && n == 0))
            table_->selectRow(n);
    }
    // Once for all: a header that keeps to its contents measures every line again for each cell that is filled.
    if (changed)
        fitColumns(*table_);
    filter();
    updateButtons();
    for (const WorklistCase& row : rows_)
        if (const auto window = windows_.find(row.record.id); window != windows_.end())
            window->second->renew(row);
    const auto wanted = std::find_if(rows_.begin(), rows_.end(), [&](const WorklistCase& row) {
        return !open_case_.empty() && row.record.id == open_case_;
    });
    open_case_.clear();
    if (wanted != rows_.end())
        open(*wanted);
}

void WorklistWindow::filter()
{
    const QString words = search_->text().trimmed(), state = state_->currentData().toString();
    for (int n = 0; n < table_->rowCount(); ++n) {
        const WorklistCase& row = rows_[std::size_t(n)];
        table_->setRowHidden(
            n, !says(row, words) || (!state.isEmpty() && QString::fromStdString(nameOf(row.state)) != state));
    }
    if (!selected())  // what was chosen is hidden: the first that was found is opened by Return
        for (int n = 0; n < table_->rowCount(); ++n)
            if (!table_->isRowHidden(n)) {
                table_->selectRow(n);
                break;
            }
    updateButtons();
    if (listed_)
        showHint();
}

void WorklistWindow::showHint()
{
    int shown = 0;
    for (int n = 0; n < table_->rowCount(); ++n)
        shown += table_->isRowHidden(n) ? 0 : 1;
    hint_->setVisible(shown == 0);
    hint_->setText(rows_.empty() ? hintOfEmptyStore(services_)
                                 : hintOfNothingFound(search_->text().trimmed(),
                                                      state_->currentIndex() > 0 ? state_->currentText() : QString(),
                                                      int(rows_.size())));
}

const WorklistCase* WorklistWindow::selected() const
{
    const auto chosen = table_->selectionModel()->selectedRows();
    if (chosen.empty() || chosen.front().row() >= int(rows_.size()) || table_->isRowHidden(chosen.front().row()))
        return nullptr;
    return &rows_[std::size_t(chosen.front().row())];
}

void WorklistWindow::updateButtons()
{
    const WorklistCase* row = selected();
    open_->setEnabled(row && readable(*row));
    report_->setEnabled(row && readable(*row));
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
    window->resize(1500, 900);
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
    message_->setText(tr("Writing the report ..."));
    books_.postAlways([this, id = selected()->record.id](Books& books) -> Worker::Work {
        const auto file = services_.report(books.store(), id);
        return [this, name = QString::fromStdString(file.string())] {
            message_->setText(tr("Report written: %1").arg(name));
            refresh();
        };
    });
}

}  // namespace vicon::viewer
