#include "report/reader_work.h"

#include <QObject>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include "vicon/cases/printed.h"

namespace vicon::viewer {
namespace {

/// As the form and the report print them; what there is at all is never none.
double tenths(double value)
{
    return std::max(0.1, std::round(value * 10) / 10);
}

QString missedOf(const ReviewedScan& reviewed)
{
    if (!reviewed.readable())
        return QObject::tr("what was missed cannot be told, for its surface cannot be read");
    if (!reviewed.begun())
        return QObject::tr("not reviewed");
    const QString share = QObject::tr("%1 % reviewed").arg(100 * reviewed.seen_mm2 / reviewed.whole_mm2, 0, 'f', 1);
    const QString least = QString::number(kMissedRegion_mm2, 'f', 0);
    if (reviewed.missed == 0)
        return QObject::tr("no missed region of %1 mm\u00b2 or more; %2").arg(least, share);
    if (reviewed.missed == 1)
        return QObject::tr("1 missed region of %1 mm\u00b2 or more; %2").arg(least, share);
    return QObject::tr("%1 missed regions of %2 mm\u00b2 or more; %3").arg(reviewed.missed).arg(least, share);
}

}  // namespace

ReaderWork readerWork(const std::vector<ReviewedScan>& scans, double read_s)
{
    constexpr double kMinute_s = 60;
    ReaderWork work;
    work.minutes = tenths(read_s / kMinute_s);
    double seen_mm2 = 0, whole_mm2 = 0;
    QStringList lines;
    for (const ReviewedScan& reviewed : scans) {
        const std::string name = positionName(reviewed.scan.series.patient_position);
        lines << QObject::tr("%1, series %2: %3")
                     .arg(QString::fromStdString(name))
                     .arg(reviewed.scan.series.number)
                     .arg(missedOf(reviewed));
        work.complete = work.complete && reviewed.begun() && reviewed.missed == 0;
        if (!reviewed.begun())
            continue;
        seen_mm2 += reviewed.seen_mm2;
        whole_mm2 += reviewed.whole_mm2;
    }
    if (whole_mm2 > 0)
        work.coverage_percent = tenths(100 * seen_mm2 / whole_mm2);
    work.missed = lines.join("\n");
    return work;
}

}  // namespace vicon::viewer
