#pragma once

#include <QImage>
#include <QLineF>
#include <QVector>
#include <QWidget>

#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/scene/canvas.h"

class QPainter;

namespace vicon::viewer {

/// Shows a picture that a worker made, and says in the picture's own pixels what the mouse does on it.
class PictureView : public QWidget {
    Q_OBJECT
public:
    explicit PictureView(const QString& name, QWidget* parent = nullptr);

    /// The next drag with the left button draws a circle around where it begins; circled() follows.
    void setCircling(bool on);
    /// Drawn over the picture; in its pixels.
    void setLines(const QVector<QLineF>& lines);
    void showPicture(const Picture& picture);
    const QImage& image() const { return image_; }
    /// Size that a picture should have, in device pixels.
    QSize pictureSize() const;
    /// From picture pixels to the widget's place.
    QPointF toWidget(Pixel at) const;

signals:
    void clicked(vicon::viewer::Pixel at, Qt::KeyboardModifiers modifiers);
    void hovered(vicon::viewer::Pixel at);  ///< where setMouseTracking() is on
    void enlargeWanted();
    void dragged(QPointF by, Qt::MouseButton button);  ///< in device pixels
    void dragEnded();
    void turned(int steps, Qt::KeyboardModifiers modifiers);
    void resized();
    void circled(vicon::viewer::Pixel centre, double radius_px);  ///< in the picture's pixels

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

private:
    void drawLines(QPainter& painter) const;
    /// Of the circle that is being drawn, in widget pixels.
    double circleRadius() const;

    QImage image_;
    QVector<QLineF> lines_;
    QPoint pressed_, last_;
    Qt::MouseButton button_ = Qt::NoButton;
    bool dragging_ = false;
    bool circling_ = false;
    int wheel_ = 0;  // eighths of a degree not yet reported
};

}  // namespace vicon::viewer
