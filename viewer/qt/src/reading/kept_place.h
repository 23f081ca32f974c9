#pragma once

#include <QVariant>

#include "vicon/cases/case_store.h"

namespace vicon::viewer {

/// The key of what a reader finds again in a case, in the user's settings.
inline QString keptKey(const CaseRecord& record, const QString& name)
{
    return "place/" + QString::fromStdString(record.id) + "/" + name;
}

}  // namespace vicon::viewer
