#pragma once

#include "vicon/core/option_names.h"
#include "vicon/core/options.h"

namespace vicon::app {

enum class LogFormat { text, json };
inline constexpr EnumNames<LogFormat, 2> kLogFormatNames{{{LogFormat::text, "text"}, {LogFormat::json, "json"}}};
constexpr const auto& optionNames(LogFormat /*value*/)
{
    return kLogFormatNames;
}

struct LogOptions {
    LogFormat format = LogFormat::text;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("log.format", format, "", "What a line of the log is.", choicesOf(format));
    }
};

/// The log on standard error: one line an event, with its time in UTC, whatever its message holds.
void writeLogAs(const LogOptions& options);

}  // namespace vicon::app
