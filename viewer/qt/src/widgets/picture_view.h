#pragma once

#include <QImage>
#include <QWidget>
#include <optional>

#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/peeling.h"
#include "vicon/viewer/scene/canvas.h"
#include "widgets/calliper.h"

class QPainter;

namespace vicon::viewer {

/// Shows a picture that a worker made, and says in the picture's own pixels what the mouse does on it.
class PictureView : public QWidget {
    Q_OBJECT
public:
    explicit PictureView(const QString& name, QWidget* parent = nullptr);

    /// The next drag with the left button draws a circle around where it begins; circled() follows. By the keyboard:
    /// Return at its middle, arrows, Return.
    void setCircling(bool on);
    /// A click is awaited: the arrow keys move a cross, Return clicks there, or where the mouse is if that moved last.
    void setPicking(bool on);
    /// The arrow keys are the flight's unless a click is awaited.
    void setSteered() { steered_ = true; }
    /// Drawn over the picture; endDragged() follows where one of its ends is dragged.
    void setCalliper(const std::optional<Calliper>& calliper);
    const std::optional<Calliper>& calliper() const { return calliper_; }
    void showPicture(const Picture& picture);
    /// Said at the bottom of the picture; empty: nothing.
    void setNote(const QString& note);
    const QString& note() const { return note_; }
    /// In the lower left corner, small: what is read at the pointer; empty: nothing.
    void setReadout(const QString& text);
    const QString& readout() const { return readout_; }
    /// A circle over the picture, in its pixels.
    void setRing(const std::optional<PictureCircle>& ring);
    const std::optional<PictureCircle>& ring() const { return ring_; }
    /// A picture this far from what is looked at by now says so; a flight is never so far ahead of its picture.
    static constexpr double kElsewhere_mm = 25;
    /// Says so where the picture is of another place than the one that is looked at by now.
    void noteWhereElsewhere(const Point3& shown_mm, const Point3& wanted_mm);
    static QString notThisPlaceYet() { return tr("not this place yet: being drawn ..."); }
    /// What was shown is no longer true; until the next picture these words stand there.
    void clearPicture(const QString& words);
    const QImage& image() const { return image_; }
    /// As it is seen, with what is drawn over it, but for what shows that the keyboard acts on it.
    QImage seen();
    /// Size that a picture should have, in device pixels.
    QSize pictureSize() const;
    /// How high what is written in a picture is, in its pixels: as high as the window's own text.
    double textHeight_px() const;
    /// From picture pixels to the widget's place.
    QPointF toWidget(Pixel at) const;
    /// Where the keyboard's cross is at first; in the widget.
    virtual QPoint home() const { return rect().center(); }

signals:
    void pressed();  ///< by a button of the mouse; before whatever comes of it, a double click as well
    void clicked(vicon::viewer::Pixel at, Qt::KeyboardModifiers modifiers);
    /// Of the calliper, 0 or 1.
    void endDragged(int end, vicon::viewer::Pixel at, vicon::viewer::GripDrag drag);
    void hovered(vicon::viewer::Pixel at);  ///< where setMouseTracking() is on
    void enlargeWanted();
    void menuWanted(QPoint at);                        ///< on the screen
    void dragged(QPointF by, Qt::MouseButton button);  ///< in device pixels
    void dragEnded();
    void turned(int steps, Qt::KeyboardModifiers modifiers);
    void resized();
    void circled(vicon::viewer::Pixel centre, double radius_px);  ///< in the picture's pixels

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

private:
    // picture_keys.cpp
    bool takesArrows() const;
    bool actedOn(const QKeyEvent& key);
    void moveCross(QPoint by);
    void clickAtCross(Qt::KeyboardModifiers modifiers);
    void forgetCross();
    void drawFocus(QPainter& painter) const;

    // picture_calliper.cpp
    std::optional<int> gripAt(QPoint at) const;
    void dragGrip(QPoint to, GripDrag drag);
    /// An end that is dragged goes back to where it was. False where none is.
    bool breakOffDrag();
    void drawCalliper(QPainter& painter) const;
    void drawCalliperText(QPainter& painter) const;
    void drawRing(QPainter& painter) const;

    // picture_words.cpp
    void drawNote(QPainter& painter) const;
    void drawReadout(QPainter& painter) const;

    Pixel toPicture(QPoint at) const;
    /// Of the circle that is being drawn, in widget pixels.
    double circleRadius() const;

    QImage image_;
    QString waiting_;  // instead of a picture
    QString note_, readout_;
    std::optional<PictureCircle> ring_;
    std::optional<Calliper> calliper_;
    std::optional<int> grip_;  // the end that is held
    QPoint pressed_, last_;
    Qt::MouseButton button_ = Qt::NoButton;
    bool dragging_ = false;
    bool circling_ = false;
    bool picking_ = false, steered_ = false;
    bool reached_ = false;         // by the keyboard, which then acts on this view
    bool copied_ = false;          // what is painted leaves the window
    std::optional<QPoint> cross_;  // home() until it was moved
    bool mouse_moved_last_ = false;
    int wheel_ = 0;  // eighths of a degree not yet reported
};

}  // namespace vicon::viewer
