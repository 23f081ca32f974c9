#pragma once

#include <QString>
#include <QStringList>

#include "vicon/cases/records.h"

namespace vicon::viewer {

/// What a person must decide about a case, a line each, as 'vicon show' has it; empty where there is nothing.
inline QString flagsOf(const CaseRecord& record)
{
    QStringList lines;
    for (const std::string& flag : record.flags)
        lines << "! " + QString::fromStdString(flag);
    return lines.join("\n");
}

}  // namespace vicon::viewer
