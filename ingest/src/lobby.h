#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "tls_server.h"

namespace vicon::ingest {

/// A connection that is accepted and has said nothing whole yet, or what it has become.
struct Caller {
    int socket = -1;
    std::string host;                 ///< IPv4 address
    std::unique_ptr<TlsSession> tls;  ///< null: it speaks plainly
};

/// The connections whose association request has not come completely. They wait here without a thread of their own, so
/// that a silent, partial or trickling one stops nobody; when there are too many, the oldest of the host with the most
/// is ended. Not for several threads.
class Lobby {
public:
    /// @param most connections that may wait at once
    /// @param longest_s that one may take for its whole request
    /// @param tls null: where none is spoken
    Lobby(int most, double longest_s, TlsUse use, TlsServer* tls)
        : most_(std::size_t(most)), longest_(longest_s), use_(use), tls_(tls)
    {
    }
    ~Lobby();
    struct Ended {
        std::string host, line;
        bool refused;  ///< for how it speaks TLS; else it was too slow
    };
    Lobby(const Lobby&) = delete;
    Lobby& operator=(const Lobby&) = delete;

    void enter(Caller caller);
    /// What poll() is to look at.
    void addTo(std::vector<pollfd>& watched) const;
    /// The callers whose request is complete; it can be read without waiting. Their sockets are the receiver's now.
    /// Those that left, took too long or speak no DICOM are gone, each told of in `ended`.
    std::vector<Caller> takeReady(std::vector<Ended>& ended);

private:
    using State = TlsSession::State;
    struct Waiting {
        Caller caller;
        std::chrono::steady_clock::time_point since;
        std::string why_ended = {};  ///< where it is worth a line
    };
    State lookAt(Waiting& one) const;
    State beginTls(Waiting& one) const;
    static State goOnWithTls(Waiting& one);
    void endOne();

    std::size_t most_;
    std::chrono::duration<double> longest_;
    TlsUse use_;
    TlsServer* tls_;
    std::list<Waiting> waiting_;  ///< oldest first
};

}  // namespace vicon::ingest
