#pragma once

#include "reading/reading_tool.h"
#include "vicon/viewer/scene/turned_picture.h"
#include "widgets/wanted.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// The projection as a body that turns: a drag turns it, the wheel enlarges it, with the right button it moves; a key
/// brings back the projection from the front.
class TurningTool : public ReadingTool {
    Q_OBJECT
public:
    explicit TurningTool(Reading& reading);

    void addTo(ReadingLayout& layout) override;
    void scanOpened(const Arrival& arrival) override;
    void draw(bool still) override;
    void stop() override;

private:
    void dragged(QPointF by, Qt::MouseButton button);
    void enlarge(int steps);
    void turnedBy(bool still);
    void fromFront();
    void clicked(Pixel at, Qt::KeyboardModifiers modifiers);
    void endDragged(int end, Pixel at, GripDrag drag);
    /// What is measured, over the picture that is shown, turned or from the front.
    void drawLine();
    void giveUp();
    /// The model of the scan that is read; nothing while that is shown from the front, or still to come.
    const TurnedPicture* shown() const;
    void sayWhereItIs();

    TurnedView view_;
    std::optional<TurnedPicture> shown_;
    std::weak_ptr<OpenScan> shown_of_;
    Point3 shown_eye_mm_;  // marked there
    Worker worker_{this};
};

}  // namespace vicon::viewer
