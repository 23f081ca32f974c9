#pragma once

#include <QLineF>
#include <QPointF>
#include <QString>
#include <QVector>
#include <array>
#include <optional>

namespace vicon::viewer {

/// What the mouse does to an end of a line: holds it, lets it go, or drops it before that, as where another button is
/// pressed: then it goes back to where it was.
enum class GripDrag { held, released, broken_off };

/// A measured length over a picture, in the picture's pixels.
struct Calliper {
    QVector<QLineF> lines;                        ///< from one end to the other; none while an end is missing
    QVector<QLineF> rim;                          ///< of an outlined polyp
    std::array<std::optional<QPointF>, 2> grips;  ///< the ends that the picture shows: they can be dragged
    QPointF label_at;                             ///< beside the line
    QString text;
    bool dashed = false;  ///< it does not lie in the picture's plane: its length is not that of the drawn line
};

}  // namespace vicon::viewer
