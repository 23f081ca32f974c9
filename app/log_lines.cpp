#include "log_lines.h"

#include <spdlog/formatter.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "vicon/core/printable.h"

namespace vicon::app {
namespace {

/// Whether standard error is the journal's, as systemd.exec(5) says: then a line begins with its level.
bool goesToJournal()
{
    const char* journal = std::getenv("JOURNAL_STREAM");
    struct stat here {};
    return journal && ::fstat(STDERR_FILENO, &here) == 0 &&
           std::to_string(here.st_dev) + ":" + std::to_string(here.st_ino) == journal;
}

/// As sd-daemon(3) writes a level of syslog(3).
const char* prefixOf(spdlog::level::level_enum level)
{
    switch (level) {
        case spdlog::level::critical:
            return "<2>";
        case spdlog::level::err:
            return "<3>";
        case spdlog::level::warn:
            return "<4>";
        case spdlog::level::info:
            return "<6>";
        default:
            return "<7>";
    }
}

class LogLines : public spdlog::formatter {
public:
    LogLines(bool json, bool leveled) : json_(json), leveled_(leveled) {}

    void format(const spdlog::details::log_msg& event, spdlog::memory_buf_t& out) override
    {
        const std::string message = printable({event.payload.data(), event.payload.size()});
        const auto level = spdlog::level::to_string_view(event.level);
        const std::string name(level.data(), level.size()), at = utcOf(event.time);
        const std::string line = json_ ? nlohmann::json{{"at", at}, {"level", name}, {"message", message}}.dump() + "\n"
                                       : at + " " + name + " " + message + "\n";
        if (leveled_)
            out.append(std::string_view(prefixOf(event.level)));
        out.append(line.data(), line.data() + line.size());
    }
    std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<LogLines>(json_, leveled_); }

private:
    static std::string utcOf(spdlog::log_clock::time_point time)
    {
        const std::time_t seconds = spdlog::log_clock::to_time_t(time);
        std::tm fields{};
        ::gmtime_r(&seconds, &fields);
        char text[sizeof "2026-11-21T08:15:30Z"];
        std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &fields);
        return text;
    }

    bool json_, leveled_;
};

}  // namespace

void writeLogAs(const LogOptions& options)
{
    spdlog::set_formatter(std::make_unique<LogLines>(options.format == LogFormat::json, goesToJournal()));
}

}  // namespace vicon::app
