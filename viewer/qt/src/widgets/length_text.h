#pragma once

#include <QObject>
#include <QString>

#include "vicon/cases/finding_facts.h"

namespace vicon::viewer {

/// "6.4 mm"
inline QString lengthText(double length_mm)
{
    return QObject::tr("%1 mm").arg(length_mm, 0, 'f', 1);
}

/// The size that counts, then what was measured: "5.9 mm largest diameter; 5.5 mm straight, ..."
inline QString sizeText(const MarkerSize& size)
{
    if (size.polyp)
        return QObject::tr("%1 outlined (%2 to %3), height %4, volume %5 ml")
            .arg(lengthText(size.polyp->diameter_mm))
            .arg(size.polyp->least_mm, 0, 'f', 1)
            .arg(size.polyp->most_mm, 0, 'f', 1)
            .arg(lengthText(size.polyp->height_mm))
            .arg(size.polyp->volume_ml, 0, 'f', 2);
    QString text = QObject::tr("%1 largest diameter; %2 straight")
                       .arg(lengthText(largestDiameter_mm(size)), lengthText(size.straight_mm));
    if (size.along_mm)
        text += QObject::tr(", %1 along the wall").arg(lengthText(*size.along_mm));
    if (size.plane)
        text += QObject::tr(", %1 in the best plane").arg(lengthText(size.plane->diameter_mm));
    return text;
}

}  // namespace vicon::viewer
