#pragma once

#include <QObject>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

namespace vicon::viewer {

/// A thread that does work for the window, in order. Work that waits is replaced by later work of the same name: only
/// the newest picture is worth drawing. What it throws comes back as a message.
class Worker : public QObject {
    Q_OBJECT
public:
    explicit Worker(QObject* owner);
    ~Worker() override;  ///< end(), and waits

    /// What waits is dropped, but for work without a name; after that and the work that runs the thread ends. Does not
    /// wait for it. Later work is not done.
    void end();
    bool ended() const { return ended_; }

    using Work = std::function<void()>;
    /// `work` runs on the thread; what it returns runs on the window's, unless the worker is gone.
    void post(const std::string& name, std::function<Work()> work);
    /// Work that nothing replaces and that is done even when the window closes: what must be saved.
    void postAlways(std::function<Work()> work) { post({}, std::move(work)); }

signals:
    void failed(const QString& message);

private:
    struct Task {
        std::string name;
        std::function<Work()> work;
    };
    void run();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::list<Task> tasks_;
    bool stop_ = false;
    std::atomic<bool> ended_ = false;
    std::thread thread_;
};

}  // namespace vicon::viewer
