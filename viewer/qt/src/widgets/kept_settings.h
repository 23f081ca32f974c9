#pragma once

#include <QVariant>

#include "widgets/worker.h"

namespace vicon::viewer {

/// What a reader finds again, in the user's settings. Writing waits until the disk has it, which may take long: it is
/// done by a worker, and until then the values are those that were to be kept.
void keepSettings(Worker& worker, const QVariantMap& values);
QVariant keptSetting(const QString& key, const QVariant& otherwise = {});

}  // namespace vicon::viewer
