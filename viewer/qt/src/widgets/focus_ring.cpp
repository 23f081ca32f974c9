#include "widgets/focus_ring.h"

#include <QApplication>
#include <QPainter>

#include "widgets/picture_view.h"
#include "widgets/theme.h"

namespace vicon::viewer {
namespace {

/// Qt's follows its control through layouts and scrolling, lets the mouse through, and has its middle cut out.
class Frame : public QFocusFrame {
public:
    Frame() { setObjectName("focusRing"); }

protected:
    void paintEvent(QPaintEvent*) override { QPainter(this).fillRect(rect(), focusColor()); }
};

}  // namespace

FocusRing::FocusRing(QObject* parent) : QObject(parent)
{
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) { follow(now); });
}

FocusRing::~FocusRing()
{
    delete frame_.data();
}

void FocusRing::follow(QWidget* control)
{
    const bool framed = control && !qobject_cast<PictureView*>(control) && !control->isWindow() &&
                        control->window()->windowType() != Qt::Popup;
    if (framed && !frame_)
        frame_ = new Frame;
    if (frame_)
        frame_->setWidget(framed ? control : nullptr);
}

}  // namespace vicon::viewer
