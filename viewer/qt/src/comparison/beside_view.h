#pragma once

#include <QLabel>
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
    PictureView* overview() const { return overview_; }
    /// Makes the slice the larger one of the pictures, or the view from inside.
    void favour(bool slice);
    /// How surely it is the same place; empty: nothing is said.
    void sayPlace(const QString& words, const QString& more);

    /// Another scan is shown from now on; these words stand there until its pictures come.
    void clear(const QString& words);

private:
    PictureView* endoscopic_;
    SliceView* slice_;
    PictureView* overview_;
    QLabel* place_;
};

}  // namespace vicon::viewer
