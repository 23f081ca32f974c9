#include "widgets/theme.h"

#include <QApplication>
#include <QPalette>
#include <QProxyStyle>
#include <QStyleFactory>
#include <QToolTip>

namespace vicon::viewer {
namespace {

/// The frame around what has the keyboard belongs to the window: panels without margins would cut it off.
class Style : public QProxyStyle {
public:
    Style() : QProxyStyle(QStyleFactory::create("Fusion")) {}
    int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                  QStyleHintReturn* more) const override
    {
        return hint == SH_FocusFrame_AboveWidget ? 1 : QProxyStyle::styleHint(hint, option, widget, more);
    }
};

}  // namespace

void applyTheme()
{
    QApplication::setStyle(new Style);
    QPalette palette;
    const QColor ground(30, 32, 36), field(20, 21, 24), text(222, 222, 222), accent(64, 128, 176);
    palette.setColor(QPalette::Window, ground);
    palette.setColor(QPalette::WindowText, text);
    palette.setColor(QPalette::Base, field);
    palette.setColor(QPalette::AlternateBase, QColor(26, 28, 31));
    palette.setColor(QPalette::Text, text);
    palette.setColor(QPalette::Button, QColor(46, 49, 55));
    palette.setColor(QPalette::ButtonText, text);
    palette.setColor(QPalette::BrightText, Qt::white);
    palette.setColor(QPalette::ToolTipBase, field);
    palette.setColor(QPalette::ToolTipText, text);
    palette.setColor(QPalette::PlaceholderText, QColor(140, 140, 140));
    palette.setColor(QPalette::Highlight, accent);
    palette.setColor(QPalette::HighlightedText, Qt::white);
    palette.setColor(QPalette::Link, QColor(120, 185, 235));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        palette.setColor(QPalette::Disabled, role, QColor(120, 120, 120));
    QApplication::setPalette(palette);
    // Not by a style sheet of the application: with one, each control is matched against it whenever it is made, and a
    // window of many controls took four times as long to make.
    QToolTip::setPalette(palette);
}

QColor focusColor()
{
    return {255, 190, 40};
}

}  // namespace vicon::viewer
