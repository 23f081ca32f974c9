#include "slices/slice_tool.h"

#include <QAction>
#include <QComboBox>
#include <QSignalBlocker>

#include "reading/kept_place.h"
#include "reading/reading.h"
#include "vicon/viewer/model/window_level.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr const char* kWindow = "window_level";
}

SliceTool::SliceTool(Reading& reading) : ReadingTool(reading)
{
    window_ = new QComboBox;
    window_->setObjectName("window");
    window_->setAccessibleName(tr("Window of the slices"));
    window_->setToolTip(tr("Window and level of the slices"));
}

void SliceTool::addTo(ReadingLayout& layout)
{
    layout.addChoice(window_);
    layout.addAction(ReadingMenu::view, tr("Whole slices"), QKeySequence("0"), [this] {
        for (SliceView* slice : reading_.views().slices())
            slice->resetView();
    });
    // Off whenever a case is opened: what is read first is what was acquired.
    const QAction* cleansed =
        layout.addSwitch(ReadingMenu::view, tr("Slices without tagging (cleansed)"), QKeySequence("K"));
    connect(cleansed, &QAction::toggled, this, [this](bool on) {
        for (SliceView* slice : reading_.views().slices())
            slice->setCleansed(on);
    });
    connect(window_, &QComboBox::currentTextChanged, &reading_, [this](const QString& name) {
        const WindowLevel window = windowPreset(name.toStdString());
        for (SliceView* slice : reading_.views().slices())
            slice->setWindow(window);
        emit reading_.windowChanged(window);
    });
}

void SliceTool::restore()
{
    kept_window_ = keptSetting(keptKey(reading_.session().record(), kWindow)).toString();
}

QVariantMap SliceTool::kept() const
{
    return {{keptKey(reading_.session().record(), kWindow),
             kept_window_.isEmpty() ? window_->currentText() : kept_window_}};
}

/// The window that was chosen stays where the organ has it too.
void SliceTool::useWords(const OrganWords& words)
{
    const QString wanted = kept_window_.isEmpty() ? window_->currentText() : kept_window_;
    {
        const QSignalBlocker quiet(window_);
        window_->clear();
        for (const WindowLevel& window : windowPresets(words.organ))
            window_->addItem(QString::fromStdString(window.name));
        window_->setCurrentIndex(std::max(0, window_->findText(wanted)));
    }
    emit window_->currentTextChanged(window_->currentText());
}

}  // namespace vicon::viewer
