#include "multipart.h"

#include <algorithm>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kMostPartHeadBytes = 16384;
constexpr std::string_view kLineEnd = "\r\n", kHeadersEnd = "\r\n\r\n", kLastMark = "--";

}  // namespace

std::string boundaryOf(const std::string& content_type)
{
    std::string lower = content_type;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    std::size_t at = lower.find(';');
    if (lower.find("multipart/related") >= at)
        return {};
    constexpr std::string_view kName = "boundary=";
    // A parameter's value may be quoted, and hold a semicolon then.
    for (bool quoted = false; at < lower.size(); ++at) {
        quoted = quoted != (lower[at] == '"');
        const std::size_t name = lower.find_first_not_of("; \t", at);
        if (quoted || lower[at] != ';' || name == std::string::npos ||
            !std::string_view(lower).substr(name).starts_with(kName))
            continue;
        const std::size_t from = name + kName.size();
        if (from < lower.size() && lower[from] == '"')
            return content_type.substr(from + 1, lower.find('"', from + 1) - from - 1);
        return content_type.substr(from, lower.find_first_of("; \t", from) - from);
    }
    return {};
}

MultipartReader::MultipartReader(const std::string& boundary, Parts parts)
    : delimiter_("\r\n--" + boundary), parts_(std::move(parts))
{
}

void MultipartReader::feed(std::string_view bytes)
{
    if (state_ == State::over)
        return;  // an epilogue says nothing
    held_ += bytes;
    while (step()) {
    }
}

/// Understands as much as stands there. Returns whether there may be more to understand.
bool MultipartReader::step()
{
    switch (state_) {
        case State::before:
        case State::body:
            return findDelimiter();
        case State::after_delimiter:
            return afterDelimiter();
        case State::headers:
            return headers();
        case State::over:
            return false;
    }
    return false;
}

bool MultipartReader::findDelimiter()
{
    const std::size_t at = held_.find(delimiter_);
    const bool found = at != std::string::npos;
    // Without one, the end may be the beginning of one.
    const std::size_t known = found ? at : held_.size() - std::min(held_.size(), delimiter_.size() - 1);
    if (state_ == State::body && known > 0)
        parts_.bytes(std::string_view(held_).substr(0, known));
    held_.erase(0, found ? at + delimiter_.size() : known);
    if (!found)
        return false;
    if (state_ == State::body)
        parts_.end();
    state_ = State::after_delimiter;
    return true;
}

/// Either the mark of the last one, or blanks and the end of the line.
bool MultipartReader::afterDelimiter()
{
    if (held_.size() < kLastMark.size())
        return false;
    if (held_.starts_with(kLastMark)) {
        state_ = State::over;
        return false;
    }
    const std::size_t end = held_.find_first_not_of(" \t");
    if (end == std::string::npos || end + 1 == held_.size())
        return held_.size() > kMostPartHeadBytes ? throw Error(ErrorCode::bad_input, "a delimiter does not end")
                                                 : false;
    if (!std::string_view(held_).substr(end).starts_with(kLineEnd))
        throw Error(ErrorCode::bad_input, "a delimiter does not end as it should");
    held_.erase(0, end);  // its end is also that of a part without headers
    state_ = State::headers;
    return true;
}

bool MultipartReader::headers()
{
    const std::size_t end = held_.find(kHeadersEnd);
    if (end == std::string::npos) {
        if (held_.size() > kMostPartHeadBytes)
            throw Error(ErrorCode::bad_input, "the headers of a part do not end");
        return false;
    }
    held_.erase(0, end + kHeadersEnd.size());
    state_ = State::body;
    parts_.begin();
    return true;
}

}  // namespace vicon::ingest
