#include "widgets/worker.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

QString messageOf(const Error& e)
{
    return QString::fromStdString(e.what());
}

// The calling thread, and those that it starts (parallel loops, the driver's), leave the processor to the window's
// thread whenever that wants it: on few cores a click is answered at once, also while a scan is opened or drawn. Linux
// counts niceness by thread; 5 is a third of the share of what is not nice.
void yieldToWindow()
{
    constexpr int kNice = 5;
    ::setpriority(PRIO_PROCESS, id_t(::gettid()), kNice);
}

}  // namespace

Worker::Worker(QObject* owner) : QObject(owner), thread_([this] { run(); }) {}

Worker::~Worker()
{
    end();
    thread_.join();
}

void Worker::end()
{
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        tasks_.remove_if([](const Task& task) { return !task.name.empty(); });
    }
    wake_.notify_all();
}

void Worker::post(const std::string& name, std::function<Work()> work)
{
    {
        const std::lock_guard lock(mutex_);
        const auto waiting = std::find_if(tasks_.begin(), tasks_.end(),
                                          [&](const Task& task) { return !name.empty() && task.name == name; });
        if (waiting != tasks_.end())
            waiting->work = std::move(work);
        else
            tasks_.push_back({name, std::move(work)});
    }
    wake_.notify_all();
}

void Worker::run()
{
    yieldToWindow();
    for (;;) {
        Task task;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] { return stop_ || !tasks_.empty(); });
            if (tasks_.empty()) {
                ended_ = true;
                return;
            }
            task = std::move(tasks_.front());
            tasks_.pop_front();
        }
        try {
            if (Work after = task.work())
                QMetaObject::invokeMethod(this, std::move(after), Qt::QueuedConnection);
        } catch (const Error& e) {
            emit failed(messageOf(e));
        } catch (const std::bad_alloc&) {
            emit failed(tr("Not enough memory; close other programs and try again."));
        } catch (const std::exception& e) {
            emit failed(QString::fromUtf8(e.what()));
        }
    }
}

}  // namespace vicon::viewer
