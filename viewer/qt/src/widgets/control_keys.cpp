#include "widgets/control_keys.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QKeyEvent>
#include <QTabBar>

#include "widgets/picture_view.h"

namespace vicon::viewer {
namespace {

bool isPlain(const QKeyEvent& key)
{
    return !(key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
}

bool isLetter(const QKeyEvent& key)
{
    return isPlain(key) && !key.text().isEmpty() && key.text().front().isPrint();
}

/// Moves in a list or on a slider.
bool moves(const QKeyEvent& key)
{
    switch (key.key()) {
        case Qt::Key_Home:
        case Qt::Key_End:
        case Qt::Key_PageUp:
        case Qt::Key_PageDown:
        case Qt::Key_Up:
        case Qt::Key_Down:
        case Qt::Key_Left:
        case Qt::Key_Right:
            return isPlain(key);
        default:
            return false;
    }
}

bool isInForm(const QWidget* control)
{
    for (; control; control = control->parentWidget())
        if (qobject_cast<const QDockWidget*>(control))
            return true;
    return false;
}

}  // namespace

ControlKeys::ControlKeys(QWidget* window, QWidget* picture) : QObject(window), picture_(picture)
{
    for (QWidget* control : window->findChildren<QWidget*>()) {
        if (control->window() != window)
            continue;  // an open list has all keys anyway
        if (isInForm(control))
            continue;
        const bool is_list = qobject_cast<QComboBox*>(control) || qobject_cast<QAbstractItemView*>(control);
        const bool is_slider = qobject_cast<QAbstractSlider*>(control);
        const bool is_pressed = qobject_cast<QAbstractButton*>(control) || qobject_cast<QTabBar*>(control);
        if (is_list || is_slider || is_pressed || qobject_cast<QAbstractSpinBox*>(control) ||
            qobject_cast<PictureView*>(control))
            control->installEventFilter(this);
        if ((is_list || is_slider || is_pressed) && control->focusPolicy() != Qt::NoFocus)
            control->setFocusPolicy(Qt::TabFocus);
    }
    picture_->setFocus();
}

bool ControlKeys::eventFilter(QObject* control, QEvent* event)
{
    if (event->type() == QEvent::ShortcutOverride) {
        const auto& key = *static_cast<QKeyEvent*>(event);
        if (qobject_cast<PictureView*>(control))
            return false;
        const bool its_own = qobject_cast<QAbstractButton*>(control)
                                 ? key.key() == Qt::Key_Space
                                 : moves(key) || (isLetter(key) && qobject_cast<QComboBox*>(control));
        if (its_own)
            event->accept();
        return its_own;
    }
    if (event->type() == QEvent::KeyPress) {
        const auto& key = *static_cast<QKeyEvent*>(event);
        // The lines of a table are acted on by the window's letters; a search by letter would swallow them.
        if (isLetter(key) && qobject_cast<QAbstractItemView*>(control)) {
            event->ignore();
            return true;
        }
        const bool is_return = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
        if (auto* button = qobject_cast<QAbstractButton*>(control); button && is_return) {
            button->click();
            return true;
        }
        if (is_return && qobject_cast<QAbstractSpinBox*>(control))
            QMetaObject::invokeMethod(
                picture_, [this] { picture_->setFocus(); }, Qt::QueuedConnection);
    }
    if (auto* view = qobject_cast<PictureView*>(control); view && event->type() == QEvent::MouseButtonPress)
        (view->window() == picture_->window() ? picture_ : view->window())->setFocus(Qt::MouseFocusReason);
    return QObject::eventFilter(control, event);
}

}  // namespace vicon::viewer
