#pragma once

#include <QPointF>
#include <set>

#include "vicon/viewer/model/navigator.h"

namespace vicon::viewer {

/// Which keys are held, and how far the mouse was dragged: what they steer.
class SteeringKeys {
public:
    void press(int key) { keys_.insert(key); }
    void release(int key) { keys_.erase(key); }
    void releaseAll() { keys_.clear(); }
    /// @param by of a full turn of the helm
    void drag(QPointF by) { mouse_ += by; }
    void endDrag() { mouse_ = {}; }

    Steering steering(NavigationMode mode) const;

private:
    std::set<int> keys_;
    QPointF mouse_;
};

}  // namespace vicon::viewer
