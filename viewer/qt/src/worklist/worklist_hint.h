#pragma once

#include <QString>

namespace vicon::viewer {

struct ReadingServices;

/// What to do where there is no case yet.
QString hintOfEmptyStore(const ReadingServices& services);

/// What to do where there are cases and the search leaves none of them. @param state empty: any
QString hintOfNothingFound(const QString& words, const QString& state);

}  // namespace vicon::viewer
