#include "report/form_parts.h"

#include <QLineEdit>
#include <QWheelEvent>
#include <cmath>

namespace vicon::viewer {

FormChoice::FormChoice(const char* name, const QString& title, const std::vector<std::string>& names,
                       const QString& none, QWidget* parent)
    : QComboBox(parent)
{
    setObjectName(name);
    setAccessibleName(title);
    if (!none.isEmpty())
        addItem(none, QString());
    for (const std::string& one : names)
        addItem(QString::fromStdString(one), QString::fromStdString(one));
    connect(this, QOverload<int>::of(&QComboBox::activated), this, &FormChoice::chosen);
}

std::optional<std::string> FormChoice::value() const
{
    const std::string value = currentData().toString().toStdString();
    return value.empty() ? std::nullopt : std::optional(value);
}

void FormChoice::setValue(const std::optional<std::string>& value)
{
    setCurrentIndex(findData(QString::fromStdString(value.value_or(""))));
}

void FormChoice::wheelEvent(QWheelEvent* event)
{
    event->ignore();
}

FormNumber::FormNumber(const char* name, const QString& title, double most, const QString& unit, const QString& none,
                       QWidget* parent)
    : QDoubleSpinBox(parent)
{
    setObjectName(name);
    setAccessibleName(title);
    setDecimals(1);
    setRange(0, most);
    setSuffix(unit);
    setSpecialValueText(none);
    setKeyboardTracking(false);  // not of every digit
}

std::optional<double> FormNumber::number() const
{
    return value() > 0 ? std::optional(value()) : std::nullopt;
}

void FormNumber::show(const std::optional<double>& number)
{
    if (hasFocus() && lineEdit()->isModified())
        return;
    const bool blocked = blockSignals(true);
    setValue(number.value_or(0));
    blockSignals(blocked);
}

void FormNumber::setNone(const QString& words, const std::optional<double>& number)
{
    setSpecialValueText(words);
    none_is_ = number;
}

void FormNumber::stepBy(int steps)
{
    if (number() || !none_is_)
        QDoubleSpinBox::stepBy(steps);
    else
        setValue((steps > 0 ? std::floor(*none_is_) : std::ceil(*none_is_)) + steps);
}

void FormNumber::wheelEvent(QWheelEvent* event)
{
    event->ignore();
}

FormText::FormText(const char* name, const QString& title, int lines, QWidget* parent) : QPlainTextEdit(parent)
{
    setObjectName(name);
    setAccessibleName(title);
    setTabChangesFocus(true);
    const int frame_px = 2 * (frameWidth() + int(document()->documentMargin()));
    setFixedHeight(lines * fontMetrics().lineSpacing() + frame_px);
}

void FormText::show(const std::string& saved, const std::string& of)
{
    if (unsaved() && words() != saved && of == of_)
        return;
    of_ = of;
    if (words() != saved)
        setPlainText(QString::fromStdString(saved));
    document()->setModified(false);
}

std::string FormText::words() const
{
    return toPlainText().trimmed().toStdString();
}

void FormText::focusOutEvent(QFocusEvent* event)
{
    QPlainTextEdit::focusOutEvent(event);
    if (unsaved())
        emit entered();
}

}  // namespace vicon::viewer
