#include "flight/steering_keys.h"

#include <algorithm>

namespace vicon::viewer {

Steering SteeringKeys::steering(NavigationMode mode) const
{
    const auto axis = [this](int plus, int minus) { return double(keys_.count(plus)) - double(keys_.count(minus)); };
    const auto limited = [](double v) { return std::clamp(v, -1.0, 1.0); };
    Steering steering;
    if (mode == NavigationMode::guided)
        steering.pull = axis(Qt::Key_W, Qt::Key_S);
    else
        steering.thrust_forward = axis(Qt::Key_W, Qt::Key_S);
    steering.thrust_right = axis(Qt::Key_D, Qt::Key_A);
    steering.turn_right = limited(axis(Qt::Key_Right, Qt::Key_Left) + mouse_.x());
    steering.turn_up = limited(axis(Qt::Key_Up, Qt::Key_Down) + mouse_.y());
    return steering;
}

}  // namespace vicon::viewer
