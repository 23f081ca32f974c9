#pragma once

#include <atomic>
#include <memory>

namespace vicon::viewer {

/// Something begun whose effect the window does not show yet: work for another thread, a drawing that waits until the
/// hand rests. Under way until the last copy is gone; a window in which nothing is, is quiet.
class UnderWay {
public:
    /// In all windows of the program.
    static int count() { return count_; }
    /// Since the program began: tells whether something came and went between two looks.
    static int begun() { return begun_; }

private:
    struct One {
        One()
        {
            ++begun_;
            ++count_;
        }
        ~One() { --count_; }
        One(const One&) = delete;
        One& operator=(const One&) = delete;
    };

    static inline std::atomic<int> count_ = 0, begun_ = 0;
    std::shared_ptr<const One> one_ = std::make_shared<One>();
};

}  // namespace vicon::viewer
