#pragma once

#include <QEvent>
#include <QScrollArea>
#include <QScrollBar>

namespace vicon::viewer {

/// The controls beside the views: as high as they want to be where there is room, else scrolled, so that a window
/// never grows beyond its screen because of them. What comes and goes among them is scrolled to; what lies beside the
/// controls keeps its size.
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

    /// One of the controls, which is there for a while.
    void setPassing(const QWidget* passing) { passing_ = passing; }

    QSize sizeHint() const override
    {
        const int extra = passing_ && passing_->isVisibleTo(widget()) ? passing_->sizeHint().height() : 0;
        return {minimumSizeHint().width(), widget()->sizeHint().height() - extra};
    }
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

private:
    const QWidget* passing_ = nullptr;
};

}  // namespace vicon::viewer
