#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/dcmlayer.h>

#include <cerrno>
#include <memory>

#include "message_watch.h"
#include "quick_connection.h"

namespace vicon::ingest {

/// A connection that a watch looks at before DCMTK does: what it refuses is the end of it.
template <class Connection>
class Watched : public Connection {
public:
    template <class... Arguments>
    explicit Watched(std::shared_ptr<MessageWatch> watch, Arguments&&... arguments)
        : Connection(std::forward<Arguments>(arguments)...), watch_(std::move(watch))
    {
    }

    ssize_t read(void* bytes, size_t count) override
    {
        const ssize_t came = Connection::read(bytes, count);
        if (came <= 0 || watch_->receive({static_cast<const unsigned char*>(bytes), std::size_t(came)}))
            return came;
        errno = ECONNABORTED;
        return -1;
    }
    ssize_t write(void* bytes, size_t count) override
    {
        const ssize_t went = Connection::write(bytes, count);
        if (went > 0)
            watch_->send({static_cast<const unsigned char*>(bytes), std::size_t(went)});
        return went;
    }

private:
    std::shared_ptr<MessageWatch> watch_;
};

/// Makes watched connections, one at a time.
class WatchingLayer : public DcmTransportLayer {
public:
    /// Of the connection that was made last; null where none was.
    std::shared_ptr<const MessageWatch> watch() const { return watch_; }

protected:
    std::shared_ptr<MessageWatch> newWatch() { return watch_ = std::make_shared<MessageWatch>(); }

private:
    std::shared_ptr<MessageWatch> watch_;
};

/// Plain connections that acknowledge at once.
class QuickLayer : public WatchingLayer {
public:
    DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool) override
    {
        return new Watched<QuickConnection>(newWatch(), socket);  // DCMTK's to delete
    }
};

}  // namespace vicon::ingest
