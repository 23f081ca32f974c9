#include "comparison/beside_view.h"

namespace vicon::viewer {

BesideView::BesideView(QWidget* parent) : QSplitter(Qt::Vertical, parent)
{
    setObjectName("beside");
    endoscopic_ = new PictureView(tr("Endoscopic view of the other scan"));
    endoscopic_->setObjectName("besideEndoscopic");
    endoscopic_->setToolTip(
        tr("The same place in the other scan. Click: read on from there. Shift and click: marker."));
    slice_ = new SliceView(SlicePlane::axial, tr("Slice of the other scan"));
    slice_->setObjectName("besideAxial");
    overview_ = new PictureView(tr("Projection of the other scan"));
    overview_->setObjectName("besideOverview");
    place_ = new QLabel;
    place_->setObjectName("besidePlace");
    place_->setWordWrap(true);
    place_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Maximum);
    addWidget(place_);
    addWidget(endoscopic_);
    addWidget(slice_);
    addWidget(overview_);
    setStretchFactor(0, 0);
    setStretchFactor(3, 2);
    favour(false);
}

void BesideView::favour(bool slice)
{
    constexpr int kPart_px = 100;
    const int inside = slice ? 2 : 3, plane = slice ? 3 : 2, projection = 2;
    setStretchFactor(1, inside);
    setStretchFactor(2, plane);
    setSizes({place_->sizeHint().height(), inside * kPart_px, plane * kPart_px, projection * kPart_px});
}

void BesideView::sayPlace(const QString& words, const QString& more)
{
    place_->setToolTip(more);
    place_->setText(words);
    place_->setVisible(!words.isEmpty());
}

void BesideView::clear(const QString& words)
{
    slice_->leave(words);
    for (PictureView* view : {endoscopic_, overview_})
        view->clearPicture(words);
}

}  // namespace vicon::viewer
