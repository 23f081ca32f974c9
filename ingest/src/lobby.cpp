#include "lobby.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace vicon::ingest {
namespace {

constexpr int kPduHead = 6;  // type, a reserved byte, length: PS3.8, 9.3.1
constexpr std::uint8_t kAssociateRequest = 1;
constexpr std::uint8_t kTlsHandshake = 22;  // RFC 8446, 5.1
/// A request with 128 presentation contexts of many syntaxes has 40,000 bytes; a socket holds these unread.
constexpr std::uint32_t kLongestRequest = 60000;

/// poll() wakes when so much is there, not for each byte of a trickle.
void wakeAt(int socket, int bytes)
{
    ::setsockopt(socket, SOL_SOCKET, SO_RCVLOWAT, &bytes, sizeof bytes);
}

/// Whether the other side will send no more.
bool isOver(int socket)
{
    pollfd watched{socket, POLLRDHUP, 0};
    return ::poll(&watched, 1, 0) > 0;
}

using Head = std::array<std::uint8_t, kPduHead>;

std::uint32_t lengthIn(const Head& head)
{
    return std::uint32_t(head[2]) << 24 | std::uint32_t(head[3]) << 16 | std::uint32_t(head[4]) << 8 | head[5];
}

bool beginsRequest(const Head& head)
{
    return head[0] == kAssociateRequest && lengthIn(head) <= kLongestRequest;
}

/// Whether these bytes are an association request, as far as they go.
TlsSession::State requestIn(const std::string& bytes)
{
    Head head{};
    if (bytes.size() < head.size())
        return TlsSession::State::under_way;
    std::copy_n(bytes.begin(), head.size(), head.begin());
    if (!beginsRequest(head))
        return TlsSession::State::failed;
    return bytes.size() < head.size() + lengthIn(head) ? TlsSession::State::under_way : TlsSession::State::complete;
}

}  // namespace

Lobby::~Lobby()
{
    for (const Waiting& one : waiting_)
        ::close(one.caller.socket);
}

void Lobby::enter(Caller caller)
{
    if (waiting_.size() >= most_)
        endOne();
    constexpr int kRoom = 2 * int(kLongestRequest);  // the kernel counts its own bookkeeping too
    ::setsockopt(caller.socket, SOL_SOCKET, SO_RCVBUF, &kRoom, sizeof kRoom);
    wakeAt(caller.socket, kPduHead);
    waiting_.push_back({std::move(caller), std::chrono::steady_clock::now()});
}

void Lobby::endOne()
{
    std::map<std::string, int> of_host;
    for (const Waiting& one : waiting_)
        ++of_host[one.caller.host];
    const auto most = std::max_element(of_host.begin(), of_host.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto oldest = std::find_if(waiting_.begin(), waiting_.end(),
                                     [&](const Waiting& one) { return one.caller.host == most->first; });
    ::close(oldest->caller.socket);
    waiting_.erase(oldest);
}

void Lobby::addTo(std::vector<pollfd>& watched) const
{
    for (const Waiting& one : waiting_)
        watched.push_back(
            {one.caller.socket, short(one.caller.tls && one.caller.tls->wantsToWrite() ? POLLOUT : POLLIN), 0});
}

Lobby::State Lobby::lookAt(Waiting& one) const
{
    if (one.caller.tls)
        return goOnWithTls(one);
    const int socket = one.caller.socket;
    Head head{};
    const ssize_t here = ::recv(socket, head.data(), head.size(), MSG_PEEK | MSG_DONTWAIT);
    if (here == 0 || (here < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR))
        return State::failed;
    if (here > 0 && head[0] == kTlsHandshake)
        return beginTls(one);
    if (here < kPduHead)
        return isOver(socket) ? State::failed : State::under_way;
    if (!beginsRequest(head))
        return State::failed;
    if (use_ == TlsUse::required) {
        one.why_ended = "does not speak TLS";
        return State::failed;
    }
    const int whole = kPduHead + int(lengthIn(head));
    std::vector<char> all(static_cast<std::size_t>(whole));
    if (::recv(socket, all.data(), all.size(), MSG_PEEK | MSG_DONTWAIT) >= whole)
        return State::complete;
    wakeAt(socket, whole);
    return isOver(socket) ? State::failed : State::under_way;
}

Lobby::State Lobby::beginTls(Waiting& one) const
{
    if (use_ == TlsUse::off || !tls_) {
        one.why_ended = "speaks TLS, which receive.tls does not offer";
        return State::failed;
    }
    wakeAt(one.caller.socket, 1);
    one.caller.tls = tls_->accept(one.caller.socket);
    return one.caller.tls ? goOnWithTls(one) : State::failed;
}

Lobby::State Lobby::goOnWithTls(Waiting& one)
{
    const State state = one.caller.tls->proceed(requestIn);
    if (state == State::failed && !one.caller.tls->whyFailed().empty())
        one.why_ended = "came to no terms by TLS: " + one.caller.tls->whyFailed();
    return state;
}

std::vector<Caller> Lobby::takeReady(std::vector<Ended>& ended)
{
    std::vector<Caller> ready;
    const auto now = std::chrono::steady_clock::now();
    for (auto one = waiting_.begin(); one != waiting_.end();) {
        const State state = lookAt(*one);
        const bool late = now - one->since > longest_;
        if (state == State::under_way && !late) {
            ++one;
            continue;
        }
        if (state == State::complete) {
            wakeAt(one->caller.socket, 1);
            ready.push_back(std::move(one->caller));
        } else {
            if (state == State::under_way)
                one->why_ended = "made no association request in time";
            if (!one->why_ended.empty())
                ended.push_back({one->caller.host, "a connection from " + one->caller.host + " " + one->why_ended,
                                 state == State::failed});
            ::close(one->caller.socket);
        }
        one = waiting_.erase(one);
    }
    return ready;
}

}  // namespace vicon::ingest
