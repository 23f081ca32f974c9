#pragma once

#include <QSplitter>
#include <array>

#include "slices/slice_view.h"
#include "widgets/picture_view.h"

namespace vicon::viewer {

class SecondWindow;

/// The pictures of the reading window, side by side: the view from inside, the three slices, the projection of the
/// organ. One of them can be enlarged; the slices and the projection may lie in a window of their own, for a second
/// screen.
class ReadingViews : public QSplitter {
    Q_OBJECT
public:
    explicit ReadingViews(QWidget* parent);

    PictureView* endoscopic() const { return endoscopic_; }
    PictureView* overview() const { return overview_; }
    const std::array<SliceView*, 3>& slices() const { return slices_; }
    /// From left to right and from top to bottom, as the eye goes; with what was added.
    std::vector<QWidget*> inOrder() const;

    /// Beside the view from inside, as another view like it.
    void addBeside(QWidget* view);
    /// What was added beside has room: no other view is enlarged in the same window.
    bool roomBeside() const;
    /// On the right, below the projection.
    void addControls(QWidget* controls);

    /// This view alone, or all again where it is alone already.
    void enlarge(QWidget* view);
    /// The view that has the keyboard, else the one from inside.
    void enlargeFocused();
    void setTwoWindows(bool on);
    bool twoWindows() const { return second_ != nullptr; }
    /// The keyboard goes to the view from inside, in each of the windows.
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
    void secondWindowClosed();
    /// To be kept for the next time; the second window goes.
    void sizesLeft(const QVariantMap& sizes);
    void keyPressed(QKeyEvent* event);
    void keyReleased(QKeyEvent* event);
    void keyboardLeft();  ///< keys are let go elsewhere

private:
    static constexpr const char* kColumnsKey = "window/columns";  // of the widths that are kept

    // second_screen.cpp
    void openSecondWindow();
    void closeSecondWindow();
    void placeSecondWindow();
    QVariantMap secondWindowSizes() const;

    PictureView *endoscopic_, *overview_;
    std::array<SliceView*, 3> slices_;
    QSplitter* slice_column_;
    QWidget* side_;
    QWidget* beside_ = nullptr;
    QWidget* controls_ = nullptr;
    QWidget* enlarged_ = nullptr;
    SecondWindow* second_ = nullptr;  // the slices and the projection are in it
    QByteArray columns_in_one_;       // their widths, while two windows are used
};

}  // namespace vicon::viewer
