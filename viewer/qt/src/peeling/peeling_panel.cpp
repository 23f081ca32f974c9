#include "peeling/peeling_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "vicon/viewer/scene/measures_picture.h"

namespace vicon::viewer {
namespace {
constexpr double kTick_mm = 0.1;
constexpr double kLeastOffset_mm = -10, kMostOffset_mm = 20;
}  // namespace

PeelingPanel::PeelingPanel(QWidget* parent) : QWidget(parent)
{
    setObjectName("peeling");
    preset_ = new QComboBox(this);
    preset_->setObjectName("peel");
    preset_->setAccessibleName(tr("Translucency"));
    preset_->setToolTip(tr("The wall becomes translucent: with which colours the densities behind it are shown"));
    preset_->addItem(tr("off"), QString());
    for (const TransferFunction& function : transferFunctions())
        preset_->addItem(QString::fromStdString(function.title), QString::fromStdString(function.name));
    circle_ = new QCheckBox(tr("only in a circle"), this);
    circle_->setObjectName("peelCircle");
    circle_->setToolTip(tr("Translucent in a circle that follows the mouse; the surface stays around it"));
    over_ = new QCheckBox(tr("over the surface"), this);
    over_->setObjectName("peelOver");
    over_->setToolTip(tr("The surface shines through; else it is gone where it is translucent"));
    offset_ = new QSlider(Qt::Horizontal, this);
    offset_->setObjectName("peelOffset");
    offset_->setAccessibleName(tr("Depth of the translucency"));
    offset_->setToolTip(tr("How far below the surface it begins, or before it"));
    offset_->setRange(int(kLeastOffset_mm / kTick_mm), int(kMostOffset_mm / kTick_mm));
    offset_->setValue(0);
    offset_text_ = new QLabel(this);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    auto* title = new QLabel(tr("Translucency"), this);
    title->setBuddy(preset_);
    grid->addWidget(title, 0, 0);
    grid->addWidget(preset_, 0, 1);
    grid->addWidget(circle_, 0, 2);
    grid->addWidget(offset_text_, 1, 0);
    grid->addWidget(offset_, 1, 1);
    grid->addWidget(over_, 1, 2);
    grid->setColumnStretch(1, 1);
    histogram_ = new QLabel(this);
    histogram_->setObjectName("histogram");
    histogram_->setAccessibleName(tr("Densities of the virtual biopsy"));
    histogram_->setAlignment(Qt::AlignCenter);
    histogram_->hide();
    const auto tell = [this] {
        offset_->setEnabled(on());
        circle_->setEnabled(on());
        over_->setEnabled(on());
        const bool before = offset_->value() < 0;
        offset_text_->setText(
            (before ? tr("%1 mm before") : tr("%1 mm deep")).arg(std::abs(offset_->value()) * kTick_mm, 0, 'f', 1));
        emit changed();
    };
    connect(preset_, qOverload<int>(&QComboBox::currentIndexChanged), this, tell);
    connect(offset_, &QSlider::valueChanged, this, tell);
    connect(circle_, &QCheckBox::toggled, this, tell);
    connect(over_, &QCheckBox::toggled, this, tell);
    tell();
}

bool PeelingPanel::on() const
{
    return !preset_->currentData().toString().isEmpty();
}

QString PeelingPanel::preset() const
{
    return preset_->currentData().toString();
}

double PeelingPanel::offset_mm() const
{
    return offset_->value() * kTick_mm;
}

void PeelingPanel::choose(const QString& preset, double offset_mm, bool circle_only, bool over_surface)
{
    preset_->setCurrentIndex(std::max(0, preset_->findData(preset)));
    offset_->setValue(int(std::lround(offset_mm / kTick_mm)));
    circle_->setChecked(circle_only);
    over_->setChecked(over_surface);
}

bool PeelingPanel::circleOnly() const
{
    return circle_->isChecked();
}

bool PeelingPanel::overSurface() const
{
    return over_->isChecked();
}

void PeelingPanel::showHistogram(const DensitySample& biopsy)
{
    histogram_->setVisible(biopsy.voxels > 0);
    if (biopsy.voxels == 0)
        return;
    constexpr int kMostWidth = 380, kMargin_px = 4;
    const QWidget* view = histogram_->parentWidget();
    const int width = std::min(kMostWidth, view->width() / 2), height = width * 10 / 19;
    const double ratio = devicePixelRatioF();
    const Picture drawn = histogramPicture(biopsy, int(width * ratio), int(height * ratio));
    QImage image(drawn.rgb.data(), drawn.width, drawn.height, 3 * drawn.width, QImage::Format_RGB888);
    image.setDevicePixelRatio(ratio);
    histogram_->setPixmap(QPixmap::fromImage(image));
    histogram_->setGeometry(view->width() - width - kMargin_px, kMargin_px, width, height);
    histogram_->raise();
}

void PeelingPanel::fill(SnapshotRequest& request) const
{
    request.peel.preset = preset_->currentData().toString().toStdString();
    request.peel.options.offset_mm = offset_->value() * kTick_mm;
    request.peel.middle_only = circle_->isChecked();
    request.peel.over_surface = over_->isChecked();
}

void PeelingPanel::showHistogramOn(QWidget* view)
{
    histogram_->setParent(view);
    histogram_->setAttribute(Qt::WA_TransparentForMouseEvents);
    histogram_->hide();
}

}  // namespace vicon::viewer
