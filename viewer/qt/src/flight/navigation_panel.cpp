#include "flight/navigation_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <algorithm>

#include "vicon/viewer/model/annotate.h"

namespace vicon::viewer {
namespace {
constexpr double kButtonStep_mm = 10;
constexpr int kButtonsInRow = 4;

QString placeText(double station_mm, double length_mm, const OrganWords& words)
{
    const auto texts = stationTexts(station_mm, length_mm, words);
    return QString::fromStdString(texts[0]) + ", " + QString::fromStdString(texts[1]);
}

/// For as many digits as any colon needs: no view changes its size when a distance gets one more.
int roomForPlace_px(const QFontMetrics& letters)
{
    constexpr double kFourDigits_mm = 4000;
    return letters.horizontalAdvance(placeText(kFourDigits_mm, 2 * kFourDigits_mm, wordsFor(Organ())) + "0");
}

/// As endoscopists say it of a colon.
QString wayOfFlight(Heading heading, const OrganWords& words)
{
    const bool to_last = heading == Heading::caecum;
    if (!words.has_path)
        return QObject::tr("No centreline");
    if (words.organ.isColon())
        return to_last ? QObject::tr("Retrograde") : QObject::tr("Antegrade");
    return QObject::tr("Heading: %1").arg(QString::fromStdString(to_last ? words.last_end : words.first_end));
}

template <class Widget>
Widget* named(Widget* widget, const char* name, const QString& title, const QString& tip)
{
    widget->setObjectName(name);
    widget->setAccessibleName(title);
    widget->setToolTip(tip);
    return widget;
}

}  // namespace

NavigationPanel::NavigationPanel(QWidget* parent) : QWidget(parent)
{
    setObjectName("navigation");
    buildButtons();
    buildSliders();
    buildPlace();
    layOut();
    connectAll();
}

void NavigationPanel::buildButtons()
{
    const auto button = [this](const QString& face, const char* name, const QString& title, const QString& tip) {
        return named(new QPushButton(face, this), name, title, tip);
    };
    mode_ = named(new QComboBox(this), "mode", tr("Kind of flight"),
                  tr("Planned: along the centreline (P). Guided: steered, back on it when let go (G). Free (F)."));
    mode_->addItems({tr("planned"), tr("guided"), tr("free")});
    back_ = button(tr("Back"), "back", tr("Fly back"), tr("Fly backwards"));
    stop_ = button(tr("Stop"), "stop", tr("Stop"), tr("Stop (Space)"));
    forward_ = button(tr("Fly"), "forward", tr("Fly on"), tr("Fly the way that is chosen (Space)"));
    about_ = button(tr("Reverse"), "about", tr("Way of flight"),
                    tr("Which way the flight goes: retrograde to the caecum, antegrade to the rectum; reverse it (R)"));
    look_back_ = button(tr("Look back"), "lookBack", tr("Look back"), tr("Look back while flying on, planned (B)"));
    look_back_->setCheckable(true);
    step_back_ = button(tr("-1 cm"), "stepBack", tr("A centimetre back"), tr("A centimetre back (,)"));
    step_on_ = button(tr("+1 cm"), "stepOn", tr("A centimetre on"), tr("A centimetre on (.)"));
}

void NavigationPanel::buildSliders()
{
    speed_ = named(new QSlider(Qt::Horizontal, this), "speed", tr("Speed"), tr("Speed of flight (+, -)"));
    speed_->setRange(int(Navigator::kLeastSpeed_mm_s), int(Navigator::kMostSpeed_mm_s));
    speed_text_ = new QLabel(this);
    angle_ = named(new QSlider(Qt::Horizontal, this), "angle", tr("Field of view"),
                   tr("Field of view: narrow is true to shape, wide sees more of the wall"));
    angle_->setRange(60, 120);
    angle_text_ = new QLabel(this);
}

void NavigationPanel::buildPlace()
{
    station_ = named(new QDoubleSpinBox(this), "station", tr("Distance to jump to"), {});
    station_->setDecimals(0);
    station_->setSuffix(tr(" mm"));
    station_->setKeyboardTracking(false);
    go_ = named(new QPushButton(tr("Jump"), this), "jump", tr("Jump to this distance"), {});
    where_ = named(new QLabel(this), "where", tr("Place"), tr("Where the eye is"));
    where_->setMinimumWidth(roomForPlace_px(where_->fontMetrics()));
}

void NavigationPanel::layOut()
{
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    for (int column = 0; column < kButtonsInRow; ++column)
        grid->setColumnStretch(column, 1);
    auto* title = new QHBoxLayout;
    title->addWidget(new QLabel(tr("Flight"), this));
    title->addStretch();
    title->addWidget(where_);
    grid->addLayout(title, 0, 0, 1, kButtonsInRow);
    QWidget* const rows[][kButtonsInRow] = {{mode_, back_, stop_, forward_},
                                            {about_, look_back_, step_back_, step_on_},
                                            {speed_, speed_text_, angle_, angle_text_}};
    int row = 1;
    for (const auto& controls : rows) {
        for (int column = 0; column < kButtonsInRow; ++column)
            grid->addWidget(controls[column], row, column);
        ++row;
    }
    grid->addWidget(station_, row, 0, 1, kButtonsInRow - 1);
    grid->addWidget(go_, row, kButtonsInRow - 1);
}

void NavigationPanel::connectAll()
{
    connect(angle_, &QSlider::valueChanged, this, [this](int degrees) { emit angleWanted(degrees); });
    connect(mode_, qOverload<int>(&QComboBox::activated), this,
            [this](int index) { emit modeWanted(NavigationMode(index)); });
    connect(back_, &QPushButton::clicked, this, [this] { emit flyWanted(-1); });
    connect(stop_, &QPushButton::clicked, this, [this] { emit flyWanted(0); });
    connect(forward_, &QPushButton::clicked, this, [this] { emit flyWanted(1); });
    connect(about_, &QPushButton::clicked, this, &NavigationPanel::turnAboutWanted);
    connect(look_back_, &QPushButton::clicked, this, &NavigationPanel::lookBackWanted);
    connect(step_back_, &QPushButton::clicked, this, [this] { emit stepWanted(-kButtonStep_mm); });
    connect(step_on_, &QPushButton::clicked, this, [this] { emit stepWanted(kButtonStep_mm); });
    connect(speed_, &QSlider::valueChanged, this, [this](int mm_s) { emit speedWanted(mm_s); });
    connect(go_, &QPushButton::clicked, this, &NavigationPanel::jump);
    connect(station_->findChild<QLineEdit*>(), &QLineEdit::returnPressed, this, &NavigationPanel::jump);
}

void NavigationPanel::jump()
{
    station_->interpretText();  // a click on the button leaves the keyboard, and what was typed, in the field
    shown_station_mm_ = station_->value();
    emit jumpWanted(shown_station_mm_);
}

void NavigationPanel::askStation()
{
    station_->setFocus(Qt::ShortcutFocusReason);
    station_->selectAll();
}

void NavigationPanel::forgetStation()
{
    station_->setValue(shown_station_mm_);
}

void NavigationPanel::setAngle(double angle_deg)
{
    const QSignalBlocker quiet(angle_);
    angle_->setValue(int(angle_deg));
    angle_text_->setText(tr("%1° wide").arg(angle_deg, 0, 'f', 0));
}

void NavigationPanel::show(const Navigator& navigator, double length_mm, const OrganWords& words)
{
    const NavigationState state = navigator.state();
    const bool planned = navigator.mode() == NavigationMode::planned;
    mode_->setCurrentIndex(int(navigator.mode()));
    for (QWidget* of_path :
         std::initializer_list<QWidget*>{mode_, back_, stop_, forward_, about_, look_back_, station_, go_})
        of_path->setEnabled(words.has_path);
    look_back_->setChecked(planned && navigator.looksBack());
    const QString first = QString::fromStdString(words.first_end);
    about_->setText(wayOfFlight(navigator.heading(), words));
    for (QWidget* widget : std::initializer_list<QWidget*>{station_, go_})
        widget->setToolTip(tr("Jump to this distance from the %1").arg(first));
    {
        const QSignalBlocker quiet(speed_);
        speed_->setValue(int(navigator.speed_mm_s()));
    }
    speed_->setEnabled(navigator.mode() != NavigationMode::guided);
    speed_text_->setText(tr("%1 mm/s").arg(navigator.speed_mm_s(), 0, 'f', 0));
    station_->setRange(0, length_mm);
    shown_station_mm_ = std::min(shown_station_mm_, station_->maximum());   // a shorter path changes the value as well
    if (!station_->hasFocus() && station_->value() == shown_station_mm_) {  // what was typed stays until it is used
        station_->setValue(state.station_mm);
        shown_station_mm_ = station_->value();
    }
    where_->setText(words.has_path ? placeText(state.station_mm, length_mm, words)
                                   : tr("%1 mm from the wall").arg(state.clearance_mm, 0, 'f', 0));
}

}  // namespace vicon::viewer
