// The ways through an organ that branches, each from the root to one tip.
#include <QComboBox>
#include <cmath>

#include "kept_settings.h"
#include "reading_window.h"

namespace vicon::viewer {
namespace {

QString keyOf(const CaseRecord& a_case, const std::string& scan_id)
{
    return "place/" + QString::fromStdString(a_case.id) + "/way_" + QString::fromStdString(scan_id);
}

bool leadsThrough(const SkeletonTree& tree, int tip, int branch)
{
    for (int n = tip; n >= 0; n = tree.branches[std::size_t(n)].parent)
        if (n == branch)
            return true;
    return false;
}

}  // namespace

int ReadingWindow::wayOf(const std::string& scan_id) const
{
    return keptSetting(keyOf(session_.record(), scan_id), -1).toInt();
}

void ReadingWindow::showWays()
{
    const SkeletonTree& tree = session_.scan()->files.tree();
    way_choice_->clear();
    way_choice_->setVisible(!tree.empty());
    for (const int tip : tree.tips())
        way_choice_->addItem(
            tr("to tip %1, %2 mm").arg(tip).arg(tree.branches[std::size_t(tip)].points.back().station_mm, 0, 'f', 0),
            tip);
    way_choice_->setCurrentIndex(std::max(0, way_choice_->findData(session_.scan()->branch)));
}

void ReadingWindow::takeWay(int tip, std::optional<Point3> to)
{
    const std::string scan_id = session_.scan()->record.id;
    keepSettings(settings_worker_, {{keyOf(session_.record(), scan_id), tip}});
    ScanRequest request;
    request.scan_id = scan_id;
    request.read_again = true;
    request.go_to_mm = to;
    changeScan(request);
}

/// The nearest place of the tree in the projection, which may lie on another way than the one that is flown.
void ReadingWindow::clickedTree(const SkeletonTree& tree, Pixel at, Qt::KeyboardModifiers modifiers)
{
    int branch = 0;
    SkeletonPoint nearest;
    double least = 1e300;
    for (std::size_t n = 0; n < tree.branches.size(); ++n)
        for (const SkeletonPoint& point : tree.branches[n].points) {
            const Pixel p = shown_overview_.toPixel(point.position_mm);
            if (const double d = std::hypot(p.x - at.x, p.y - at.y); d < least) {
                least = d;
                branch = int(n);
                nearest = point;
            }
        }
    if (placed(*session_.scan(), place(), nearest.position_mm, modifiers))
        return;
    if (leadsThrough(tree, way_choice_->currentData().toInt(), branch)) {
        emit navigation_->jumpWanted(nearest.station_mm);
        return;
    }
    for (const int tip : tree.tips())  // the farthest of those behind it
        if (leadsThrough(tree, tip, branch)) {
            takeWay(tip, nearest.position_mm);
            return;
        }
}

}  // namespace vicon::viewer
