#pragma once

#include <QVariant>

#include "vicon/cases/case_store.h"

namespace vicon::viewer {

/// The key of what a reader finds again in a case, in the user's settings.
inline QString keptKey(const CaseRecord& record, const QString& name)
{
    return "place/" + QString::fromStdString(record.id) + "/" + name;
}

/// The key of what is the reader's own, whatever the case.
inline QString readerKey(const QString& name)
{
    return "reader/" + name;
}

}  // namespace vicon::viewer
