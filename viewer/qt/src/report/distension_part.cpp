#include "report/distension_part.h"

#include <QGridLayout>
#include <QLabel>
#include <algorithm>

#include "report/form_parts.h"
#include "vicon/cases/printed.h"

namespace vicon::viewer {

DistensionPart::DistensionPart(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this))
{
    grid_->setContentsMargins(0, 0, 0, 0);
}

void DistensionPart::show(const ReadCase& read)
{
    if (choices_.empty())
        build(read);
    for (auto& [place, choice] : choices_) {
        const auto state = std::find_if(read.parts.begin(), read.parts.end(),
                                        [&, at = place](const PartState& s) { return Place(s.scan_id, s.part) == at; });
        const bool known = state != read.parts.end(), said = known && state->by_reader;
        const std::string name = known ? nameOf(state->distension) : std::string();
        choice->setItemText(0, said    ? tr("as measured")
                               : known ? tr("%1, measured").arg(QString::fromStdString(name))
                                       : tr("not measured"));
        choice->setValue(said ? std::optional(name) : std::nullopt);
    }
}

void DistensionPart::build(const ReadCase& read)
{
    for (std::size_t part = 0; part <= std::size_t(ColonPart::caecum); ++part)
        grid_->addWidget(new QLabel(QString::fromStdString(nameOf(ColonPart(part))), this), 1 + int(part), 0);
    int column = 1;
    for (const ScanRecord& scan : read.scans) {
        const QString position = QString::fromStdString(positionName(scan.series.patient_position));
        grid_->addWidget(new QLabel(position, this), 0, column);
        for (std::size_t part = 0; part <= std::size_t(ColonPart::caecum); ++part) {
            const Place place{scan.id, ColonPart(part)};
            choices_[place] = add(place, 1 + int(part), column, position);
        }
        ++column;
    }
}

FormChoice* DistensionPart::add(const Place& place, int row, int column, const QString& position)
{
    const QString part = QString::fromStdString(nameOf(place.second));
    auto* choice =
        new FormChoice(qPrintable("distension-" + part + "-" + position),
                       tr("Distension of the %1, %2").arg(part, position), distensionNames(), tr("as measured"), this);
    grid_->addWidget(choice, row, column);
    connect(choice, &FormChoice::chosen, this, [this, choice, place] {
        emit said([name = choice->value(), place](Assessment& a) {
            std::erase_if(a.distension, [&](const PartDistension& d) { return Place(d.scan_id, d.part) == place; });
            if (name)
                a.distension.push_back({place.first, place.second, distensionFrom(*name)});
        });
    });
    return choice;
}

}  // namespace vicon::viewer
