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
    const QString in_plane =
        size.plane ? QObject::tr(", %1 in the best plane").arg(lengthText(size.plane->diameter_mm)) : QString();
    if (const auto& polyp = size.polyp) {
        const int decimals = volumeDecimals(polyp->volume_ml);
        QString text = QObject::tr("%1 outlined (%2 to %3)%4, height %5, volume %6 ml")
                           .arg(lengthText(polyp->diameter_mm))
                           .arg(polyp->least_mm, 0, 'f', 1)
                           .arg(polyp->most_mm, 0, 'f', 1)
                           .arg(in_plane, lengthText(polyp->height_mm))
                           .arg(polyp->volume_ml, 0, 'f', decimals);
        if (polyp->volume_least_ml && polyp->volume_most_ml)
            text += QObject::tr(" (%1 to %2)")
                        .arg(*polyp->volume_least_ml, 0, 'f', decimals)
                        .arg(*polyp->volume_most_ml, 0, 'f', decimals);
        return text;
    }
    if (size.in_slice)
        return QObject::tr("%1 straight, in a slice").arg(lengthText(size.straight_mm));
    QString text = QObject::tr("%1 largest diameter; %2 straight")
                       .arg(lengthText(largestDiameter_mm(size)), lengthText(size.straight_mm));
    if (size.along_mm)
        text += QObject::tr(", %1 along the wall").arg(lengthText(*size.along_mm));
    return text + in_plane;
}

}  // namespace vicon::viewer
