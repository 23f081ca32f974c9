#pragma once

#include <QSplitter>
#include <QVariant>
#include <array>

#include "slices/slice_view.h"
#include "vicon/viewer/model/hanging.h"
#include "widgets/picture_view.h"

namespace vicon::viewer {

class SecondWindow;

/// The pictures of the reading window, in columns: the view from inside, the slices, the projection of the
/// organ. How they are laid out can be chosen. One of them can be enlarged; the second column and the projection may
/// lie in a window of their own, for a second screen.
class ReadingViews : public QSplitter {
    Q_OBJECT
public:
    explicit ReadingViews(QWidget* parent);

    PictureView* endoscopic() const { return endoscopic_; }
    PictureView* overview() const { return overview_; }
    const std::array<SliceView*, 4>& slices() const { return slices_; }
    /// The view that is read in: it is large, and has the keyboard.
    PictureView* first() const;
    /// What is looked at: the visible view that has the keyboard, of those added beside as well; else the enlarged one,
    /// else the first that is visible.
    PictureView* lookedAt() const;
    /// It shows the scan that is beside.
    bool isBeside(const QWidget* view) const { return beside_ && beside_->isAncestorOf(view); }
    /// The slice that is read in; nothing where the view from inside is.
    SliceView* firstSlice() const;
    /// @param plane of the large slice
    void layOut(ViewLayout layout, SlicePlane plane);
    ViewLayout layoutNow() const { return layout_; }
    SlicePlane plane() const { return plane_; }
    /// From left to right and from top to bottom, as the eye goes; with what was added.
    std::vector<QWidget*> inOrder() const;

    /// Beside the view from inside, as another view like it.
    void addBeside(QSplitter* view);
    /// What was added beside has room: no other view is enlarged in the same window.
    bool roomBeside() const;
    /// On the right, below the projection.
    void addControls(QWidget* controls);
    /// A form stands beside the views. Where that leaves too little, projection and controls make room for it.
    void setFormBeside(bool on);

    /// This view alone, or all again where it is alone already.
    void enlarge(QWidget* view);
    /// The view that has the keyboard, else the one from inside.
    void enlargeFocused();
    void setTwoWindows(bool on);
    bool twoWindows() const { return second_ != nullptr; }
    /// The keyboard goes to the view that is read in, in each of the windows.
    void takeKeyboard();
    /// A click is awaited in any of them.
    void setPicking(bool on);

    /// As the reader left the columns and the second window.
    void restoreSizes();
    QVariantMap sizes() const;
    void hideSecondWindow();

signals:
    /// Views were shown or hidden.
    void arranged();
    /// As was asked. @param elsewhere than before
    void laidOut(bool elsewhere);
    void secondWindowClosed();
    /// To be kept for the next time; the second window goes.
    void sizesLeft(const QVariantMap& sizes);
    void keyPressed(QKeyEvent* event);
    void keyReleased(QKeyEvent* event);
    void keyboardLeft();  ///< keys are let go elsewhere

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    bool inSecondWindow(const QWidget* view) const;
    std::vector<QWidget*> firstColumn() const;
    std::vector<QWidget*> secondColumn() const;
    /// Of four slices three are shown: across the lumen only where that is the large one, and then not the sagittal
    /// one.
    SlicePlane restingPlane() const;
    void fillColumns();
    void showViews();
    void showSide();
    /// Of this layout, as they were left or as is usual.
    void takeSizes();
    QString sizesKey(const char* of) const;

    // second_screen.cpp
    void openSecondWindow();
    void closeSecondWindow();
    void placeSecondWindow();
    QVariantMap secondWindowSizes() const;

    PictureView *endoscopic_, *overview_;
    std::array<SliceView*, 4> slices_;  // in the order of SlicePlane
    QSplitter *first_column_, *second_column_;
    QWidget* side_;
    QSplitter* beside_ = nullptr;
    QWidget* controls_ = nullptr;
    QWidget* enlarged_ = nullptr;
    bool form_beside_ = false;
    QByteArray columns_before_form_;  // their widths, while it takes the place of some
    SecondWindow* second_ = nullptr;  // the slices and the projection are in it
    QByteArray columns_in_one_;       // their widths, while two windows are used
    ViewLayout layout_ = ViewLayout::three_d_first;
    SlicePlane plane_ = SlicePlane::axial;
    QVariantMap left_sizes_;  // of other layouts
};

}  // namespace vicon::viewer
