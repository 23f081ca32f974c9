#include "tls_server.h"

#include <fcntl.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "tls_layer.h"
#include "vicon/core/error.h"
#include "watched_connection.h"

namespace vicon::ingest {
namespace {

void setBlocking(int socket, bool blocking)
{
    const int flags = ::fcntl(socket, F_GETFL);
    ::fcntl(socket, F_SETFL, blocking ? flags & ~O_NONBLOCK : flags | O_NONBLOCK);
}

/// A connection whose handshake is over, and of which something was read already.
class BegunConnection : public DcmTLSConnection {
public:
    BegunConnection(int socket, SSL* ssl, std::string begun) : DcmTLSConnection(socket, ssl), begun_(std::move(begun))
    {
    }

    OFCondition serverSideHandshake() override { return EC_Normal; }
    ssize_t read(void* to, size_t bytes) override
    {
        if (begun_.empty())
            return DcmTLSConnection::read(to, bytes);
        const std::size_t here = std::min(bytes, begun_.size());
        std::memcpy(to, begun_.data(), here);
        begun_.erase(0, here);
        return ssize_t(here);
    }
    OFBool networkDataAvailable(int timeout_s) override
    {
        return !begun_.empty() || DcmTLSConnection::networkDataAvailable(timeout_s);
    }

private:
    std::string begun_;
};

}  // namespace

TlsSession::TlsSession(SSL* ssl, int socket) : ssl_(ssl), socket_(socket)
{
    setBlocking(socket_, false);
    SSL_set_fd(ssl_, socket_);
}

TlsSession::~TlsSession()
{
    SSL_free(ssl_);
}

TlsSession::State TlsSession::fail(int result)
{
    const int what = SSL_get_error(ssl_, result);
    if (what == SSL_ERROR_WANT_READ || what == SSL_ERROR_WANT_WRITE)
        return State::under_way;
    const long verified = SSL_get_verify_result(ssl_);
    const char* const reason = ERR_reason_error_string(ERR_peek_last_error());
    why_failed_ = verified != X509_V_OK ? X509_verify_cert_error_string(verified) : reason ? reason : "it hung up";
    ERR_clear_error();
    return State::failed;
}

TlsSession::State TlsSession::proceed(const std::function<State(const std::string&)>& judge)
{
    constexpr std::size_t kRecord = 16384;  // of TLS, at most
    ERR_clear_error();
    if (!shaken_) {
        if (const int result = SSL_accept(ssl_); result != 1)
            return fail(result);
        shaken_ = true;
    }
    for (std::array<char, kRecord> block{};;) {
        const int count = SSL_read(ssl_, block.data(), int(block.size()));
        if (count <= 0)
            return fail(count);
        begun_.append(block.data(), std::size_t(count));
        if (const State state = judge(begun_); state != State::under_way)
            return state;
    }
}

bool TlsSession::wantsToWrite() const
{
    return SSL_want_write(ssl_) == 1;
}

DcmTransportConnection* TlsSession::release(std::shared_ptr<MessageWatch> watch)
{
    setBlocking(socket_, true);
    return new Watched<BegunConnection>(std::move(watch), socket_, std::exchange(ssl_, nullptr), std::move(begun_));
}

TlsServer::TlsServer(TlsOptions options, std::function<void(const std::string&)> on_trouble)
    : options_(std::move(options)),
      on_trouble_(std::move(on_trouble)),
      files_(stateOfFiles()),
      layer_(makeTlsLayer(options_))
{
}

std::vector<std::string> TlsServer::stateOfFiles() const
{
    std::vector<std::string> states;
    for (const std::string& file : {options_.certificate, options_.key, options_.trusted}) {
        struct stat about {};
        std::string state = "gone";
        if (::stat(file.c_str(), &about) == 0) {
            state = std::to_string(about.st_ino) + " " + std::to_string(about.st_size);
            for (const timespec& time : {about.st_mtim, about.st_ctim})
                state += " " + std::to_string(time.tv_sec) + "." + std::to_string(time.tv_nsec);
        }
        states.push_back(std::move(state));
    }
    return states;
}

/// Files are replaced one after the other: until they fit together, the ones before serve on.
void TlsServer::renew()
{
    std::vector<std::string> now = stateOfFiles();
    if (now == files_)
        return;
    files_ = std::move(now);
    try {
        layer_ = makeTlsLayer(options_);
    } catch (const Error& e) {
        if (on_trouble_)
            on_trouble_(std::string("the certificates before are used on, those of now cannot be: ") + e.what());
    }
}

std::unique_ptr<TlsSession> TlsServer::accept(int socket)
{
    renew();
    SSL* const ssl = SSL_new(layer_->getNativeHandle());
    return ssl ? std::make_unique<TlsSession>(ssl, socket) : nullptr;
}

}  // namespace vicon::ingest
