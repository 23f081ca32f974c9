#include "report/category_part.h"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>

#include "report/form_parts.h"

namespace vicon::viewer {

CategoryPart::CategoryPart(const std::string& name, const QString& title, const std::vector<std::string>& categories,
                           QWidget* parent)
    : QWidget(parent)
{
    choice_ = new FormChoice((name + "Choice").c_str(), title, categories, tr("not chosen"), this);
    reason_ = new QLabel(this);
    reason_->setObjectName(QString::fromStdString(name + "Reason"));
    reason_->setWordWrap(true);
    why_ = new QLineEdit(this);
    why_->setObjectName(QString::fromStdString(name + "Why"));
    why_->setAccessibleName(tr("Why it is not the proposed one"));
    why_->setPlaceholderText(tr("why it is not the proposed one"));
    auto* label = new QLabel(title, this);
    label->setBuddy(choice_);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setColumnStretch(1, 1);
    grid->addWidget(label, 0, 0);
    grid->addWidget(choice_, 0, 1);
    grid->addWidget(why_, 1, 0, 1, 2);
    grid->addWidget(reason_, 2, 0, 1, 2);
    connect(choice_, &FormChoice::chosen, this, &CategoryPart::choose);
    connect(why_, &QLineEdit::editingFinished, this, [this] {
        if (why_->isModified())
            choose();
    });
}

bool CategoryPart::needsWhy() const
{
    return choice_->value() && choice_->value() != shown_.proposed;
}

void CategoryPart::choose()
{
    showWhy();
    const std::string why = needsWhy() ? why_->text().trimmed().toStdString() : std::string();
    if (needsWhy() && why.empty()) {
        why_->setFocus();
        return;
    }
    why_->setModified(false);
    emit chosen(choice_->value(), why);
}

void CategoryPart::showWhy()
{
    why_->setVisible(needsWhy());
}

void CategoryPart::show(const State& state)
{
    shown_ = state;
    reason_->setText(
        state.proposed
            ? tr("Proposed: %1. %2").arg(QString::fromStdString(*state.proposed), QString::fromStdString(state.reason))
            : QString::fromStdString(state.reason));
    if (why_->hasFocus())
        return;  // a choice that waits for its reason
    choice_->setValue(state.chosen);
    why_->setText(QString::fromStdString(state.why));
    showWhy();
}

}  // namespace vicon::viewer
