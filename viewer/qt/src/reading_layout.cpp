#include <QAction>
#include <QComboBox>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QSplitter>
#include <QStatusBar>
#include <QTabBar>
#include <QTabWidget>
#include <QVBoxLayout>

#include "beside_view.h"
#include "colon_panel.h"
#include "controls_area.h"
#include "coverage_panel.h"
#include "reading_window.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {
namespace {

constexpr int kPart = 150, kSideWidth = 430;  // pixels of 96 to the inch, before the window is resized

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

QWidget* ReadingWindow::buildTop()
{
    auto* top = new QWidget(this);
    auto* row = new QHBoxLayout(top);
    row->setContentsMargins(4, 2, 4, 2);
    scan_choice_ = new QComboBox(top);
    scan_choice_->setObjectName("scan");
    scan_choice_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    scan_choice_->setAccessibleName(tr("Scan"));
    scan_choice_->setToolTip(tr("Supine or prone; the other one opens at the same part of the way (X)"));
    way_choice_ = new QComboBox(top);
    way_choice_->setObjectName("way");
    way_choice_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    way_choice_->setAccessibleName(tr("Way through the branches"));
    way_choice_->setToolTip(
        tr("Which tip the way leads to, the farthest first; or click on a branch in the projection"));
    way_choice_->hide();
    window_choice_ = new QComboBox(top);
    window_choice_->setObjectName("window");
    window_choice_->setAccessibleName(tr("Window of the slices"));
    window_choice_->setToolTip(tr("Window and level of the slices"));
    notice_ = new QLabel(top);
    notice_->setObjectName("notice");
    warning_ = new QLabel(top);
    warning_->setObjectName("warning");
    warning_->setWordWrap(true);
    warning_->setStyleSheet("color: #ff9a4a; font-weight: bold;");
    row->addWidget(scan_choice_);
    row->addWidget(way_choice_);
    row->addWidget(window_choice_);
    row->addWidget(notice_);
    row->addWidget(warning_, 1);
    return top;
}

QWidget* ReadingWindow::buildSide()
{
    table_ = new MarkerTable;
    navigation_ = new NavigationPanel;
    peeling_ = new PeelingPanel;
    coverage_ = new CoveragePanel;
    lists_ = new QTabWidget;
    lists_->setObjectName("lists");
    lists_->tabBar()->setAccessibleName(tr("Lists"));
    lists_->addTab(table_, tr("&Markers"));
    lists_->addTab(coverage_, tr("&Unseen"));
    colon_ = new ColonPanel;
    lists_->addTab(colon_, tr("C&olon"));
    connect(lists_, &QTabWidget::currentChanged, this, [this] {
        if (lists_->currentWidget() == coverage_)
            listUnseen();
    });
    seen_text_ = new QLabel;
    seen_text_->setObjectName("seenText");
    seen_text_->setToolTip(tr("Part of the wall seen so far"));
    statusBar()->addPermanentWidget(seen_text_);
    auto* controls = new QWidget;
    auto* stack = new QVBoxLayout(controls);
    constexpr int kFocusRing_px = 2;  // of the tabs
    stack->setContentsMargins(kFocusRing_px, 0, kFocusRing_px, 0);
    stack->addWidget(framed(navigation_));
    stack->addWidget(lists_, 1);
    stack->addWidget(framed(peeling_));
    auto* area = new ControlsArea(controls, peeling_->findChild<QWidget*>("histogram"));
    connect(peeling_, &PeelingPanel::histogramShown, area, [area](QWidget* it) { area->ensureWidgetVisible(it); });
    auto* side = new QWidget;
    side->setMaximumWidth(kSideWidth * 5 / 4);
    auto* column = new QVBoxLayout(side);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(overview_);
    column->addWidget(area);
    return side;
}

void ReadingWindow::buildViews()
{
    endoscopic_ = new PictureView(tr("Endoscopic view"));
    endoscopic_->setObjectName("endoscopic");
    endoscopic_->setMouseTracking(true);
    endoscopic_->setSteered();
    overview_ = new PictureView({});
    overview_->setObjectName("overview");
    overview_->setToolTip(tr("Click: go there"));
    transverse_ = new SliceView(SlicePlane::transverse, tr("Transverse slice"));
    coronal_ = new SliceView(SlicePlane::coronal, tr("Coronal slice"));
    sagittal_ = new SliceView(SlicePlane::sagittal, tr("Sagittal slice"));
    transverse_->setObjectName("transverse");
    coronal_->setObjectName("coronal");
    sagittal_->setObjectName("sagittal");

    slices_ = new QSplitter(Qt::Vertical);
    for (SliceView* slice : {transverse_, coronal_, sagittal_})
        slices_->addWidget(slice);
    slices_->setObjectName("slices");
    side_ = buildSide();
    columns_ = new QSplitter(Qt::Horizontal);
    columns_->addWidget(endoscopic_);
    beside_ = new BesideView;
    beside_->hide();
    columns_->addWidget(beside_);
    columns_->addWidget(slices_);
    columns_->addWidget(side_);
    columns_->setStretchFactor(0, 5);
    columns_->setStretchFactor(1, 4);
    columns_->setStretchFactor(2, 3);
    columns_->setStretchFactor(3, 0);
    columns_->setSizes({5 * kPart, 4 * kPart, 3 * kPart, kSideWidth});
    auto* all = new QWidget(this);
    auto* layout = new QVBoxLayout(all);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(buildTop());
    layout->addWidget(columns_, 1);
    setCentralWidget(all);
}

void ReadingWindow::enlarge(QWidget* view)
{
    enlarged_ = enlarged_ == view ? nullptr : view;
    // Of two windows, only the one that holds the view gives up its other views.
    const auto shown = [&](QWidget* widget) {
        const bool elsewhere = second_ && (widget == endoscopic_) != (enlarged_ == endoscopic_);
        return !enlarged_ || enlarged_ == widget || elsewhere;
    };
    overview_->setVisible(!second_ || !enlarged_ || enlarged_ == endoscopic_);
    bool any_slice = false;
    for (QWidget* slice :
         {static_cast<QWidget*>(transverse_), static_cast<QWidget*>(coronal_), static_cast<QWidget*>(sagittal_)}) {
        slice->setVisible(shown(slice));
        any_slice = any_slice || shown(slice);
    }
    transverse_->parentWidget()->setVisible(any_slice);
    endoscopic_->setVisible(shown(endoscopic_));
    beside_->setVisible(compare_->isChecked() && (!enlarged_ || (second_ && enlarged_ != endoscopic_)));
    drawBeside(true);
    view->setFocus();  // else the first list would get the keys of a view that is hidden now
}

void ReadingWindow::addActions()
{
    const auto add = [this](QMenu* menu, const QString& title, const QKeySequence& key, auto what) {
        QAction* action = menu->addAction(title);
        action->setShortcut(key);
        connect(action, &QAction::triggered, this, what);
        return action;
    };
    QMenu* a_case = menuBar()->addMenu(tr("&Case"));
    add(a_case, tr("Save picture to the case"), QKeySequence("Ctrl+S"), [this] { snapshot(false); });
    add(a_case, tr("Copy picture"), QKeySequence("Ctrl+C"), [this] { snapshot(true); });
    add(a_case, tr("Film the way to the end (again: cancel)"), QKeySequence("Ctrl+M"), [this] { film(); });
    add(a_case, tr("Load markers ..."), QKeySequence("Ctrl+O"), [this] { chooseMarkerFile(false); });
    add(a_case, tr("Save markers to a file ..."), QKeySequence("Ctrl+Shift+S"), [this] { chooseMarkerFile(true); });
    add(a_case, tr("Write report"), QKeySequence("Ctrl+P"), [this] {
        tell(tr("Writing the report ..."));
        session_.writeReport();
    });
    add(a_case, tr("Close"), QKeySequence("Ctrl+W"), [this] { close(); });
    QMenu* edit = menuBar()->addMenu(tr("&Edit"));
    add(edit, tr("Undo"), QKeySequence("Ctrl+Z"), [this] { undo(); });
    add(edit, tr("Redo"), QKeySequence("Ctrl+Y"), [this] { redo(); });
    add(edit, tr("Red marker at the next click"), QKeySequence("1"), [this] { startPlacing(MarkerColor::red); });
    add(edit, tr("Yellow marker at the next click"), QKeySequence("2"), [this] { startPlacing(MarkerColor::yellow); });
    add(edit, tr("Green marker at the next click"), QKeySequence("3"), [this] { startPlacing(MarkerColor::green); });
    add(edit, tr("Back to the view: no marker, line, circle, warning"), QKeySequence("Esc"), [this] { notAfterAll(); });
    add(edit, tr("Measure between two clicks"), QKeySequence("M"), [this] { startMeasuring(); });
    add(edit, tr("Virtual biopsy: circle a finding"), QKeySequence("T"), [this] { startCircling(); });
    add(edit, tr("Go to the list: arrows choose, Return flies there"), QKeySequence("L"), [this] { goToList(); });
    add(edit, tr("Write the note of the chosen marker"), QKeySequence("N"), [this] {
        lists_->setCurrentWidget(table_);
        table_->writeNote();
    });
    add(edit, tr("Marker information"), QKeySequence("I"), [this] { showMarkerInformation(); });
    add(edit, tr("Delete marker"), QKeySequence("Del"), [this] {
        if (const auto marker = table_->selected(); marker && table_->isEnabled())
            session_.removeMarker(*marker);
    });
    QMenu* flight = menuBar()->addMenu(tr("&Flight"));
    add(flight, tr("Planned"), QKeySequence("P"), [this] { setMode(NavigationMode::planned); });
    add(flight, tr("Guided"), QKeySequence("G"), [this] { setMode(NavigationMode::guided); });
    add(flight, tr("Free"), QKeySequence("F"), [this] { setMode(NavigationMode::free); });
    add(flight, tr("Fly or stop"), QKeySequence("Space"),
        [this] { fly(navigator() && navigator()->direction() ? 0 : 1); });
    add(flight, tr("Turn about"), QKeySequence("R"), [this] { turnAbout(); });
    add(flight, tr("Look back"), QKeySequence("B"),
        [this] { emit navigation_->lookBackWanted(navigator() && !navigator()->looksBack()); });
    add(flight, tr("A centimetre on"), QKeySequence("."), [this] { emit navigation_->stepWanted(10); });
    add(flight, tr("A centimetre back"), QKeySequence(","), [this] { emit navigation_->stepWanted(-10); });
    add(flight, tr("Jump to a distance"), QKeySequence("J"), [this] { navigation_->askStation(); });
    to_first_end_ = add(flight, {}, QKeySequence("Home"), [this] { goToEnd(Heading::rectum); });
    to_last_end_ = add(flight, {}, QKeySequence("End"), [this] { goToEnd(Heading::caecum); });
    add(flight, tr("Faster"), QKeySequence("+"), [this] {
        if (navigator())
            emit navigation_->speedWanted(navigator()->speed_mm_s() + 5);
    });
    add(flight, tr("Slower"), QKeySequence("-"), [this] {
        if (navigator())
            emit navigation_->speedWanted(navigator()->speed_mm_s() - 5);
    });
    QMenu* view = menuBar()->addMenu(tr("&View"));
    add(view, tr("This view alone, and back"), QKeySequence("E"), [this] { enlargeFocused(); });
    add(view, tr("Whole slices"), QKeySequence("0"), [this] {
        for (SliceView* slice : {transverse_, coronal_, sagittal_})
            slice->resetView();
    });
    compare_ = view->addAction(tr("Both scans side by side"));
    compare_->setCheckable(true);
    compare_->setShortcut(QKeySequence("C"));
    connect(compare_, &QAction::triggered, this, &ReadingWindow::setBeside);
    addLooks(view);
    addScreens(view);
    add(view, tr("Other scan"), QKeySequence("X"), [this] {
        if (scan_choice_->count() < 2) {
            warn(tr("This case has no other scan that can be read."));
            return;
        }
        scan_choice_->setCurrentIndex((scan_choice_->currentIndex() + 1) % scan_choice_->count());
        emit scan_choice_->activated(scan_choice_->currentIndex());
    });
    add(view, tr("Paint what was seen"), QKeySequence("V"), [this] { coverage_->setPaints(!coverage_->paints()); });
    add(menuBar()->addMenu(tr("&Help")), tr("Keys"), QKeySequence("?"), [this] { showKeys(); });
}

}  // namespace vicon::viewer
