#include "dates.h"

#include <cstdio>

namespace vicon::ingest {

std::chrono::sys_days dayOf(const std::string& date)
{
    int year = 1970, month = 1, day = 1;
    std::sscanf(date.c_str(), "%4d%2d%2d", &year, &month, &day);
    return std::chrono::year(year) / month / day;
}

std::string dateOf(std::chrono::sys_days day)
{
    const std::chrono::year_month_day date = day;
    char text[16];
    std::snprintf(text, sizeof text, "%04d%02u%02u", int(date.year()), unsigned(date.month()), unsigned(date.day()));
    return text;
}

}  // namespace vicon::ingest
