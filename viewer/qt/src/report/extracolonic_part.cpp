#include "report/extracolonic_part.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>

#include "report/form_parts.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {
constexpr int kLeastOutside = 2;

std::vector<std::string> categoryNames()
{
    return {nameOf(ExtracolonicCategory::e1), nameOf(ExtracolonicCategory::e3), nameOf(ExtracolonicCategory::e4)};
}
}  // namespace

ExtracolonicPart::ExtracolonicPart(QWidget* parent) : QWidget(parent)
{
    build();
    connect(add_, &QPushButton::clicked, this, &ExtracolonicPart::add);
    connect(remove_, &QPushButton::clicked, this, &ExtracolonicPart::remove);
    for (QLineEdit* line : {organ_, text_})
        connect(line, &QLineEdit::returnPressed, this, &ExtracolonicPart::add);
    connect(limited_, &QCheckBox::clicked, this,
            [this](bool on) { emit said([on](Assessment& a) { a.extracolonic_limited = on; }); });
}

void ExtracolonicPart::build()
{
    table_ = new QTableWidget(0, 3, this);
    table_->setObjectName("extracolonic");
    table_->setAccessibleName(tr("Findings outside the colon"));
    table_->setHorizontalHeaderLabels({tr("Category"), tr("Organ"), tr("Finding")});
    setUpList(table_, kLeastOutside);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    category_ = new FormChoice("extracolonicCategory", tr("Category of the finding"), categoryNames(), {}, this);
    const auto line = [this](const char* name, const QString& title) {
        auto* made = new QLineEdit(this);
        made->setObjectName(name);
        made->setAccessibleName(title);
        made->setPlaceholderText(title);
        return made;
    };
    organ_ = line("extracolonicOrgan", tr("Organ"));
    text_ = line("extracolonicText", tr("Finding"));
    add_ = new QPushButton(tr("Add"), this);
    add_->setObjectName("extracolonicAdd");
    remove_ = new QPushButton(tr("Remove"), this);
    remove_->setObjectName("extracolonicRemove");
    limited_ = new QCheckBox(tr("what lies outside cannot be judged (E0)"), this);
    limited_->setObjectName("extracolonicLimited");
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->addWidget(table_, 0, 0, 1, 4);
    grid->addWidget(category_, 1, 0);
    grid->addWidget(organ_, 1, 1);
    grid->addWidget(text_, 1, 2, 1, 2);
    grid->addWidget(limited_, 2, 0, 1, 2);
    grid->addWidget(add_, 2, 2);
    grid->addWidget(remove_, 2, 3);
}

void ExtracolonicPart::add()
{
    const std::string organ = organ_->text().trimmed().toStdString(), text = text_->text().trimmed().toStdString();
    if (organ.empty() || text.empty()) {
        (organ.empty() ? organ_ : text_)->setFocus();
        return;
    }
    const ExtracolonicFinding finding{organ, text, extracolonicCategoryFrom(category_->value().value_or(""))};
    emit said([finding](Assessment& a) { a.extracolonic.push_back(finding); });
    organ_->clear();
    text_->clear();
    organ_->setFocus();
}

void ExtracolonicPart::remove()
{
    const auto rows = table_->selectionModel()->selectedRows();
    if (rows.empty())
        return;
    emit said([row = std::size_t(rows.front().row())](Assessment& a) {
        if (row < a.extracolonic.size())
            a.extracolonic.erase(a.extracolonic.begin() + std::ptrdiff_t(row));
    });
}

void ExtracolonicPart::show(const ReadCase& read)
{
    const auto& all = read.assessment.extracolonic;
    table_->setVisible(!all.empty());
    remove_->setVisible(!all.empty());
    table_->setRowCount(int(all.size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
        const ExtracolonicFinding& one = all[std::size_t(row)];
        int column = 0;
        for (const std::string& cell : {nameOf(one.category), one.organ, one.text})
            table_->setItem(row, column++, new QTableWidgetItem(QString::fromStdString(cell)));
    }
    limited_->setChecked(read.assessment.extracolonic_limited);
}

}  // namespace vicon::viewer
