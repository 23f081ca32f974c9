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
        giveUpWhere([](const std::string& name) { return !name.empty(); });
    }
    wake_.notify_all();
}

bool Worker::giveUp(const std::string& name)
{
    const std::lock_guard lock(mutex_);
    return giveUpWhere([&](const std::string& of) { return of == name; });
}

template <class Named>
bool Worker::giveUpWhere(Named isMeant)
{
    bool any = tasks_.remove_if([&](const Waiting& task) { return isMeant(task.name); }) > 0;
    for (const Begun& begun : begun_)
        if (const auto wanted = begun.wanted.lock(); wanted && isMeant(begun.name)) {
            any = any || !wanted->cancelled();
            wanted->giveUp();
        }
    return any;
}

void Worker::postTask(const std::string& name, Task work)
{
    {
        const std::lock_guard lock(mutex_);
        if (stop_ && !name.empty())
            return;
        const auto waiting = std::find_if(tasks_.begin(), tasks_.end(),
                                          [&](const Waiting& task) { return !name.empty() && task.name == name; });
        if (waiting != tasks_.end())
            *waiting = {name, std::move(work)};
        else
            tasks_.push_back({name, std::move(work)});
    }
    wake_.notify_all();
}

std::optional<Worker::Waiting> Worker::next()
{
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return stop_ || !tasks_.empty(); });
    if (tasks_.empty())
        return std::nullopt;
    Waiting task = std::move(tasks_.front());
    tasks_.pop_front();
    begun_.remove_if([](const Begun& begun) { return begun.wanted.expired(); });
    begun_.push_back({task.name, task.wanted});
    return task;
}

void Worker::perform(const Waiting& task)
{
    try {
        if (Work after = task.work(*task.wanted))
            QMetaObject::invokeMethod(
                this,
                [after = std::move(after), wanted = task.wanted, until_then = task.under_way] {
                    if (!wanted->cancelled())
                        after();
                },
                Qt::QueuedConnection);
    } catch (const Error& e) {
        if (e.code() != ErrorCode::cancelled || !task.wanted->cancelled())
            emit failed(messageOf(e));
    } catch (const std::bad_alloc&) {
        emit failed(tr("Not enough memory; close other programs and try again."));
    } catch (const std::exception& e) {
        emit failed(QString::fromUtf8(e.what()));
    }
}

void Worker::run()
{
    yieldToWindow();
    while (const auto task = next())
        perform(*task);
    ended_ = true;
}

}  // namespace vicon::viewer
