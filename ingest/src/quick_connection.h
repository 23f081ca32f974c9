#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/dcmtrans.h>

namespace vicon::ingest {

/// What has come, and what comes next.
void acknowledgeAtOnce(int socket);

/// A connection that acknowledges at once what it reads. DCMTK writes a message in small pieces, and a peer that does
/// so by Nagle's algorithm sends the second when the first is acknowledged: Linux would let it wait for 40 ms, once a
/// message.
template <class Connection>
class Acknowledging : public Connection {
public:
    using Connection::Connection;

    ssize_t read(void* bytes, size_t count) override
    {
        acknowledgeAtOnce(this->getSocket());  // each time: the system falls back by itself
        return Connection::read(bytes, count);
    }
};

using QuickConnection = Acknowledging<DcmTCPConnection>;

}  // namespace vicon::ingest
