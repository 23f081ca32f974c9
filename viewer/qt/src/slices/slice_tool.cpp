#include "slices/slice_tool.h"

#include <QAction>
#include <QComboBox>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "reading/reading.h"
#include "vicon/core/quantity.h"
#include "vicon/viewer/model/tracked_lumen.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr const char* kByHand = "by hand";
constexpr double kLeastWidth_hu = 10, kMostWidth_hu = 6000, kMostLevel_hu = 3000;
constexpr double kUsualWidth_hu = 1500;
constexpr double kDragged_hu = 2;  // a pixel: across a screen from lung to bone
constexpr std::array<double, 4> kThicknesses_mm{3, 5, 10, 20};

}  // namespace

SliceTool::SliceTool(Reading& reading) : ReadingTool(reading)
{
    window_ = new QComboBox;
    window_->setObjectName("window");
    window_->setAccessibleName(tr("Window of the slices"));
    window_->setToolTip(tr("Window and level of the slices: keys 4 to 9, or drag in a slice"));
    wanted_.window.name.clear();
}

void SliceTool::addTo(ReadingLayout& layout)
{
    layout.addChoice(window_);
    layout.addAction(ReadingMenu::slices, tr("Whole slices"), QKeySequence("0"), [this] {
        for (SliceView* slice : reading_.views().slices())
            slice->resetView();
    });
    for (const auto& [title, key, resolution] :
         {std::tuple(tr("As acquired, pixel for pixel"), "Ctrl+0", SliceView::Resolution::acquired),
          std::tuple(tr("Half resolution"), "Ctrl+9", SliceView::Resolution::half)})
        layout.addAction(ReadingMenu::slices, title, QKeySequence(key), [this, resolution = resolution] {
            for (SliceView* slice : reading_.views().slices())
                slice->setResolution(resolution);
        });
    addCleansed(layout);
    addKeys(layout);
    connect(window_, &QComboBox::currentTextChanged, this, [this](const QString& name) {
        if (name != kByHand)
            choose(presetOf(name));
    });
    connect(&reading_, &Reading::windowDragged, this, &SliceTool::dragWindow);
    connect(&reading_, &Reading::trackWanted, this, &SliceTool::track);
}

// Off whenever a case is opened: what is read first is what was acquired.
void SliceTool::addCleansed(ReadingLayout& layout)
{
    cleansed_ = layout.addSwitch(ReadingMenu::slices, tr("Without tagging (cleansed)"), QKeySequence("K"));
    cleansed_->setObjectName("cleansed");
    connect(cleansed_, &QAction::toggled, this, [this](bool on) {
        if (on && reading_.interaction().measures()) {
            showAcquired();
            return;
        }
        for (SliceView* slice : reading_.views().slices())
            slice->setCleansed(on);
        emit reading_.cleansedChanged(on);
    });
    connect(&reading_, &Reading::lineDragged, this, [this](int, const std::optional<ClickedPoint>& to) {
        if (to && !to->on_wall)
            showAcquired();
    });
}

void SliceTool::nextClickChanged()
{
    if (reading_.interaction().measures())
        showAcquired();
}

void SliceTool::showAcquired()
{
    if (!cleansed_->isChecked())
        return;
    cleansed_->setChecked(false);
    const auto was = [](const OpenScan* scan) { return scan && scan->files.canBeCleansed(); };
    if (was(reading_.scan()) || was(reading_.session().beside()))
        reading_.warn(
            tr("The slices show the densities as acquired again: these are measured. K shows them cleansed, "
               "after measuring."));
}

void SliceTool::addKeys(ReadingLayout& layout)
{
    for (int key = kFirstKey; key <= kLastKey; ++key)
        keys_[std::size_t(key - kFirstKey)] =
            layout.addAction(ReadingMenu::slices, {}, {}, [this, key] { window_->setCurrentIndex(key - kFirstKey); });
    tracks_ = layout.addSwitch(ReadingMenu::slices, tr("Follow the lumen (cine: Space)"), QKeySequence("Q"));
    tracks_->setObjectName("tracks");
    connect(tracks_, &QAction::toggled, this, [this](bool on) {
        wanted_.tracks = on;
        show();
    });
    layout.addAction(ReadingMenu::slices, tr("Slab: none, mean, minimum"), QKeySequence("Y"), [this] { nextOf(); });
    layout.addAction(ReadingMenu::slices, tr("Slab: thickness"), QKeySequence("Shift+Y"), [this] { nextThickness(); });
}

void SliceTool::useWords(const OrganWords& words)
{
    presets_ = reading_.scan() ? reading_.scan()->files.windows() : windowPresets(words.organ.name());
    {
        const QSignalBlocker quiet(window_);
        window_->clear();
        for (const WindowLevel& window : presets_)
            window_->addItem(QString::fromStdString(window.name));
    }
    for (std::size_t n = 0; n < keys_.size(); ++n) {
        const bool there = n < presets_.size();
        keys_[n]->setVisible(there);
        keys_[n]->setText(there ? tr("Window: %1").arg(window_->itemText(int(n))) : QString());
        keys_[n]->setShortcut(there ? QKeySequence(QString::number(kFirstKey + int(n))) : QKeySequence());
    }
    setLook(wanted_);
}

void SliceTool::setLook(const SliceLook& look)
{
    wanted_ = look;
    const int at = window_->findText(QString::fromStdString(look.window.name));
    const bool by_hand = look.window.name == kByHand && !presets_.empty() && look.window.unit == presets_[0].unit;
    if (by_hand)
        shown_ = look.window;
    else if (window_->count() > 0)
        shown_ = presetOf(window_->itemText(std::max(0, at)));
    show();
}

void SliceTool::show()
{
    {
        const QSignalBlocker quiet(window_), quiet_switch(tracks_);
        const QString name = QString::fromStdString(shown_.name);
        if (const int by_hand = window_->findText(kByHand); by_hand >= 0 && name != kByHand)
            window_->removeItem(by_hand);
        else if (by_hand < 0 && name == kByHand)
            window_->addItem(name);
        window_->setCurrentIndex(std::max(0, window_->findText(name)));
        tracks_->setChecked(wanted_.tracks);
    }
    const SliceLook look{shown_, wanted_.thick, wanted_.tracks};
    for (SliceView* slice : reading_.views().slices())
        slice->setLook(look);
    emit reading_.sliceLookChanged(look);
}

/// The default where there is no such window.
WindowLevel SliceTool::presetOf(const QString& name) const
{
    const auto at = std::find_if(presets_.begin(), presets_.end(),
                                 [&](const WindowLevel& window) { return window.name == name.toStdString(); });
    return at != presets_.end() ? *at : presets_.empty() ? WindowLevel() : presets_.front();
}

void SliceTool::choose(const WindowLevel& window)
{
    wanted_.window = shown_ = window;
    show();
}

void SliceTool::dragWindow(QPointF by)
{
    WindowLevel window = shown_;
    window.name = kByHand;
    // A signal may be a hundred or ten thousand: as fine as a density's steps in the widest window.
    const double scale =
        window.unit == unitOf(Quantity::density) || presets_.empty() ? 1 : presets_.front().width_hu / kUsualWidth_hu;
    const double step = kDragged_hu * scale;
    window.width_hu = std::clamp(window.width_hu + step * by.x(), kLeastWidth_hu * scale, kMostWidth_hu * scale);
    window.level_hu = std::clamp(window.level_hu - step * by.y(), -kMostLevel_hu * scale, kMostLevel_hu * scale);
    choose(window);
}

void SliceTool::nextOf()
{
    constexpr int kWays = 3;
    wanted_.thick.kind = ThickSlice::Kind((int(wanted_.thick.kind) + 1) % kWays);
    show();
}

void SliceTool::nextThickness()
{
    const auto* next = std::upper_bound(kThicknesses_mm.begin(), kThicknesses_mm.end(), wanted_.thick.thickness_mm);
    wanted_.thick.thickness_mm = next == kThicknesses_mm.end() ? kThicknesses_mm.front() : *next;
    if (wanted_.thick.kind == ThickSlice::Kind::one_plane)
        reading_.say(tr("Slab of %1 mm; Y chooses mean or minimum.").arg(wanted_.thick.thickness_mm));
    show();
}

/// Along the centreline from where the eye is; where the lumen is collapsed, too.
void SliceTool::track(Vector3 across, int slices)
{
    Navigator* navigator = reading_.navigator();
    if (!navigator)
        return;
    const auto& spacing = reading_.scan()->files.volume().grid.spacing_mm;
    const double slice_mm = *std::min_element(spacing.begin(), spacing.end());
    if (!navigator->hasPath()) {  // straight on, as far as the wall lets it
        navigator->moveBy(across * (slice_mm * slices));
        reading_.flewOn();
        return;
    }
    navigator->setMode(NavigationMode::planned);
    const int sign = navigator->heading() == Heading::caecum ? 1 : -1;
    const double here = navigator->state().station_mm;
    const double there = stationSlicesOn(reading_.scan()->files.frames(), here, across, slice_mm, slices * sign);
    navigator->step((there - here) * sign);
    reading_.flewOn();
}

}  // namespace vicon::viewer
