#include "listening_socket.h"

#include <arpa/inet.h>
#include <linux/tcp.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr int kBacklog = 1024;

std::string digitsOf(const in_addr& address)
{
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &address, text.data(), text.size());
    return text.data();
}

sockaddr_in endpointFor(const std::string& address, int port)
{
    sockaddr_in endpoint{};
    endpoint.sin_family = AF_INET;
    endpoint.sin_port = htons(std::uint16_t(port));
    const std::string digits = addressOf(address);
    if (digits.empty() || ::inet_pton(AF_INET, digits.c_str(), &endpoint.sin_addr) != 1)
        throw Error(ErrorCode::peer, "no such address to listen on", address,
                    "set receive.address to an IPv4 address of this machine, or 0.0.0.0 for all of them");
    return endpoint;
}

}  // namespace

std::vector<std::string> addressesOf(const std::string& host)
{
    addrinfo wanted{}, *found = nullptr;
    wanted.ai_family = AF_INET;
    wanted.ai_socktype = SOCK_STREAM;
    if (::getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0)
        return {};
    std::vector<std::string> all;
    for (const addrinfo* one = found; one; one = one->ai_next)
        all.push_back(digitsOf(reinterpret_cast<const sockaddr_in*>(one->ai_addr)->sin_addr));
    ::freeaddrinfo(found);
    return all;
}

std::string addressOf(const std::string& host)
{
    const std::vector<std::string> all = addressesOf(host);
    return all.empty() ? "" : all.front();
}

ListeningSocket::ListeningSocket(const std::string& address, int port)
{
    const sockaddr_in endpoint = endpointFor(address, port);
    descriptor_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&endpoint), sizeof endpoint) == 0 &&
        ::listen(descriptor_, kBacklog) == 0)
        return;
    const std::string why = std::strerror(errno);
    ::close(descriptor_);
    throw Error(ErrorCode::peer, "the port cannot be listened on (" + why + ")", address + ":" + std::to_string(port),
                "another program may use it: set receive.port");
}

ListeningSocket::~ListeningSocket()
{
    ::close(descriptor_);
}

int ListeningSocket::port() const
{
    sockaddr_in endpoint{};
    socklen_t length = sizeof endpoint;
    ::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&endpoint), &length);
    return ntohs(endpoint.sin_port);
}

std::optional<Caller> ListeningSocket::accept() const
{
    sockaddr_in from{};
    socklen_t length = sizeof from;
    const int socket = ::accept4(descriptor_, reinterpret_cast<sockaddr*>(&from), &length, SOCK_CLOEXEC);
    if (socket < 0)
        return {};
    const int yes = 1;  // a response is two short packets: the second must not wait for the first to be acknowledged
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    return Caller{socket, digitsOf(from.sin_addr), nullptr};
}

unsigned long long bytesReceived(int socket)
{
    tcp_info info{};
    socklen_t length = sizeof info;
    return ::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &length) == 0 ? info.tcpi_bytes_received : 0;
}

}  // namespace vicon::ingest
