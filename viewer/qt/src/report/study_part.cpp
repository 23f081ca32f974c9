#include "report/study_part.h"

#include <QCheckBox>
#include <QFormLayout>

#include "report/form_parts.h"

namespace vicon::viewer {

StudyPart::StudyPart(QWidget* parent) : QWidget(parent)
{
    auto* form = new QFormLayout(this);
    form->setContentsMargins(0, 0, 0, 0);
    addTexts();
    addGrades();
    addFigures();
}

void StudyPart::addTexts()
{
    const auto add = [this](const char* name, const QString& title, std::string Assessment::*field) {
        auto* text = new FormText(name, title, 2, this);
        static_cast<QFormLayout*>(layout())->addRow(title, text);
        texts_.emplace_back(text, field);
        connect(text, &FormText::entered, this, [this, text, field] {
            emit said([words = text->words(), field](Assessment& a) { a.*field = words; });
        });
        return text;
    };
    add("impression", tr("Impression"), &Assessment::impression)
        ->setPlaceholderText(tr("as it follows from findings and category"));
    add("recommendation", tr("Recommendation"), &Assessment::recommendation)
        ->setPlaceholderText(tr("the usual one of the category"));
    add("indication", tr("Indication"), &Assessment::indication);
    add("technique", tr("Technique"), &Assessment::technique);
    add("comparison", tr("Comparison"), &Assessment::comparison);
}

void StudyPart::addGrades()
{
    auto* form = static_cast<QFormLayout*>(layout());
    const auto grade = [&](const char* name, const QString& title, std::optional<Grade> Assessment::*field) {
        auto* choice = new FormChoice(name, title, gradeNames(), tr("not said"), this);
        form->addRow(title, choice);
        grades_.emplace_back(choice, field);
        connect(choice, &FormChoice::chosen, this, [this, choice, field] {
            emit said([name = choice->value(), field](Assessment& a) {
                a.*field = name ? std::optional(gradeFrom(*name)) : std::nullopt;
            });
        });
    };
    grade("preparation", tr("Preparation"), &Assessment::preparation);
    grade("tagging", tr("Tagging"), &Assessment::tagging);
    const auto tick = [&](const char* name, const QString& title, bool Assessment::*field) {
        auto* box = new QCheckBox(title, this);
        box->setObjectName(name);
        form->addRow(box);
        ticks_.emplace_back(box, field);
        connect(box, &QCheckBox::clicked, this,
                [this, field](bool on) { emit said([on, field](Assessment& a) { a.*field = on; }); });
    };
    tick("inadequate", tr("a lesion of 10 mm or more cannot be excluded"), &Assessment::inadequate);
    tick("priorsAwaited", tr("earlier studies are awaited"), &Assessment::priors_awaited);
}

void StudyPart::addFigures()
{
    const auto add = [this](const char* name, const QString& title, double most, const QString& unit,
                            std::optional<double> Assessment::*field) {
        auto* number = new FormNumber(name, title, most, unit, tr("not said"), this);
        static_cast<QFormLayout*>(layout())->addRow(title, number);
        figures_.emplace_back(number, field);
        connect(number, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, number, field] {
            emit said([value = number->number(), field](Assessment& a) { a.*field = value; });
        });
    };
    add("dose", tr("Dose"), 100'000, tr(" mGy cm"), &Assessment::dose_mgy_cm);
    add("coverage", tr("Wall reviewed"), 100, tr(" %"), &Assessment::coverage_percent);
    add("minutes", tr("Reading time"), 1000, tr(" min"), &Assessment::reading_minutes);
}

void StudyPart::show(const ReadCase& read, const KnownStudy& known)
{
    const Assessment& said = read.assessment;
    for (const auto& [text, field] : texts_)
        for (const auto& [known_field, words] :
             {std::pair(&Assessment::indication, known.indication), std::pair(&Assessment::technique, known.technique)})
            if (field == known_field)
                text->setPlaceholderText(QString::fromStdString(words));
    const QString fluid = QString::fromStdString(known.fluid);
    for (const auto& [choice, field] : grades_)
        choice->setItemText(0, fluid.isEmpty() ? tr("not said") : tr("not said; tagged fluid %1").arg(fluid));
    for (const auto& [text, field] : texts_)
        text->show(said.*field);
    for (const auto& [choice, field] : grades_)
        choice->setValue(said.*field ? std::optional(nameOf(*(said.*field))) : std::nullopt);
    for (const auto& [number, field] : figures_)
        number->show(said.*field);
    for (const auto& [box, field] : ticks_)
        box->setChecked(said.*field);
}

bool StudyPart::unsaved() const
{
    return std::any_of(texts_.begin(), texts_.end(), [](const auto& one) { return one.first->unsaved(); });
}

void fillAsNormal(Assessment& said, const ReportTexts& texts)
{
    const std::pair<std::string Assessment::*, const std::string*> usual[] = {
        {&Assessment::indication, &texts.indication},
        {&Assessment::technique, &texts.technique},
        {&Assessment::comparison, &texts.comparison},
        {&Assessment::impression, &texts.impression},
        {&Assessment::recommendation, &texts.recommendation}};
    for (const auto& [field, text] : usual)
        if ((said.*field).empty())
            said.*field = *text;
    for (const auto grade : {&Assessment::preparation, &Assessment::tagging})
        if (!(said.*grade))
            said.*grade = Grade::good;
}

}  // namespace vicon::viewer
