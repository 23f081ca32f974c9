#pragma once

#include <QObject>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "widgets/under_way.h"
#include "widgets/wanted.h"

namespace vicon::viewer {

/// A thread that does work for the window, in order. Work that waits is replaced by later work of the same name: only
/// the newest picture is worth drawing. What it throws comes back as a message.
class Worker : public QObject {
    Q_OBJECT
public:
    explicit Worker(QObject* owner);
    ~Worker() override;  ///< end(), and waits

    /// All work that has a name is given up; after what runs and what has none the thread ends. Does not wait for it.
    /// Later work that has a name is not done.
    void end();
    /// Work of this name that waits is dropped, what runs is told that nobody wants it, and what it returned and the
    /// window has not done yet is not done. False where there is none.
    bool giveUp(const std::string& name);
    bool ended() const { return ended_; }

    using Work = std::function<void()>;
    using Task = std::function<Work(Progress&)>;
    /// `work` runs on the thread; what it returns runs on the window's, unless the worker is gone. It learns from the
    /// Progress whether it is still wanted: what it throws when it is not is no failure.
    void postTask(const std::string& name, Task work);
    /// The same of work that is done before anybody could want it no more.
    void post(const std::string& name, std::function<Work()> work)
    {
        postTask(name, [work = std::move(work)](Progress&) { return work(); });
    }
    /// Work that nothing replaces and that is done even when the window closes: what must be saved.
    void postAlways(std::function<Work()> work) { post({}, std::move(work)); }

signals:
    void failed(const QString& message);

private:
    struct Waiting {
        std::string name;
        Task work;
        UnderWay under_way = {};  ///< until what it returns has run
        std::shared_ptr<Wanted> wanted = std::make_shared<Wanted>();
    };
    /// Work that runs, or whose result is on its way to the window.
    struct Begun {
        std::string name;
        std::weak_ptr<Wanted> wanted;
    };
    void run();
    std::optional<Waiting> next();
    void perform(const Waiting& task);
    template <class Named>
    bool giveUpWhere(Named isMeant);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::list<Waiting> tasks_;
    std::list<Begun> begun_;
    bool stop_ = false;
    std::atomic<bool> ended_ = false;
    std::thread thread_;
};

}  // namespace vicon::viewer
