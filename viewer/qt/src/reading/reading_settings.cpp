// What a reader finds again: his own settings in every case, and the place in this one.
#include <iterator>
#include <utility>

#include "reading/reading.h"
#include "widgets/kept_settings.h"

namespace vicon::viewer {
namespace {

/// What was never kept is kept the first time, as it is.
QVariantMap keptBefore(QVariantMap values)
{
    for (auto it = values.begin(); it != values.end();)
        it = keptSetting(it.key()).isValid() ? std::next(it) : values.erase(it);
    return values;
}

}  // namespace

void Reading::restore()
{
    views_.restoreSizes();
    for (ReadingTool* tool : tools_)
        tool->restore();
    found_ = keptBefore(kept());
}

QVariantMap Reading::kept() const
{
    QVariantMap values = views_.sizes();
    for (const ReadingTool* tool : tools_)
        values.insert(tool->kept());
    return values;
}

// Some is known only with a scan.
void Reading::rememberFound()
{
    if (std::exchange(scan_was_open_, true))
        return;
    const QVariantMap with_scan = keptBefore(kept());
    for (auto it = with_scan.begin(); it != with_scan.end(); ++it)
        if (!found_.contains(it.key()))
            found_[it.key()] = it.value();
}

// Of two windows that are open the one that is closed last would take back what was changed in the other.
void Reading::keep(const QVariantMap& more)
{
    QVariantMap values = kept();
    values.insert(more);
    QVariantMap changed;
    for (auto it = values.begin(); it != values.end(); ++it)
        if (!found_.contains(it.key()) || found_[it.key()] != it.value())
            changed[it.key()] = it.value();
    found_.insert(changed);
    keepSettings(settings_worker_, changed);
}

}  // namespace vicon::viewer
