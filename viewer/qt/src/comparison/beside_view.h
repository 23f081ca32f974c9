#pragma once

#include <QSplitter>

#include "slices/slice_view.h"
#include "widgets/picture_view.h"

namespace vicon::viewer {

/// The other scan of a case: what it shows at the place that corresponds to the one being read.
class BesideView : public QSplitter {
    Q_OBJECT
public:
    explicit BesideView(QWidget* parent = nullptr);
    PictureView* endoscopic() const { return endoscopic_; }
    SliceView* slice() const { return slice_; }

private:
    PictureView* endoscopic_;
    SliceView* slice_;
};

}  // namespace vicon::viewer
