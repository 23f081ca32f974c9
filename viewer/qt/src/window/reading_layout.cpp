#include "window/reading_layout.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QStatusBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/control_keys.h"
#include "widgets/controls_area.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

QWidget* framed(QWidget* inside)
{
    auto* box = new QFrame;  // a group box of this style cuts a pixel off its title
    box->setFrameShape(QFrame::StyledPanel);
    auto* layout = new QVBoxLayout(box);
    layout->setContentsMargins(4, 2, 4, 2);
    layout->addWidget(inside);
    return box;
}

}  // namespace

ReadingLayout::ReadingLayout(QMainWindow& window, ReadingViews& views)
    : QObject(&window), window_(window), views_(views)
{
    for (const QString& title : {tr("&Case"), tr("&Edit"), tr("&Flight"), tr("&View"), tr("&Slices"), tr("&Help")})
        menus_.push_back(window.menuBar()->addMenu(title));
    auto* all = new QWidget(&window);
    auto* layout = new QVBoxLayout(all);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(buildTop());
    layout->addWidget(&views, 1);
    views.addControls(buildControls());
    window.setCentralWidget(all);
}

QWidget* ReadingLayout::buildTop()
{
    auto* top = new QWidget;
    top_ = new QHBoxLayout(top);
    top_->setContentsMargins(4, 2, 4, 2);
    banner_ = new QLabel(top);
    banner_->setObjectName("banner");
    banner_->setStyleSheet("font-weight: bold;");
    notice_ = new QLabel(top);
    notice_->setObjectName("notice");
    warning_ = new QLabel(top);
    warning_->setObjectName("warning");
    warning_->setWordWrap(true);
    warning_->setStyleSheet("color: #ff9a4a; font-weight: bold;");
    top_->addWidget(banner_);
    top_->addWidget(notice_);
    top_->addWidget(warning_, 1);
    return top;
}

void ReadingLayout::showBanner(const QString& words, const QString& more)
{
    banner_->setText(words);
    banner_->setToolTip(more);
}

QWidget* ReadingLayout::buildControls()
{
    lists_ = new QTabWidget;
    lists_->setObjectName("lists");
    lists_->tabBar()->setAccessibleName(tr("Lists"));
    connect(lists_, &QTabWidget::currentChanged, this, [this] { emit listShown(lists_->currentWidget()); });
    auto* controls = new QWidget;
    controls_ = new QVBoxLayout(controls);
    constexpr int kFocusRing_px = 2;  // of the tabs
    controls_->setContentsMargins(kFocusRing_px, 0, kFocusRing_px, 0);
    controls_->addWidget(lists_, 1);
    area_ = new ControlsArea(controls);
    return area_;
}

void ReadingLayout::addChoice(QWidget* choice)
{
    top_->insertWidget(int(choices_.size()), choice);
    choices_.push_back(choice);
}

void ReadingLayout::addPanel(QWidget* panel, PanelPlace place)
{
    if (place == PanelPlace::above_lists) {
        controls_->insertWidget(int(above_.size()), framed(panel));
        above_.push_back(panel);
    } else {
        controls_->addWidget(framed(panel));
        below_.push_back(panel);
    }
}

void ReadingLayout::addList(QWidget* list, const QString& title)
{
    lists_->addTab(list, title);
}

void ReadingLayout::addStatus(QWidget* status)
{
    window_.statusBar()->addPermanentWidget(status);
    status_.push_back(status);
}

QDockWidget* ReadingLayout::addForm(QWidget* form, const QString& title, Qt::DockWidgetArea area)
{
    auto* dock = new QDockWidget(title, &window_);
    dock->setObjectName(form->objectName() + "Dock");
    dock->setWidget(form);
    const bool beside = area == Qt::LeftDockWidgetArea || area == Qt::RightDockWidgetArea;
    dock->setAllowedAreas(beside ? Qt::LeftDockWidgetArea | Qt::RightDockWidgetArea
                                 : Qt::TopDockWidgetArea | Qt::BottomDockWidgetArea);
    window_.addDockWidget(area, dock);
    dock->hide();
    if (beside) {
        beside_.push_back(dock);
        connect(dock, &QDockWidget::visibilityChanged, this, [this] {
            views_.setFormBeside(
                std::ranges::any_of(beside_, [](const QDockWidget* form) { return form->isVisible(); }));
        });
    }
    return dock;
}

QMenu* ReadingLayout::menuOf(ReadingMenu menu)
{
    return menus_[std::size_t(menu)];
}

QAction* ReadingLayout::addAction(ReadingMenu menu, const QString& title, const QKeySequence& key,
                                  std::function<void()> what)
{
    QAction* action = menuOf(menu)->addAction(title);
    action->setShortcut(key);
    connect(action, &QAction::triggered, this, [what = std::move(what)] { what(); });
    return action;
}

QAction* ReadingLayout::addSwitch(ReadingMenu menu, const QString& title, const QKeySequence& key)
{
    QAction* action = menuOf(menu)->addAction(title);
    action->setCheckable(true);
    action->setShortcut(key);
    return action;
}

// What is done in this kind of picture first, the rest one step away: the mouse need not leave the picture.
void ReadingLayout::showMenuIn(const PictureView& view, QPoint at)
{
    const bool is_slice = dynamic_cast<const SliceView*>(&view) != nullptr;
    const ReadingMenu first = is_slice ? ReadingMenu::slices : ReadingMenu::flight;
    auto* menu = new QMenu(view.window());
    menu->setObjectName("pictureMenu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addActions(menuOf(first)->actions());
    menu->addSeparator();
    for (const ReadingMenu other : {ReadingMenu::edit, ReadingMenu::view, ReadingMenu::flight, ReadingMenu::slices})
        if (other != first)
            menu->addMenu(menuOf(other));
    menu->popup(at);
}

void ReadingLayout::finish()
{
    for (auto* view : window_.findChildren<PictureView*>())
        connect(view, &PictureView::menuWanted, this, [this, view](QPoint at) { showMenuIn(*view, at); });
    auto* keys = new ControlKeys(&window_, views_.first());
    orderTabs();
    connect(&views_, &ReadingViews::laidOut, this, [this, keys] {
        keys->setPicture(views_.first());
        orderTabs();
    });
}

// From left to right and from top to bottom, as the eye goes.
void ReadingLayout::orderTabs()
{
    std::vector<QWidget*> order = choices_;
    const std::vector<QWidget*> views = views_.inOrder();
    order.insert(order.end(), views.begin(), views.end());
    const auto add = [&](const std::vector<QWidget*>& parts) {
        for (QWidget* part : parts)
            for (QWidget* control : reachableIn(part))
                order.push_back(control);
    };
    add(above_);
    order.push_back(lists_);
    for (int n = 0; n < lists_->count(); ++n)
        add({lists_->widget(n)});
    add(below_);
    add(status_);
    for (std::size_t n = 1; n < order.size(); ++n)
        if (order[n - 1]->window() == order[n]->window())
            QWidget::setTabOrder(order[n - 1], order[n]);
}

void ReadingLayout::say(const QString& message)
{
    window_.statusBar()->showMessage(message);
}

void ReadingLayout::warn(const QString& message)
{
    say({});
    warning_->setText(message);
    warning_->setToolTip(message);
}

void ReadingLayout::notice(const QString& message)
{
    notice_->setText(message);
}

void ReadingLayout::showList(QWidget* list)
{
    lists_->setCurrentWidget(list);
}

void ReadingLayout::enableList(QWidget* list, bool on, const QString& tip)
{
    const int tab = lists_->indexOf(list);
    lists_->setTabEnabled(tab, on);
    lists_->setTabToolTip(tab, tip);
}

void ReadingLayout::goToList()
{
    if (lists_->currentWidget()->isAncestorOf(QApplication::focusWidget()))
        showNextList();
    auto* list = lists_->currentWidget()->findChild<QTableWidget*>();
    if (list->rowCount() > 0 && list->selectionModel()->selectedRows().empty())
        list->selectRow(0);
    list->setFocus(Qt::ShortcutFocusReason);
}

void ReadingLayout::showNextList()
{
    for (int n = 1; n < lists_->count(); ++n) {
        const int next = (lists_->currentIndex() + n) % lists_->count();
        if (lists_->isTabEnabled(next)) {
            lists_->setCurrentIndex(next);
            return;
        }
    }
}

int ReadingLayout::shownList() const
{
    return lists_->currentIndex();
}

void ReadingLayout::showList(int which)
{
    lists_->setCurrentIndex(which);
}

}  // namespace vicon::viewer
