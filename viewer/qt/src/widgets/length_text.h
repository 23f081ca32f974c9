#pragma once

#include <QObject>
#include <QString>

namespace vicon::viewer {

/// "6.4 mm"
inline QString lengthText(double length_mm)
{
    return QObject::tr("%1 mm").arg(length_mm, 0, 'f', 1);
}

}  // namespace vicon::viewer
