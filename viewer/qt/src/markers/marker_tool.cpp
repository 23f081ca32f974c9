#include "markers/marker_tool.h"

#include <QFileDialog>
#include <QLineEdit>

#include "markers/marker_table.h"
#include "reading/reading.h"
#include "session/saved_view.h"
#include "vicon/viewer/model/annotate.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr double kFarOff_mm = 30;

/// How far a point is from the nearest wall, in the lumen or outside; kFarOff_mm or more: farther.
double offWall_mm(const Lumen& lumen, Point3 p)
{
    if (lumen.inside(p))
        return lumen.clearance_mm(p);
    const Lumen::Nearest nearest = lumen.nearestInside(p, kFarOff_mm);
    return nearest.found ? nearest.distance_mm : kFarOff_mm;
}

}  // namespace

MarkerTool::MarkerTool(Reading& reading) : ReadingTool(reading), table_(new MarkerTable) {}

void MarkerTool::addTo(ReadingLayout& layout)
{
    layout.addList(table_, tr("&Markers"));
    addActions(layout);
    connectTable();
}

void MarkerTool::addActions(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::a_case, tr("Load markers ..."), QKeySequence("Ctrl+O"),
                     [this] { chooseFile(false); });
    layout.addAction(ReadingMenu::a_case, tr("Save markers to a file ..."), QKeySequence("Ctrl+Shift+S"),
                     [this] { chooseFile(true); });
    const auto edit = [&layout](const QString& title, const char* key, std::function<void()> what) {
        layout.addAction(ReadingMenu::edit, title, QKeySequence(key), std::move(what));
    };
    edit(tr("Red marker at the next click"), "1", [this] { startPlacing(MarkerColor::red); });
    edit(tr("Yellow marker at the next click"), "2", [this] { startPlacing(MarkerColor::yellow); });
    edit(tr("Green marker at the next click"), "3", [this] { startPlacing(MarkerColor::green); });
    edit(tr("Write the note of the chosen marker"), "N", [this, &layout] {
        layout.showList(table_);
        table_->writeNote();
    });
    edit(tr("Marker information"), "I", [this] { showInformation(); });
    edit(tr("Delete marker"), "Del", [this] { removeChosen(); });
}

void MarkerTool::connectTable()
{
    CaseSession& session = reading_.session();
    // A second change of a marker before the first is saved would start from what it was.
    connect(&session, &CaseSession::busyChanged, table_, &MarkerTable::setBusy);
    connect(table_, &MarkerTable::flyWanted, this, &MarkerTool::choose);
    connect(table_, &MarkerTable::changed, this,
            [&session](const Marker& before, const Marker& after) { session.changeMarker(before, after, false); });
    connect(table_, &MarkerTable::removeWanted, &session, &CaseSession::removeMarker);
    connect(table_, &MarkerTable::pairWanted, this, &MarkerTool::pair);
    connect(table_, &MarkerTable::moveWanted, this, &MarkerTool::startMoving);
    connect(table_, &MarkerTable::undoWanted, &reading_, &Reading::undo);
    connect(table_, &MarkerTable::redoWanted, &reading_, &Reading::redo);
    connect(&reading_, &Reading::historyChanged, this,
            [this] { table_->setUndo(reading_.canUndo(), reading_.canRedo()); });
}

void MarkerTool::useWords(const OrganWords& words)
{
    table_->setStationTip(stationTip(words));
}

void MarkerTool::markersChanged()
{
    std::map<std::string, std::string> positions;
    for (const ScanRecord& scan : reading_.session().scans())
        positions[scan.id] = positionName(scan.series.patient_position);
    table_->show(reading_.session().markers(), positions);
}

void MarkerTool::startPlacing(MarkerColor color)
{
    reading_.begin(
        PlaceMarker{color},
        tr("Click where the %1 marker shall be, or arrows and Return").arg(QString::fromStdString(nameOf(color))));
}

void MarkerTool::startMoving(const Marker& marker)
{
    reading_.begin(MoveMarker{marker.id, marker.scan_id},
                   tr("Click on the new place of %1, or arrows and Return").arg(QString::fromStdString(marker.id)));
}

void MarkerTool::pair(const Marker& marker)
{
    if (marker.partners.empty())
        reading_.begin(PairMarker{marker.id, marker.scan_id}, tr("Choose the same finding in another scan"));
    else
        reading_.session().partMarkers(marker);
}

void MarkerTool::choose(const Marker& marker)
{
    const ChoiceMeaning meaning = reading_.interaction().choose(marker);
    if (const auto* pair = std::get_if<PairWith>(&meaning)) {
        if (const auto first = reading_.session().marker(pair->id))
            reading_.session().pairMarkers(*first, marker);
    } else if (std::holds_alternative<RefusePair>(meaning)) {
        reading_.warn(tr("A pair is one finding in two scans; both markers lie in the same one."));
    } else {
        reading_.showMarker(marker);
    }
}

bool MarkerTool::act(const ClickMeaning& meaning, const ClickedPoint& point)
{
    if (const auto* adds = std::get_if<AddMarker>(&meaning)) {
        add(adds->color, point);
        return true;
    }
    if (const auto* moves = std::get_if<MoveMarkerHere>(&meaning)) {
        move(moves->id, point);
        return true;
    }
    const auto* refusal = std::get_if<Refuse>(&meaning);
    const bool of_move = refusal && refusal->why == Refuse::Why::marker_of_other_scan;
    if (of_move)
        refuseMove(refusal->marker_id);
    return of_move;
}

void MarkerTool::add(MarkerColor color, const ClickedPoint& point)
{
    Marker marker;
    marker.scan_id = point.scan.record.id;
    marker.position_mm = point.at_mm;
    marker.color = color;
    if (point.from)  // in a slice, wherever the eye is: what shows the place is sought when it is looked at
        marker.view = viewOf(*point.from);
    reading_.session().addMarker(marker);
    reading_.toolChanged();  // what is measured meanwhile goes on, and may be this marker's
    warnOffWall(marker, point.scan.lumen);
}

/// A lesion is of the wall: a red marker in the middle of gas or of tissue means another place than was clicked.
void MarkerTool::warnOffWall(const Marker& marker, const Lumen& lumen)
{
    constexpr double kMost_mm = 8;  // the middle of a polyp of 16 mm
    const double off_mm = marker.color == MarkerColor::red ? offWall_mm(lumen, marker.position_mm) : 0;
    const bool off = off_mm > kMost_mm;
    if (off)
        reading_.warn(tr("This red marker lies %1 mm from the wall: 'Move' and a click on the wall moves it, Ctrl+Z "
                         "takes it back.")
                          .arg((off_mm < kFarOff_mm ? "" : ">") + QString::number(off_mm, 'f', 0)));
    else if (warned_off_wall_)
        reading_.warn({});
    warned_off_wall_ = off;
}

void MarkerTool::move(const std::string& id, const ClickedPoint& to)
{
    reading_.toolChanged();
    const auto before = reading_.session().marker(id);
    if (!before)
        return;
    Marker after = *before;
    after.position_mm = to.at_mm;
    after.view.reset();
    reading_.session().changeMarker(*before, after, true);
    warnOffWall(after, to.scan.lumen);
}

void MarkerTool::refuseMove(const std::string& id)
{
    reading_.toolChanged();
    reading_.warn(tr("%1 lies in the other scan and cannot be moved to this one.").arg(QString::fromStdString(id)));
}

void MarkerTool::removeChosen()
{
    if (const auto marker = table_->selected(); marker && !table_->isBusy())
        reading_.session().removeMarker(*marker);
}

void MarkerTool::chooseFile(bool to_save)
{
    auto* dialog = new QFileDialog(table_->window(), to_save ? tr("Save markers") : tr("Load markers"));
    dialog->setObjectName(to_save ? "saveMarkers" : "loadMarkers");
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setAcceptMode(to_save ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
    dialog->setFileMode(to_save ? QFileDialog::AnyFile : QFileDialog::ExistingFile);
    dialog->setNameFilter(tr("Markers (*.json)"));
    dialog->setDefaultSuffix("json");
    // Its list of completions lies over the buttons, and takes the first click on them.
    dialog->findChild<QLineEdit*>("fileNameEdit")->setCompleter(nullptr);
    connect(dialog, &QFileDialog::fileSelected, this, [this, to_save](const QString& file) {
        if (to_save)
            reading_.session().saveMarkers(file.toStdString());
        else
            load(file);
    });
    dialog->open();
}

void MarkerTool::load(const QString& file)
{
    reading_.say(tr("Markers are loaded ... Esc gives it up."));
    reading_.session().loadMarkers(file.toStdString());
}

void MarkerTool::escape()
{
    reading_.session().giveUpLoadingMarkers();
}

std::optional<StepNumber> MarkerTool::toUndo() const
{
    return reading_.session().toUndo();
}

std::optional<StepNumber> MarkerTool::toRedo() const
{
    return reading_.session().toRedo();
}

void MarkerTool::undo()
{
    reading_.session().undo();
}

void MarkerTool::redo()
{
    reading_.session().redo();
}

bool MarkerTool::stepUnderWay() const
{
    return reading_.session().busy();
}

}  // namespace vicon::viewer
