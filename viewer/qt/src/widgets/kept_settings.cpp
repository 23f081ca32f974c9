#include "widgets/kept_settings.h"

#include <QSettings>
#include <mutex>

namespace vicon::viewer {
namespace {

struct OnTheWay {
    std::mutex mutex, writing;
    QVariantMap values;
};

OnTheWay& onTheWay()
{
    static OnTheWay values;
    return values;
}

/// The newest of these values: another window may have changed them since.
void write(const QVariantMap& wanted)
{
    OnTheWay& way = onTheWay();
    const std::lock_guard one_at_a_time(way.writing);
    QVariantMap values;
    {
        const std::lock_guard lock(way.mutex);
        for (auto it = wanted.begin(); it != wanted.end(); ++it)
            if (way.values.contains(it.key()))
                values[it.key()] = way.values[it.key()];
    }
    QSettings settings;
    for (auto it = values.begin(); it != values.end(); ++it)
        settings.setValue(it.key(), it.value());
    settings.sync();
    const std::lock_guard lock(way.mutex);
    for (auto it = values.begin(); it != values.end(); ++it)
        if (way.values.value(it.key()) == it.value())
            way.values.remove(it.key());
}

}  // namespace

void keepSettings(Worker& worker, const QVariantMap& values)
{
    {
        OnTheWay& way = onTheWay();
        const std::lock_guard lock(way.mutex);
        for (auto it = values.begin(); it != values.end(); ++it)
            way.values[it.key()] = it.value();
    }
    worker.postAlways([values]() -> Worker::Work {
        write(values);
        return {};
    });
}

QVariant keptSetting(const QString& key, const QVariant& otherwise)
{
    OnTheWay& way = onTheWay();
    const std::lock_guard lock(way.mutex);
    return way.values.contains(key) ? way.values[key] : QSettings().value(key, otherwise);
}

}  // namespace vicon::viewer
