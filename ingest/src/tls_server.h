#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmtls/tlslayer.h>
#include <dcmtk/dcmtls/tlstrans.h>

#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "message_watch.h"
#include "vicon/ingest/tls.h"

namespace vicon::ingest {

/// A TLS connection that a peer opened, while its handshake and its first message are under way; never waits.
class TlsSession {
public:
    enum class State { under_way, complete, failed };

    TlsSession(SSL* ssl, int socket);
    ~TlsSession();
    TlsSession(const TlsSession&) = delete;
    TlsSession& operator=(const TlsSession&) = delete;

    /// Goes as far as what has come allows. Then the handshake is over and it is as `judge` says of the bytes that came
    /// since, or it is under way, or failed: see whyFailed().
    State proceed(const std::function<State(const std::string&)>& judge);
    /// Whether it waits until it can write, else until something comes.
    bool wantsToWrite() const;
    const std::string& whyFailed() const { return why_failed_; }
    /// For DCMTK, which then waits for the socket, and owns it. Only once.
    DcmTransportConnection* release(std::shared_ptr<MessageWatch> watch);

private:
    State fail(int result);

    SSL* ssl_;
    int socket_;
    bool shaken_ = false;
    std::string begun_;  ///< what came after the handshake
    std::string why_failed_;
};

/// Takes TLS connections, with the certificates that lie in the files now.
class TlsServer {
public:
    /// Throws Error{wrong_use}. @param on_trouble told when files that were replaced cannot be used
    TlsServer(TlsOptions options, std::function<void(const std::string&)> on_trouble);
    /// Null when there is no memory.
    std::unique_ptr<TlsSession> accept(int socket);

private:
    std::vector<std::string> stateOfFiles() const;
    void renew();

    TlsOptions options_;
    std::function<void(const std::string&)> on_trouble_;
    std::vector<std::string> files_;  ///< as they were when last read
    std::unique_ptr<DcmTLSTransportLayer> layer_;
};

}  // namespace vicon::ingest
