#include "lobby.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>

namespace vicon::ingest {
namespace {

constexpr int kPduHead = 6;  // type, a reserved byte, length: PS3.8, 9.3.1
constexpr std::uint8_t kAssociateRequest = 1;
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

std::uint32_t lengthIn(const std::array<std::uint8_t, kPduHead>& head)
{
    return std::uint32_t(head[2]) << 24 | std::uint32_t(head[3]) << 16 | std::uint32_t(head[4]) << 8 | head[5];
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
        watched.push_back({one.caller.socket, POLLIN, 0});
}

Lobby::Request Lobby::lookAt(int socket)
{
    std::array<std::uint8_t, kPduHead> head{};
    const ssize_t here = ::recv(socket, head.data(), head.size(), MSG_PEEK | MSG_DONTWAIT);
    if (here == 0 || (here < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR))
        return Request::none;
    if (here < kPduHead)
        return isOver(socket) ? Request::none : Request::partial;
    const std::uint32_t length = lengthIn(head);
    if (head[0] != kAssociateRequest || length > kLongestRequest)
        return Request::none;
    const int whole = kPduHead + int(length);
    std::vector<char> all(static_cast<std::size_t>(whole));
    if (::recv(socket, all.data(), all.size(), MSG_PEEK | MSG_DONTWAIT) >= whole)
        return Request::complete;
    wakeAt(socket, whole);
    return isOver(socket) ? Request::none : Request::partial;
}

std::vector<Caller> Lobby::takeReady(std::vector<std::string>& ended)
{
    std::vector<Caller> ready;
    const auto now = std::chrono::steady_clock::now();
    for (auto one = waiting_.begin(); one != waiting_.end();) {
        const Request request = lookAt(one->caller.socket);
        const bool late = now - one->since > longest_;
        if (request == Request::partial && !late) {
            ++one;
            continue;
        }
        if (request == Request::complete) {
            wakeAt(one->caller.socket, 1);
            ready.push_back(one->caller);
        } else {
            if (late)
                ended.push_back("a connection from " + one->caller.host + " made no association request in time");
            ::close(one->caller.socket);
        }
        one = waiting_.erase(one);
    }
    return ready;
}

}  // namespace vicon::ingest
