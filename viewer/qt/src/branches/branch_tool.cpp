#include "branches/branch_tool.h"

#include <QComboBox>
#include <cmath>

#include "branches/kept_branch.h"
#include "reading/reading.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

bool leadsThrough(const SkeletonTree& tree, int tip, int branch)
{
    for (int n = tip; n >= 0; n = tree.branches[std::size_t(n)].parent)
        if (n == branch)
            return true;
    return false;
}

struct PlaceInTree {
    int branch = 0;
    SkeletonPoint point;
};

/// The place of the tree that is nearest to a pixel of its projection, on whatever branch.
PlaceInTree nearestInPicture(const SkeletonTree& tree, const PlaneView& picture, Pixel at)
{
    PlaceInTree nearest;
    double least = 1e300;
    for (std::size_t n = 0; n < tree.branches.size(); ++n)
        for (const SkeletonPoint& point : tree.branches[n].points) {
            const Pixel p = picture.toPixel(point.position_mm);
            if (const double d = std::hypot(p.x - at.x, p.y - at.y); d < least) {
                least = d;
                nearest = {int(n), point};
            }
        }
    return nearest;
}

}  // namespace

int keptBranch(const CaseRecord& record, const std::string& scan_id)
{
    return keptSetting(keptBranchKey(record, scan_id), -1).toInt();
}

BranchTool::BranchTool(Reading& reading) : ReadingTool(reading)
{
    choice_ = new QComboBox;
    choice_->setObjectName("way");
    choice_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    choice_->setAccessibleName(tr("Way through the branches"));
    choice_->setToolTip(tr("Which tip the way leads to, the farthest first; or click on a branch in the projection"));
    choice_->hide();
}

void BranchTool::addTo(ReadingLayout& layout)
{
    layout.addChoice(choice_);
    connect(choice_, qOverload<int>(&QComboBox::activated), this,
            [this] { takeWay(choice_->currentData().toInt(), {}); });
    connect(reading_.views().overview(), &PictureView::clicked, this, &BranchTool::clickedOverview);
}

void BranchTool::showWays()
{
    const SkeletonTree& tree = reading_.scan()->files.tree();
    choice_->clear();
    choice_->setVisible(!tree.empty());
    for (const int tip : tree.tips())
        choice_->addItem(
            tr("to tip %1, %2 mm").arg(tip).arg(tree.branches[std::size_t(tip)].points.back().station_mm, 0, 'f', 0),
            tip);
    choice_->setCurrentIndex(std::max(0, choice_->findData(reading_.scan()->branch)));
}

void BranchTool::takeWay(int tip, std::optional<Point3> to)
{
    const std::string scan_id = reading_.scan()->record.id;
    keepSettings(settings_worker_, {{keptBranchKey(reading_.session().record(), scan_id), tip}});
    ScanRequest request;
    request.scan_id = scan_id;
    request.read_again = true;
    request.go_to_mm = to;
    reading_.changeScan(request);
}

void BranchTool::clickedOverview(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!reading_.scan() || !reading_.shownOverview() || reading_.scan()->files.tree().empty())
        return;
    const SkeletonTree& tree = reading_.scan()->files.tree();
    const PlaceInTree nearest = nearestInPicture(tree, *reading_.shownOverview(), at);
    if (reading_.click({*reading_.scan(), {}, nearest.point.position_mm, modifiers, false}))
        return;
    if (leadsThrough(tree, choice_->currentData().toInt(), nearest.branch)) {
        emit reading_.jumpWanted(nearest.point.station_mm);
        return;
    }
    for (const int tip : tree.tips())  // the farthest of those behind it
        if (leadsThrough(tree, tip, nearest.branch)) {
            takeWay(tip, nearest.point.position_mm);
            return;
        }
}

}  // namespace vicon::viewer
