#include "comparison/beside_view.h"

namespace vicon::viewer {

BesideView::BesideView(QWidget* parent) : QSplitter(Qt::Vertical, parent)
{
    setObjectName("beside");
    endoscopic_ = new PictureView(tr("Endoscopic view of the other scan"));
    endoscopic_->setObjectName("besideEndoscopic");
    endoscopic_->setToolTip(
        tr("The same place in the other scan. Click: read on from there. Shift and click: marker."));
    slice_ = new SliceView(SlicePlane::axial, tr("Axial slice of the other scan"));
    slice_->setObjectName("besideAxial");
    addWidget(endoscopic_);
    addWidget(slice_);
    setStretchFactor(0, 2);
    setStretchFactor(1, 1);
}

}  // namespace vicon::viewer
