#pragma once

#include <QObject>
#include <QVariantMap>
#include <optional>

#include "session/drawing_thread.h"
#include "vicon/viewer/model/interaction.h"
#include "vicon/viewer/model/organ_words.h"
#include "vicon/viewer/model/scan_opening.h"
#include "vicon/viewer/model/step_number.h"

namespace vicon::viewer {

class Reading;
class ReadingLayout;

/// A point that was clicked in a view of a scan.
struct ClickedPoint {
    const OpenScan& scan;
    std::optional<SnapshotResult> from;  ///< the view from inside in which it was chosen; nothing of a slice
    Point3 at_mm;
    Qt::KeyboardModifiers modifiers;
    bool on_wall = false;  ///< chosen in an endoscopic picture, and not as acquired
};

/// One thing that a reader can do: its controls, its actions, what a click means to it, and what it adds to the
/// pictures. The window knows it by one line in tools.cpp. What is not overridden does nothing.
class ReadingTool : public QObject {
public:
    explicit ReadingTool(Reading& reading) : reading_(reading) {}

    /// Puts its panel, its list and its actions where they belong; once, when the window is built.
    virtual void addTo(ReadingLayout& layout) = 0;
    /// Takes up what was kept of an earlier reading of this case; once, before a scan is open.
    virtual void restore() {}
    /// What this reader shall find again.
    virtual QVariantMap kept() const { return {}; }
    /// The controls call the organ and its ends so.
    virtual void useWords(const OrganWords&) {}

    /// Another scan is about to be opened, or the window closes.
    virtual void scanLeft() {}
    /// A scan is open that was not; its pictures follow.
    virtual void scanOpened(const Arrival&) {}
    /// It was not opened after all.
    virtual void scanStays() {}
    virtual void markersChanged() {}
    /// The eye is elsewhere, or what is shown of its place has changed.
    virtual void placeShown() {}
    /// The eye left the point that was looked at.
    virtual void pointLeft() {}
    /// This marker is shown.
    virtual void markerShown(const Marker&) {}
    /// Everything is drawn anew. @param still smoothly: nothing moves
    virtual void draw(bool still) { static_cast<void>(still); }

    /// What a click means, where it is this tool's; then true.
    virtual bool act(const ClickMeaning&, const ClickedPoint&) { return false; }
    /// The next click is for something else now, this tool's or another's.
    virtual void nextClickChanged() {}
    /// The reader gave up whatever was begun.
    virtual void escape() {}

    /// What pictures of a scan show beside its markers: projection, slices, from inside.
    virtual void annotate(SnapshotRequest&, const OpenScan&) const {}
    /// How every view from inside looks: of the scan that is read, the one beside it, and films.
    virtual void style(EndoscopicRequest&) const {}
    /// What is more in the one of the scan that is read.
    virtual void complete(EndoscopicRequest&) const {}

    /// The step that would be taken back, or done again; nothing: there is none.
    virtual std::optional<StepNumber> toUndo() const { return {}; }
    virtual std::optional<StepNumber> toRedo() const { return {}; }
    virtual void undo() {}
    virtual void redo() {}
    /// A step is on its way: which one is the last is not known yet.
    virtual bool stepUnderWay() const { return false; }

    /// A scan is done again by the pipeline for this reader.
    virtual bool redoesScan() const { return false; }
    /// The window closes: what runs is stopped.
    virtual void stop() {}

protected:
    /// What a list's column of stations means; empty where there are none.
    static QString stationTip(const OrganWords& words)
    {
        if (!words.has_path)
            return {};
        return tr("Distance from the %1 along the %2")
            .arg(QString::fromStdString(words.first_end), QString::fromStdString(words.organ.name()));
    }

    Reading& reading_;
};

}  // namespace vicon::viewer
