#include "log_lines.h"

#include <spdlog/formatter.h>
#include <spdlog/spdlog.h>

#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "vicon/core/printable.h"

namespace vicon::app {
namespace {

class LogLines : public spdlog::formatter {
public:
    explicit LogLines(bool json) : json_(json) {}

    void format(const spdlog::details::log_msg& event, spdlog::memory_buf_t& out) override
    {
        const std::string message = printable({event.payload.data(), event.payload.size()});
        const auto level = spdlog::level::to_string_view(event.level);
        const std::string name(level.data(), level.size()), at = utcOf(event.time);
        const std::string line = json_ ? nlohmann::json{{"at", at}, {"level", name}, {"message", message}}.dump() + "\n"
                                       : at + " " + name + " " + message + "\n";
        out.append(line.data(), line.data() + line.size());
    }
    std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<LogLines>(json_); }

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

    bool json_;
};

}  // namespace

void writeLogAs(const LogOptions& options)
{
    spdlog::set_formatter(std::make_unique<LogLines>(options.format == LogFormat::json));
}

}  // namespace vicon::app
