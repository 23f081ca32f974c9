// Which view lies in which column, and how wide the columns are.
#include <QVBoxLayout>
#include <algorithm>

#include "reading/reading_views.h"
#include "widgets/kept_settings.h"

namespace vicon::viewer {
namespace {

constexpr int kLayoutPart_px = 150;  // as long as a window is not shown, of about a tenth of a screen
constexpr const char* kColumns = "columns";
constexpr const char* kFirst = "first";
constexpr const char* kSecond = "slices";

struct Shares {
    int first, beside, second;
};

Shares usualShares(ViewLayout layout)
{
    switch (layout) {
        case ViewLayout::two_d_first:
            return {6, 4, 2};
        case ViewLayout::both_scans:
            return {1, 1, 1};
        case ViewLayout::planes:
            return {4, 4, 4};
        default:
            return {5, 4, 3};
    }
}

}  // namespace

PictureView* ReadingViews::first() const
{
    if (SliceView* slice = firstSlice())
        return slice;
    return endoscopic_;
}

SliceView* ReadingViews::firstSlice() const
{
    const bool reads_slice = layout_ == ViewLayout::two_d_first || layout_ == ViewLayout::planes;
    return reads_slice ? slices_[std::size_t(plane_)] : nullptr;
}

std::vector<QWidget*> ReadingViews::firstColumn() const
{
    SliceView* const large = slices_[std::size_t(plane_)];
    switch (layout_) {
        case ViewLayout::two_d_first:
            return {large};
        case ViewLayout::both_scans:
            return {endoscopic_, large};
        case ViewLayout::planes:
            return {large, endoscopic_};
        default:
            return {endoscopic_};
    }
}

std::vector<QWidget*> ReadingViews::secondColumn() const
{
    std::vector<QWidget*> others;
    const std::vector<QWidget*> first = firstColumn();
    const auto add = [&](QWidget* view) {
        if (std::find(first.begin(), first.end(), view) == first.end())
            others.push_back(view);
    };
    add(endoscopic_);
    for (SliceView* slice : slices_)
        if (slice != slices_[std::size_t(restingPlane())])
            add(slice);
    return others;
}

SlicePlane ReadingViews::restingPlane() const
{
    return plane_ == SlicePlane::across && layout_ != ViewLayout::three_d_first ? SlicePlane::sagittal
                                                                                : SlicePlane::across;
}

void ReadingViews::fillColumns()
{
    const auto fill = [](QSplitter* column, const std::vector<QWidget*>& views) {
        for (std::size_t n = 0; n < views.size(); ++n)
            column->insertWidget(int(n), views[n]);
    };
    SliceView* const resting = slices_[std::size_t(restingPlane())];
    second_column_->addWidget(resting);
    resting->hide();
    fill(first_column_, firstColumn());
    fill(second_column_, secondColumn());
}

void ReadingViews::layOut(ViewLayout layout, SlicePlane plane)
{
    const bool other_columns = layout != layout_;
    if (!other_columns && plane == plane_) {
        emit laidOut(false);  // what was added beside may have been hidden since
        return;
    }
    if (other_columns)
        left_sizes_.insert(sizes());
    layout_ = layout;
    plane_ = plane;
    enlarged_ = nullptr;
    const QList<int> first_px = first_column_->sizes(), second_px = second_column_->sizes();
    fillColumns();
    showViews();
    if (other_columns) {
        takeSizes();
    } else {
        first_column_->setSizes(first_px);  // a slice takes the room of the one whose place it takes
        second_column_->setSizes(second_px);
    }
    emit laidOut(true);
    emit arranged();
    takeKeyboard();
}

QString ReadingViews::sizesKey(const char* of) const
{
    const QString key = QString("window/") + of;
    return layout_ == ViewLayout::three_d_first ? key : key + QString::number(int(layout_));
}

void ReadingViews::takeSizes()
{
    const auto left = [this](const char* of) {
        const QString key = sizesKey(of);
        return left_sizes_.contains(key) ? left_sizes_[key].toByteArray() : keptSetting(key).toByteArray();
    };
    const auto evenly = [](QSplitter* column) {
        column->setSizes(QList<int>::fromVector(QVector<int>(column->count(), kLayoutPart_px)));
    };
    const Shares usual = usualShares(layout_);
    const int sides_px = side_->width();
    const int width_px = std::max(width() - sides_px, usual.first * kLayoutPart_px);
    const QByteArray columns = left(kColumns);
    if (second_)
        columns_in_one_ = columns;
    if (!columns.isEmpty() && !second_) {
        restoreState(columns);
    } else if (beside_) {
        const int all = usual.first + (layout_ == ViewLayout::both_scans ? usual.beside : usual.second);
        setSizes(
            {width_px * usual.first / all, width_px * usual.beside / all, width_px * usual.second / all, sides_px});
    }
    if (!first_column_->restoreState(left(kFirst)))
        evenly(first_column_);
    if (!second_ && !second_column_->restoreState(left(kSecond)))
        evenly(second_column_);
    if (beside_ && layout_ == ViewLayout::both_scans) {
        // Its views as high as those of the scan that is read, under its words; its projection is folded away.
        QList<int> heights_px{beside_->widget(0)->sizeHint().height()};
        heights_px += first_column_->sizes();
        heights_px += 0;
        beside_->setSizes(heights_px);
    }
}

void ReadingViews::restoreSizes()
{
    takeSizes();
    if (beside_)
        beside_->hide();  // shown when its scan is there
}

QVariantMap ReadingViews::sizes() const
{
    QVariantMap values = left_sizes_;
    values.insert(secondWindowSizes());
    values[sizesKey(kColumns)] = second_ ? columns_in_one_ : saveState();
    values[sizesKey(kFirst)] = first_column_->saveState();
    if (!second_)
        values[sizesKey(kSecond)] = second_column_->saveState();
    return values;
}

}  // namespace vicon::viewer
