#include "association_reader.h"

#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>

#include <mutex>
#include <string>
#include <utility>

#include "association.h"
#include "vicon/core/error.h"
#include "watched_connection.h"

namespace vicon::ingest {
namespace {

/// DCMTK takes a socket that it did not accept itself from a variable of the process, which threads share.
class LentSocket {
public:
    explicit LentSocket(int socket) : lock_(mutex()) { dcmExternalSocketHandle.set(socket); }
    ~LentSocket() { dcmExternalSocketHandle.set(-1); }
    LentSocket(const LentSocket&) = delete;
    LentSocket& operator=(const LentSocket&) = delete;

private:
    static std::mutex& mutex()
    {
        static std::mutex shared;
        return shared;
    }
    std::lock_guard<std::mutex> lock_;
};

}  // namespace

/// Goes on with the TLS session that a caller has begun.
class AssociationReader::Layer : public WatchingLayer {
public:
    void lend(std::unique_ptr<TlsSession> session) { session_ = std::move(session); }
    DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool) override
    {
        if (!session_)
            return new Watched<QuickConnection>(newWatch(), socket);
        return std::exchange(session_, nullptr)->release(newWatch());
    }

private:
    std::unique_ptr<TlsSession> session_;
};

AssociationReader::AssociationReader(int port, int timeout_s) : layer_(std::make_unique<Layer>())
{
    const LentSocket none_is_opened(0);
    if (ASC_initializeNetwork(NET_ACCEPTOR, port, timeout_s, &network_).bad() ||
        ASC_setTransportLayer(network_, layer_.get(), 0).bad())
        throw Error(ErrorCode::peer, "the network cannot be used", std::to_string(port));
}

AssociationReader::~AssociationReader()
{
    ASC_dropNetwork(&network_);
}

AssociationReader::Read AssociationReader::read(Caller caller)
{
    constexpr int kNoWait = 1;
    T_ASC_Association* association = nullptr;
    const LentSocket lent(caller.socket);
    const bool secure = caller.tls != nullptr;
    layer_->lend(std::move(caller.tls));
    const OFCondition received =
        ASC_receiveAssociation(network_, &association, kPduBytes, nullptr, nullptr, secure, DUL_NOBLOCK, kNoWait);
    layer_->lend(nullptr);
    if (received.good())
        return {association, layer_->watch()};
    if (association) {
        ASC_dropSCPAssociation(association);
        ASC_destroyAssociation(&association);
    }
    return {};
}

}  // namespace vicon::ingest
