#include "window/reading_window.h"

#include <QAction>
#include <QCloseEvent>
#include <QKeyEvent>
#include <QScreen>
#include <QStyle>
#include <algorithm>

#include "opening/opening_tool.h"
#include "reading/kept_place.h"
#include "reading/reading.h"
#include "vicon/cases/printed.h"
#include "widgets/kept_settings.h"
#include "window/keys_help.h"
#include "window/reading_layout.h"
#include "window/tools.h"

namespace vicon::viewer {
namespace {
constexpr int kPoll_ms = 2000;  // how often other readers' changes are looked for
constexpr QSize kFirstSize{1500, 900};
constexpr const char* kGeometry = "window/geometry";
constexpr const char* kTwoWindows = "window/two";
constexpr const char* kList = "list";
}  // namespace

ReadingWindow::ReadingWindow(const ReadingServices& services, const WorklistCase& row)
{
    setObjectName("reading");
    setWindowTitle(tr("%1 - VICON").arg(QString::fromStdString(printedPatientName(row.record.patient.name))));
    views_ = new ReadingViews(this);
    layout_ = new ReadingLayout(*this, *views_);
    reading_ = std::make_unique<Reading>(services, row, *views_, nullptr);
    ReadingTools tools = makeReadingTools(*reading_, services, row);
    tools_ = std::move(tools.all);
    opening_ = tools.opening;
    std::vector<ReadingTool*> all;
    for (const auto& tool : tools_)
        all.push_back(tool.get());
    addEditActions();
    for (ReadingTool* tool : all)
        tool->addTo(*layout_);
    addWindowActions();
    reading_->setTools(all);
    connectAll();
    layout_->finish();
    restore();
    reading_->useWords(wordsFor(Organ()));  // until a scan is open
    opening_->openFirst();
}

ReadingWindow::~ReadingWindow() = default;

void ReadingWindow::renew(const WorklistCase& row)
{
    opening_->renew(row);
}

void ReadingWindow::addEditActions()
{
    layout_->addAction(ReadingMenu::edit, tr("Undo"), QKeySequence("Ctrl+Z"), [this] { reading_->undo(); });
    layout_->addAction(ReadingMenu::edit, tr("Redo"), QKeySequence("Ctrl+Y"), [this] { reading_->redo(); });
}

void ReadingWindow::addWindowActions()
{
    layout_->addAction(ReadingMenu::edit, tr("Go to the list"), QKeySequence("L"), [this] { layout_->goToList(); });
    layout_->addAction(ReadingMenu::edit, tr("Back to the view; ends tool and warning"), QKeySequence("Esc"),
                       [this] { reading_->giveUp(); });
    layout_->addAction(ReadingMenu::a_case, tr("Close"), QKeySequence("Ctrl+W"), [this] { close(); });
    layout_->addAction(ReadingMenu::view, tr("This view alone, and back"), QKeySequence("E"),
                       [this] { views_->enlargeFocused(); });
    two_windows_ = layout_->addSwitch(ReadingMenu::view, tr("Second window"), QKeySequence("F2"));
    layout_->addAction(ReadingMenu::help, tr("Keys"), QKeySequence("?"), [this] { showKeys(*this); });
}

void ReadingWindow::connectAll()
{
    connect(two_windows_, &QAction::toggled, views_, &ReadingViews::setTwoWindows);
    connect(views_, &ReadingViews::secondWindowClosed, this, [this] { two_windows_->setChecked(false); });
    connect(reading_.get(), &Reading::said, layout_, &ReadingLayout::say);
    connect(reading_.get(), &Reading::warned, layout_, &ReadingLayout::warn);
    connect(opening_, &OpeningTool::closeWanted, this, &QWidget::close);
    poll_.setInterval(kPoll_ms);
    connect(&poll_, &QTimer::timeout, &reading_->session(), &CaseSession::refresh);
    poll_.start();
}

// The screen and the hands are the reader's, whatever the case.
void ReadingWindow::restore()
{
    if (!restoreGeometry(keptSetting(kGeometry).toByteArray()))
        resize(kFirstSize.boundedTo(screen()->availableSize() -
                                    QSize(0, style()->pixelMetric(QStyle::PM_TitleBarHeight))));
    reading_->restore();
    two_windows_->setChecked(keptSetting(kTwoWindows).toBool());
    layout_->showList(keptSetting(readerKey(kList)).toInt());
}

void ReadingWindow::keyPressEvent(QKeyEvent* event)
{
    emit views_->keyPressed(event);
}

void ReadingWindow::keyReleaseEvent(QKeyEvent* event)
{
    emit views_->keyReleased(event);
}

void ReadingWindow::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::ActivationChange && !isActiveWindow())
        emit views_->keyboardLeft();
    QMainWindow::changeEvent(event);
}

void ReadingWindow::keep()
{
    reading_->keep({{kGeometry, saveGeometry()},
                    {kTwoWindows, two_windows_->isChecked()},
                    {readerKey(kList), layout_->shownList()}});
}

void ReadingWindow::closeEvent(QCloseEvent* event)
{
    poll_.stop();
    keep();
    views_->hideSecondWindow();
    reading_->stop();
    endThreads();
    event->accept();
}

// What is being drawn, read or saved is waited for without a window that does not answer.
void ReadingWindow::endThreads()
{
    constexpr int kLook_ms = 20;
    std::vector<QObject*> owners{reading_.get(), this};
    for (const auto& tool : tools_)
        owners.push_back(tool.get());
    for (const QObject* owner : owners)
        for (Worker* worker : owner->findChildren<Worker*>()) {
            worker->end();
            workers_.push_back(worker);
        }
    auto* look = new QTimer(this);
    connect(look, &QTimer::timeout, this, [this] {
        if (std::all_of(workers_.begin(), workers_.end(), [](const Worker* worker) { return worker->ended(); }))
            deleteLater();
    });
    look->start(kLook_ms);
    emit closed();
}

}  // namespace vicon::viewer
