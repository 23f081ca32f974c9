#pragma once

#include <optional>
#include <string>

#include "lobby.h"

namespace vicon::ingest {

/// A listening TCP socket (IPv4).
class ListeningSocket {
public:
    /// @param address as digits, or a name; @param port 0: any free one
    /// Throws Error{peer} when the address or the port cannot be had.
    ListeningSocket(const std::string& address, int port);
    ~ListeningSocket();
    ListeningSocket(const ListeningSocket&) = delete;
    ListeningSocket& operator=(const ListeningSocket&) = delete;

    int descriptor() const { return descriptor_; }
    int port() const;
    /// The next connection, answers on it being sent at once; nothing when none waits.
    std::optional<Caller> accept() const;

private:
    int descriptor_ = -1;
};

/// The IPv4 addresses of a host, as digits. Asks a name server, which may take as long as the system lets it.
std::vector<std::string> addressesOf(const std::string& host);
/// The first of them; empty when it has none.
std::string addressOf(const std::string& host);

/// Bytes that a connection has brought so far; tells a slow sender from a silent one.
unsigned long long bytesReceived(int socket);

}  // namespace vicon::ingest
