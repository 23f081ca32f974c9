#include "vicon/core/error.h"

#include "vicon/core/printable.h"

namespace vicon {
namespace {

std::string oneLine(const std::string& what_happened, const std::string& subject, const std::string& remedy)
{
    std::string line = subject.empty() ? what_happened : subject + ": " + what_happened;
    if (!remedy.empty())
        line += "; " + remedy;
    for (char& c : line)
        if (c == '\n' || c == '\r')
            c = ' ';
    return printable(line);
}

}  // namespace

std::string_view nameOf(ErrorCode code)
{
    switch (code) {
        case ErrorCode::wrong_use:
            return "wrong_use";
        case ErrorCode::bad_input:
            return "bad_input";
        case ErrorCode::not_found:
            return "not_found";
        case ErrorCode::not_ready:
            return "not_ready";
        case ErrorCode::unusable_scan:
            return "unusable_scan";
        case ErrorCode::store:
            return "store";
        case ErrorCode::database:
            return "database";
        case ErrorCode::no_memory:
            return "no_memory";
        case ErrorCode::no_display:
            return "no_display";
        case ErrorCode::peer:
            return "peer";
        case ErrorCode::cancelled:
            return "cancelled";
        case ErrorCode::lease_lost:
            return "lease_lost";
        case ErrorCode::internal:
            return "internal";
    }
    return "internal";
}

Error::Error(ErrorCode code, const std::string& what_happened, std::string subject, std::string remedy)
    : std::runtime_error(oneLine(what_happened, subject, remedy)),
      code_(code),
      subject_(std::move(subject)),
      remedy_(std::move(remedy))
{
}

}  // namespace vicon
