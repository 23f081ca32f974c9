#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "coverage/coverage_keeper.h"

namespace vicon::viewer {

/// What this reader's work says of the study.
struct ReaderWork {
    double minutes = 0;                      ///< of reading, without pauses; at least a tenth
    std::optional<double> coverage_percent;  ///< of the wall of the scans that were read; absent: none was
    QString missed;                          ///< what of the wall was missed: a line each scan
    bool complete = true;                    ///< nothing was
};

/// @param read_s how long all scans of the case were read
ReaderWork readerWork(const std::vector<ReviewedScan>& scans, double read_s);

}  // namespace vicon::viewer
