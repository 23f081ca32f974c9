#pragma once

#include <curl/curl.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/ingest/peer.h"

namespace vicon::ingest {

/// A peer by DICOMweb: one connection, kept open from request to request. By TLS 1.2 or newer where its URL says so:
/// with the files of [tls] where the peer has `tls`, else with the authorities that this machine trusts. No redirection
/// is followed and no proxy used, so that images and passwords go where they are meant to.
class WebClient {
public:
    /// Throws Error{wrong_use} when its password cannot be read.
    WebClient(const Peer& peer, Progress& progress);
    ~WebClient();
    WebClient(const WebClient&) = delete;
    WebClient& operator=(const WebClient&) = delete;

    struct Answer {
        long status = 0;
        std::string content_type;
        std::string body;  ///< unless it was handed over
        bool good() const { return status >= 200 && status < 300; }
    };
    /// Takes a body as it comes; told its content type. May throw.
    using OnBytes = std::function<void(const std::string& content_type, std::string_view bytes)>;

    // All throw Error{peer} when the peer cannot be reached, breaks off, or does not let us in (401, 403), and
    // Error{cancelled}. `path` is below the peer's URL.
    Answer get(const std::string& path, const std::string& accept);
    /// The body goes to `on_bytes` when the answer is good.
    Answer get(const std::string& path, const std::string& accept, const OnBytes& on_bytes);
    /// Sends a file between two texts.
    Answer post(const std::string& path, const std::string& content_type, const std::string& accept,
                const std::string& before, const std::filesystem::path& file, const std::string& after);

    /// As it stands in a URL.
    std::string escaped(const std::string& text) const;
    const Peer& peer() const { return peer_; }
    /// Throws Error{peer} for an answer that is not good.
    void requireGood(const Answer& answer, const std::string& what) const;

private:
    struct Upload;
    static std::size_t onBytes(char* data, std::size_t size, std::size_t count, void* client);
    static int onProgress(void* client, curl_off_t, curl_off_t, curl_off_t, curl_off_t);
    void setUp();
    void secure();
    Answer perform(const std::string& path, const std::vector<std::string>& headers);
    bool take(std::string_view bytes);
    void set(CURLoption option, const std::string& value);

    const Peer& peer_;
    Progress& progress_;
    CURL* curl_;
    char why_[CURL_ERROR_SIZE] = {};
    std::string password_;
    Answer answer_;
    const OnBytes* on_bytes_ = nullptr;
    std::exception_ptr thrown_;
};

/// A UID as it stands in a path. Throws Error{bad_input} for what is none.
const std::string& uidInPath(const std::string& uid);

/// Why the answer is what it is: "HTTP 503".
std::string statusOf(const WebClient::Answer& answer);

}  // namespace vicon::ingest
