#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace vicon::ingest {

/// The boundary that a multipart content type names; empty where it names none.
std::string boundaryOf(const std::string& content_type);

/// Takes a multipart body (RFC 2046) as it comes, and hands the parts' bodies on. Of a part that never ends, no more is
/// held here than a delimiter is long.
class MultipartReader {
public:
    struct Parts {
        std::function<void()> begin;
        std::function<void(std::string_view)> bytes;
        std::function<void()> end;
    };
    MultipartReader(const std::string& boundary, Parts parts);

    /// Throws Error{bad_input} when it is no such body.
    void feed(std::string_view bytes);
    /// Whether the last part has ended, and the body with it.
    bool complete() const { return state_ == State::over; }

private:
    enum class State { before, after_delimiter, headers, body, over };
    bool step();
    bool findDelimiter();
    bool afterDelimiter();
    bool headers();

    std::string delimiter_;
    Parts parts_;
    State state_ = State::before;
    std::string held_ = "\r\n";  ///< what was not yet understood; the first delimiter may stand at the very beginning
};

}  // namespace vicon::ingest
