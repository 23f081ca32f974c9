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
constexpr double kMostOffset_mm = 20;
}  // namespace

PeelingPanel::PeelingPanel(QWidget* parent) : QWidget(parent)
{
    preset_ = new QComboBox(this);
    preset_->setObjectName("peel");
    preset_->setAccessibleName(tr("Look below the wall"));
    preset_->setToolTip(tr("Colours of the look below the wall"));
    preset_->addItem(tr("no peeling"), QString());
    for (const TransferFunction& function : transferFunctions())
        preset_->addItem(QString::fromStdString(function.title), QString::fromStdString(function.name));
    circle_ = new QCheckBox(tr("only in a circle"), this);
    circle_->setObjectName("peelCircle");
    circle_->setToolTip(tr("Peel in a circle that follows the mouse; the surface stays around it"));
    offset_ = new QSlider(Qt::Horizontal, this);
    offset_->setObjectName("peelOffset");
    offset_->setAccessibleName(tr("Depth of the look below the wall"));
    offset_->setToolTip(tr("How far below the surface the look begins"));
    offset_->setRange(0, int(kMostOffset_mm / kTick_mm));
    offset_text_ = new QLabel(this);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    auto* title = new QLabel(tr("Below the wall"), this);
    title->setBuddy(preset_);
    grid->addWidget(title, 0, 0);
    grid->addWidget(preset_, 0, 1);
    grid->addWidget(circle_, 0, 2);
    grid->addWidget(offset_, 1, 0, 1, 2);
    grid->addWidget(offset_text_, 1, 2);
    grid->setColumnStretch(1, 1);
    histogram_ = new QLabel(this);
    histogram_->setObjectName("histogram");
    histogram_->setAccessibleName(tr("Densities of the virtual biopsy"));
    histogram_->setAlignment(Qt::AlignCenter);
    histogram_->hide();
    const auto tell = [this] {
        offset_->setEnabled(on());
        circle_->setEnabled(on());
        offset_text_->setText(tr("%1 mm deep").arg(offset_->value() * kTick_mm, 0, 'f', 1));
        emit changed();
    };
    connect(preset_, qOverload<int>(&QComboBox::currentIndexChanged), this, tell);
    connect(offset_, &QSlider::valueChanged, this, tell);
    connect(circle_, &QCheckBox::toggled, this, tell);
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

void PeelingPanel::choose(const QString& preset, double offset_mm, bool circle_only)
{
    preset_->setCurrentIndex(std::max(0, preset_->findData(preset)));
    offset_->setValue(int(std::lround(offset_mm / kTick_mm)));
    circle_->setChecked(circle_only);
}

bool PeelingPanel::circleOnly() const
{
    return circle_->isChecked();
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
    request.peel = preset_->currentData().toString().toStdString();
    request.peeling.offset_mm = offset_->value() * kTick_mm;
    request.peel_middle_only = circle_->isChecked();
}

void PeelingPanel::showHistogramOn(QWidget* view)
{
    histogram_->setParent(view);
    histogram_->setAttribute(Qt::WA_TransparentForMouseEvents);
    histogram_->hide();
}

}  // namespace vicon::viewer
