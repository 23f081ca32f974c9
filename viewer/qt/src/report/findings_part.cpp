#include "report/findings_part.h"

#include <QCheckBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "report/form_parts.h"
#include "vicon/cases/printed.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

enum Column { kNumber, kWhat, kPart, kSize, kSeenIn, kColumns };
constexpr int kLeastFindings = 3;
constexpr double kMostSize_mm = 300;

QString words(const std::string& utf8)
{
    return QString::fromStdString(utf8);
}

/// The positions whose scans show it, each once.
QString seenIn(const ReadCase& read, const FindingFacts& facts)
{
    QStringList positions;
    for (const ScanRecord& scan : read.scans)
        for (const FindingSight& sight : facts.sights)
            if (sight.scan_id == scan.id)
                positions << words(positionName(scan.series.patient_position));
    positions.removeDuplicates();
    return positions.join(", ");
}

QStringList cellsOf(const ReadCase& read, const FindingWithFacts& one)
{
    const FindingSight* lead = one.facts.lead();
    return {QString::number(one.finding.number()), words(nameOf(one.finding.kind)),
            lead && lead->part ? words(nameOf(*lead->part)) : QString(),
            one.facts.size_mm ? QString::number(*one.facts.size_mm, 'f', 1) : QString(), seenIn(read, one.facts)};
}

QString factsText(const FindingFacts& facts)
{
    const FindingSight* lead = facts.lead();
    if (!lead)
        return QObject::tr("No marker shows it any more.");
    QStringList lines{QObject::tr("%1 cm from the rectum").arg(lead->station_mm / 10, 0, 'f', 0)};
    if (facts.endoscope)
        lines << QObject::tr("endoscope about %1 cm (%2 to %3)")
                     .arg(facts.endoscope->about_mm / 10, 0, 'f', 0)
                     .arg(facts.endoscope->least_mm / 10, 0, 'f', 0)
                     .arg(facts.endoscope->most_mm / 10, 0, 'f', 0);
    if (lead->clock_hour)
        lines << QObject::tr("at %1 o'clock").arg(*lead->clock_hour);
    if (facts.size_2d_mm)
        lines << QObject::tr("2D %1 mm").arg(*facts.size_2d_mm, 0, 'f', 1);
    if (facts.size_3d_mm)
        lines << QObject::tr("3D %1 mm").arg(*facts.size_3d_mm, 0, 'f', 1);
    if (facts.mean_hu)
        lines << QObject::tr("%1 HU").arg(*facts.mean_hu, 0, 'f', 0);
    return lines.join("\n");
}

}  // namespace

FindingsPart::FindingsPart(QWidget* parent) : QWidget(parent)
{
    build();
    buildEditor();
    connectEditor();
}

void FindingsPart::build()
{
    table_ = new QTableWidget(0, kColumns, this);
    table_->setObjectName("findings");
    table_->setAccessibleName(tr("Findings"));
    table_->setToolTip(tr("Click or Return: fly there"));
    table_->setHorizontalHeaderLabels({tr("No."), tr("What"), tr("Segment"), tr("mm"), tr("Seen in")});
    setUpList(table_, kLeastFindings);
    for (int column = 0; column < kSeenIn; ++column)
        table_->horizontalHeader()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    loose_ = new QLabel(this);
    loose_->setObjectName("looseMarkers");
    loose_->setWordWrap(true);
    const auto button = [this](const char* name, const QString& title, const QString& tip) {
        auto* made = new QPushButton(title, this);
        made->setObjectName(name);
        made->setToolTip(tip);
        return made;
    };
    add_ = button("findingAdd", tr("&New from markers"),
                  tr("Every marker that belongs to no finding, with the one it is paired with, becomes a finding"));
    join_ = button("findingJoin", tr("&Join marker"), tr("The marker chosen in the list of markers shows it as well"));
    remove_ = button("findingRemove", tr("&Remove"), tr("Remove the finding; its markers stay"));
    auto* buttons = new QHBoxLayout;
    for (QPushButton* one : {add_, join_, remove_})
        buttons->addWidget(one);
    auto* all = new QVBoxLayout(this);
    all->setContentsMargins(0, 0, 0, 0);
    all->addWidget(table_);
    all->addWidget(loose_);
    all->addLayout(buttons);
}

void FindingsPart::buildEditor()
{
    const QString open = tr("not said");
    editor_ = new QWidget(this);
    picture_ = new QLabel(this);
    picture_->setObjectName("findingPicture");
    picture_->setAlignment(Qt::AlignCenter);
    facts_ = new QLabel(this);
    facts_->setObjectName("findingFacts");
    facts_->setAlignment(Qt::AlignTop);
    facts_->setWordWrap(true);
    kind_ = new FormChoice("findingKind", tr("What it is"), findingKindNames(), {}, editor_);
    morphology_ = new FormChoice("morphology", tr("Morphology"), morphologyNames(), open, editor_);
    size_ = new FormNumber("findingSize", tr("Size"), kMostSize_mm, tr(" mm"), {}, editor_);
    height_ = new FormNumber("findingHeight", tr("Height"), kMostSize_mm, tr(" mm"), open, editor_);
    attenuation_ = new FormChoice("attenuation", tr("Attenuation"), attenuationNames(), open, editor_);
    confidence_ = new FormChoice("confidence", tr("Confidence"), confidenceNames(), open, editor_);
    narrows_ = new QCheckBox(tr("narrows the lumen"), editor_);
    narrows_->setObjectName("narrows");
    invades_ = new QCheckBox(tr("reaches beyond the wall"), editor_);
    invades_->setObjectName("invades");
    note_ = new FormText("findingNote", tr("Note"), 2, editor_);
    auto* form = new QFormLayout(editor_);
    form->setContentsMargins(0, 0, 0, 0);
    form->addRow(tr("What it is"), kind_);
    form->addRow(tr("Morphology"), morphology_);
    form->addRow(tr("Size"), size_);
    form->addRow(tr("Height"), height_);
    form->addRow(tr("Attenuation"), attenuation_);
    form->addRow(tr("Confidence"), confidence_);
    form->addRow(narrows_, invades_);
    form->addRow(tr("Note"), note_);
    auto* top = new QHBoxLayout;
    top->addWidget(picture_);
    top->addWidget(facts_, 1);
    auto* all = static_cast<QVBoxLayout*>(layout());
    all->addLayout(top);
    all->addWidget(editor_);
}

void FindingsPart::connectEditor()
{
    connect(table_, &QTableWidget::itemSelectionChanged, this, &FindingsPart::choose);
    for (const auto signal : {&QTableWidget::cellClicked, &QTableWidget::cellActivated})
        connect(table_, signal, this, [this] {
            const FindingWithFacts* one = chosen();
            if (one && one->facts.lead())
                emit flyWanted(words(one->facts.lead()->marker_id));
        });
    connect(add_, &QPushButton::clicked, this, [this] { emit addWanted(read_.loose_markers); });
    connect(join_, &QPushButton::clicked, this, [this] { emit joinWanted(chosen_); });
    connect(remove_, &QPushButton::clicked, this, [this] { emit removeWanted(chosen_); });
    connect(kind_, &FormChoice::chosen, this,
            [this] { change([name = kind_->value()](Finding& f) { f.kind = findingKindFrom(name.value_or("")); }); });
    const auto choice = [this](FormChoice* from, auto field, auto valueOf) {
        connect(from, &FormChoice::chosen, this, [this, from, field, valueOf] {
            change([name = from->value(), field, valueOf](Finding& f) {
                f.*field = name ? std::optional(valueOf(*name)) : std::nullopt;
            });
        });
    };
    choice(morphology_, &Finding::morphology, morphologyFrom);
    choice(attenuation_, &Finding::attenuation, attenuationFrom);
    choice(confidence_, &Finding::confidence, confidenceFrom);
    const auto number = [this](FormNumber* from, std::optional<double> Finding::*field) {
        connect(from, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
                [this, from, field] { change([value = from->number(), field](Finding& f) { f.*field = value; }); });
    };
    number(size_, &Finding::read_size_mm);
    number(height_, &Finding::height_mm);
    const auto tick = [this](QCheckBox* from, bool Finding::*field) {
        connect(from, &QCheckBox::clicked, this,
                [this, field](bool on) { change([on, field](Finding& f) { f.*field = on; }); });
    };
    tick(narrows_, &Finding::narrows_lumen);
    tick(invades_, &Finding::invades);
    connect(note_, &FormText::entered, this,
            [this] { change([text = note_->words()](Finding& f) { f.note = text; }); });
}

void FindingsPart::change(const std::function<void(Finding&)>& what)
{
    if (!filling_ && !chosen_.empty())
        emit changed(chosen_, what);
}

const FindingWithFacts* FindingsPart::chosen() const
{
    for (const FindingWithFacts& one : read_.findings)
        if (one.finding.id == chosen_)
            return &one;
    return nullptr;
}

void FindingsPart::show(const ReadCase& read)
{
    // A finding that came is the one that is worked on.
    const bool grown = read.findings.size() > read_.findings.size() && !read_.record.id.empty();
    read_ = read;
    if (grown || (!chosen() && !read_.findings.empty()))
        chosen_ = grown ? read_.findings.back().finding.id : read_.findings.front().finding.id;
    filling_ = true;
    table_->setRowCount(int(read_.findings.size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
        const QStringList cells = cellsOf(read_, read_.findings[std::size_t(row)]);
        for (int column = 0; column < kColumns; ++column)
            table_->setItem(row, column, new QTableWidgetItem(cells[column]));
        if (read_.findings[std::size_t(row)].finding.id == chosen_)
            table_->selectRow(row);
    }
    QStringList loose;
    for (const std::string& id : read_.loose_markers)
        loose << words(id);
    loose_->setText(tr("Markers not assigned to a finding: %1").arg(loose.join(", ")));
    loose_->setVisible(!loose.empty());
    filling_ = false;
    showChosen();
}

void FindingsPart::choose()
{
    const auto rows = table_->selectionModel()->selectedRows();
    if (filling_ || rows.empty() || rows.front().row() >= int(read_.findings.size()))
        return;
    chosen_ = read_.findings[std::size_t(rows.front().row())].finding.id;
    showChosen();
}

void FindingsPart::showChosen()
{
    const FindingWithFacts* one = chosen();
    editor_->setVisible(one);
    facts_->setVisible(one);
    picture_->setVisible(one && pictured_ == pictureOf(*one) && picture_->pixmap(Qt::ReturnByValue).width() > 0);
    add_->setEnabled(!read_.loose_markers.empty());
    join_->setEnabled(one);
    remove_->setEnabled(one);
    if (!one)
        return;
    filling_ = true;
    const Finding& f = one->finding;
    const auto nameIn = [](const auto& value) { return value ? std::optional(nameOf(*value)) : std::nullopt; };
    kind_->setValue(nameOf(f.kind));
    morphology_->setValue(nameIn(f.morphology));
    attenuation_->setValue(nameIn(f.attenuation));
    confidence_->setValue(nameIn(f.confidence));
    const bool measured = one->facts.size_mm && one->facts.size_source != SizeSource::reader;
    size_->setNone(measured ? tr("as measured: %1 mm").arg(*one->facts.size_mm, 0, 'f', 1) : tr("not measured"),
                   measured ? one->facts.size_mm : std::nullopt);
    size_->show(f.read_size_mm);
    height_->show(f.height_mm);
    narrows_->setChecked(f.narrows_lumen);
    invades_->setChecked(f.invades);
    note_->show(f.note, f.id);
    facts_->setText(factsText(one->facts));
    filling_ = false;
    if (pictured_ != pictureOf(*one))
        askForPicture();
}

bool FindingsPart::unsaved() const
{
    return note_->unsaved();
}

void FindingsPart::setReadOnly(bool on)
{
    for (QPushButton* button : {add_, join_, remove_})
        button->setVisible(!on);
    editor_->setEnabled(!on);
}

}  // namespace vicon::viewer
