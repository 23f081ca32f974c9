#pragma once

#include <QEvent>
#include <QScrollArea>
#include <QScrollBar>

namespace vicon::viewer {

/// The controls beside the views: as high as they want to be where there is room, else scrolled, so that a window
/// never grows beyond its screen because of them. What lies beside the controls keeps its size.
class ControlsArea : public QScrollArea {
public:
    explicit ControlsArea(QWidget* controls)
    {
        setFrameShape(QFrame::NoFrame);
        setFocusPolicy(Qt::NoFocus);  // a click between its controls leaves the keyboard where it is
        setWidgetResizable(true);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);  // what is left is the projection's
        setWidget(controls);
    }

    QSize sizeHint() const override { return {minimumSizeHint().width(), widget()->sizeHint().height()}; }
    QSize minimumSizeHint() const override
    {
        constexpr int kLeastHeight = 150;
        return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(), kLeastHeight};
    }

protected:
    /// A scroll area does not hear when what it holds wants another size.
    bool eventFilter(QObject* of, QEvent* event) override
    {
        if (of == widget() && event->type() == QEvent::LayoutRequest)
            updateGeometry();
        return QScrollArea::eventFilter(of, event);
    }
};

}  // namespace vicon::viewer
