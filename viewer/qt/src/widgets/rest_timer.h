#pragma once

#include <QTimer>
#include <functional>
#include <optional>
#include <utility>

#include "widgets/under_way.h"

namespace vicon::viewer {

/// Does something when start() was called and, for a while, not again: what takes long waits until the hand rests.
/// Under way until it is done.
class RestTimer {
public:
    RestTimer(int rest_ms, std::function<void()> then, Qt::TimerType type = Qt::CoarseTimer)
    {
        timer_.setSingleShot(true);
        timer_.setTimerType(type);
        timer_.setInterval(rest_ms);
        QObject::connect(&timer_, &QTimer::timeout, &timer_, [this, then = std::move(then)] {
            const auto until_done = std::exchange(under_way_, std::nullopt);
            then();
        });
    }

    void start()
    {
        under_way_.emplace();
        timer_.start();
    }
    void stop()
    {
        timer_.stop();
        under_way_.reset();
    }

private:
    std::optional<UnderWay> under_way_;
    QTimer timer_;
};

}  // namespace vicon::viewer
