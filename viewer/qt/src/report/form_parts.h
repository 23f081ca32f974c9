#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPlainTextEdit>
#include <optional>
#include <string>
#include <vector>

namespace vicon::viewer {

/// A choice among names. The wheel scrolls the form: it changes nothing that the pointer happens to lie on.
class FormChoice : public QComboBox {
    Q_OBJECT
public:
    /// @param none the line for nothing, the first one; empty: there is none
    FormChoice(const char* name, const QString& title, const std::vector<std::string>& names, const QString& none,
               QWidget* parent);

    std::optional<std::string> value() const;
    void setValue(const std::optional<std::string>& value);

signals:
    void chosen();  ///< by the reader

protected:
    void wheelEvent(QWheelEvent* event) override;
};

/// A number, or none; the least one stands for none.
class FormNumber : public QDoubleSpinBox {
    Q_OBJECT
public:
    FormNumber(const char* name, const QString& title, double most, const QString& unit, const QString& none,
               QWidget* parent);

    std::optional<double> number() const;
    /// Not while the reader types.
    void show(const std::optional<double>& number);
    /// What none stands for, where that is a number: the arrows lead on from it, to whole ones.
    void setNone(const QString& words, const std::optional<double>& number);
    void stepBy(int steps) override;

protected:
    void wheelEvent(QWheelEvent* event) override;

private:
    std::optional<double> none_is_;
};

/// Words of a few lines. What the reader typed of one thing stays until it is what is saved of it.
class FormText : public QPlainTextEdit {
    Q_OBJECT
public:
    FormText(const char* name, const QString& title, int lines, QWidget* parent);

    /// @param of what they are said of, where the field is used for several things
    void show(const std::string& saved, const std::string& of = {});
    std::string words() const;
    bool unsaved() const { return document()->isModified(); }

signals:
    void entered();

protected:
    void focusOutEvent(QFocusEvent* event) override;

private:
    std::string of_;
};

}  // namespace vicon::viewer
