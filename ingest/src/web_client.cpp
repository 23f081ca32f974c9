#include "web_client.h"

#include <algorithm>
#include <fstream>

#include "association.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "web_access.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr long kConnectSeconds = 30, kSilentSeconds = 60;
/// Of an answer that is held in memory: a hundred thousand studies have some 100 MB.
constexpr std::size_t kMostBytes = 256U << 20U;
constexpr long kUnauthorized = 401, kForbidden = 403;

[[noreturn]] void webFailed(const std::string& what, const Peer& peer)
{
    throw Error(ErrorCode::peer, what, nameOf(peer), "check its url, user and certificates");
}

struct FreeList {
    void operator()(curl_slist* list) const { curl_slist_free_all(list); }
};
using List = std::unique_ptr<curl_slist, FreeList>;

List listOf(const std::vector<std::string>& lines)
{
    List list;
    for (const std::string& line : lines)
        list.reset(curl_slist_append(list.release(), line.c_str()));
    return list;
}

}  // namespace

/// A text, a file and a text, read as one.
struct WebClient::Upload {
    const std::string& before;
    std::ifstream file;
    const std::string& after;
    curl_off_t file_size = 0, at = 0;

    curl_off_t size() const { return curl_off_t(before.size()) + file_size + curl_off_t(after.size()); }

    std::size_t read(char* to, std::size_t room)
    {
        const auto fromText = [&](const std::string& text, curl_off_t begin) {
            const std::size_t from = std::size_t(at - begin), count = std::min(room, text.size() - from);
            std::copy_n(text.data() + from, count, to);
            return count;
        };
        const auto file_begin = curl_off_t(before.size()), file_end = file_begin + file_size;
        std::size_t count = 0;
        if (at < file_begin) {
            count = fromText(before, 0);
        } else if (at < file_end) {
            file.seekg(at - file_begin);
            file.read(to, std::streamsize(std::min<curl_off_t>(curl_off_t(room), file_end - at)));
            count = std::size_t(file.gcount());
            if (count == 0)
                return CURL_READFUNC_ABORT;  // it is shorter than it was
        } else if (at < size()) {
            count = fromText(after, file_end);
        }
        at += curl_off_t(count);
        return count;
    }
    static std::size_t onRead(char* to, std::size_t size, std::size_t count, void* upload)
    {
        return static_cast<Upload*>(upload)->read(to, size * count);
    }
    /// The connection may have been closed meanwhile; then it is sent anew.
    static int onSeek(void* upload, curl_off_t offset, int origin)
    {
        if (origin != SEEK_SET)
            return CURL_SEEKFUNC_CANTSEEK;
        static_cast<Upload*>(upload)->file.clear();
        static_cast<Upload*>(upload)->at = offset;
        return CURL_SEEKFUNC_OK;
    }
};

WebClient::WebClient(const Peer& peer, Progress& progress)
    : peer_(peer), progress_(progress), password_(passwordOf(*peer.web))
{
    static const CURLcode kReady = curl_global_init(CURL_GLOBAL_DEFAULT);
    curl_ = kReady == CURLE_OK ? curl_easy_init() : nullptr;
    if (!curl_)
        throw Error(ErrorCode::internal, "libcurl cannot be used");
}

WebClient::~WebClient()
{
    curl_easy_cleanup(curl_);
}

void WebClient::set(CURLoption option, const std::string& value)
{
    curl_easy_setopt(curl_, option, value.c_str());
}

void WebClient::setUp()
{
    curl_easy_reset(curl_);  // connections stay
    why_[0] = '\0';
    answer_ = {};
    thrown_ = nullptr;
    curl_easy_setopt(curl_, CURLOPT_ERRORBUFFER, why_);
    curl_easy_setopt(curl_, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(curl_, CURLOPT_NOPROXY, "*");
    curl_easy_setopt(curl_, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(curl_, CURLOPT_FOLLOWLOCATION, 0L);
    curl_easy_setopt(curl_, CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
    curl_easy_setopt(curl_, CURLOPT_LOW_SPEED_LIMIT, 1L);
    curl_easy_setopt(curl_, CURLOPT_LOW_SPEED_TIME, kSilentSeconds);
    curl_easy_setopt(curl_, CURLOPT_WRITEFUNCTION, &WebClient::onBytes);
    curl_easy_setopt(curl_, CURLOPT_WRITEDATA, this);
    curl_easy_setopt(curl_, CURLOPT_NOPROGRESS, 0L);
    curl_easy_setopt(curl_, CURLOPT_XFERINFOFUNCTION, &WebClient::onProgress);
    curl_easy_setopt(curl_, CURLOPT_XFERINFODATA, this);
    secure();
}

void WebClient::secure()
{
    curl_easy_setopt(curl_, CURLOPT_SSLVERSION, CURL_SSLVERSION_TLSv1_2);
    if (peer_.tls) {
        set(CURLOPT_CAINFO, peer_.tls->trusted);
        set(CURLOPT_SSLCERT, peer_.tls->certificate);
        set(CURLOPT_SSLKEY, peer_.tls->key);
    }
    if (peer_.web->user.empty())
        return;
    curl_easy_setopt(curl_, CURLOPT_HTTPAUTH, CURLAUTH_BASIC);
    set(CURLOPT_USERNAME, peer_.web->user);
    set(CURLOPT_PASSWORD, password_);
}

bool WebClient::take(std::string_view bytes)
{
    try {
        if (answer_.status == 0) {
            const char* type = nullptr;
            curl_easy_getinfo(curl_, CURLINFO_RESPONSE_CODE, &answer_.status);
            curl_easy_getinfo(curl_, CURLINFO_CONTENT_TYPE, &type);
            answer_.content_type = type ? type : "";
        }
        if (on_bytes_ && answer_.good()) {
            (*on_bytes_)(answer_.content_type, bytes);
            return true;
        }
        if (answer_.body.size() + bytes.size() > kMostBytes)
            webFailed("the peer's answer does not end", peer_);
        answer_.body += bytes;
        return true;
    } catch (...) {
        thrown_ = std::current_exception();
        return false;
    }
}

std::size_t WebClient::onBytes(char* data, std::size_t size, std::size_t count, void* client)
{
    return static_cast<WebClient*>(client)->take({data, size * count}) ? size * count : 0;
}

int WebClient::onProgress(void* client, curl_off_t, curl_off_t, curl_off_t, curl_off_t)
{
    return static_cast<WebClient*>(client)->progress_.cancelled() ? 1 : 0;
}

WebClient::Answer WebClient::perform(const std::string& path, const std::vector<std::string>& headers)
{
    progress_.check();
    set(CURLOPT_URL, peer_.web->url + path);
    const List list = listOf(headers);
    curl_easy_setopt(curl_, CURLOPT_HTTPHEADER, list.get());
    const CURLcode done = curl_easy_perform(curl_);
    if (thrown_)
        std::rethrow_exception(thrown_);
    progress_.check();
    if (done != CURLE_OK)
        webFailed(std::string("the peer cannot be reached, or broke off (") +
                      (why_[0] != '\0' ? why_ : curl_easy_strerror(done)) + ")",
                  peer_);
    curl_easy_getinfo(curl_, CURLINFO_RESPONSE_CODE, &answer_.status);
    if (answer_.status == kUnauthorized || answer_.status == kForbidden)
        webFailed("the peer does not let us in (" + statusOf(answer_) + ")", peer_);
    return std::move(answer_);
}

WebClient::Answer WebClient::get(const std::string& path, const std::string& accept)
{
    setUp();
    return perform(path, {"Accept: " + accept});
}

WebClient::Answer WebClient::get(const std::string& path, const std::string& accept, const OnBytes& on_bytes)
{
    setUp();
    on_bytes_ = &on_bytes;
    struct Forget {
        const OnBytes*& what;
        ~Forget() { what = nullptr; }
    } const forget{on_bytes_};
    return perform(path, {"Accept: " + accept});
}

WebClient::Answer WebClient::post(const std::string& path, const std::string& content_type, const std::string& accept,
                                  const std::string& before, const fs::path& file, const std::string& after)
{
    setUp();
    Upload upload{before, std::ifstream(file, std::ios::binary), after, curl_off_t(fs::file_size(file))};
    curl_easy_setopt(curl_, CURLOPT_POST, 1L);
    curl_easy_setopt(curl_, CURLOPT_POSTFIELDSIZE_LARGE, upload.size());
    curl_easy_setopt(curl_, CURLOPT_READFUNCTION, &Upload::onRead);
    curl_easy_setopt(curl_, CURLOPT_READDATA, &upload);
    curl_easy_setopt(curl_, CURLOPT_SEEKFUNCTION, &Upload::onSeek);
    curl_easy_setopt(curl_, CURLOPT_SEEKDATA, &upload);
    return perform(path, {"Content-Type: " + content_type, "Accept: " + accept, "Expect:"});
}

std::string WebClient::escaped(const std::string& text) const
{
    if (text.empty())
        return {};  // libcurl would measure it by itself
    const std::unique_ptr<char, void (*)(void*)> out(curl_easy_escape(curl_, text.data(), int(text.size())), curl_free);
    return out ? out.get() : "";
}

void WebClient::requireGood(const Answer& answer, const std::string& what) const
{
    if (!answer.good())
        webFailed(what + " (" + statusOf(answer) + ")", peer_);
}

const std::string& uidInPath(const std::string& uid)
{
    constexpr std::size_t kLongestUid = 64;
    if (uid.empty() || uid.size() > kLongestUid || uid.front() == '.' ||
        uid.find_first_not_of("0123456789.") != std::string::npos)
        throw Error(ErrorCode::bad_input, "this is no UID", "'" + uid + "'");
    return uid;
}

std::string statusOf(const WebClient::Answer& answer)
{
    return "HTTP " + std::to_string(answer.status);
}

}  // namespace vicon::ingest
