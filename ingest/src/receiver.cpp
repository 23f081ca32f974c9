#include "vicon/ingest/receiver.h"

#include <dcmtk/config/osconfig.h>

#include <arpa/inet.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/scpthrd.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <list>

#include "dicom_setup.h"
#include "incoming.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr Uint32 kPduBytes = 131072;  // the largest that DCMTK receives
constexpr int kAcceptSeconds = 1;     // how soon a stop is noticed
constexpr Uint16 kOutOfResources = STATUS_STORE_Refused_OutOfResources;

/// In order of preference where a peer offers several at once: what is not compressed first, so that nobody compresses
/// for VICON; what loses nothing before what does.
const char* const kTransferSyntaxes[] = {
    UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax,
    UID_BigEndianExplicitTransferSyntax,    UID_DeflatedExplicitVRLittleEndianTransferSyntax,
    UID_JPEGProcess14SV1TransferSyntax,     UID_JPEGProcess14TransferSyntax,
    UID_JPEGLSLosslessTransferSyntax,       UID_JPEG2000LosslessOnlyTransferSyntax,
    UID_RLELosslessTransferSyntax,          UID_JPEG2000TransferSyntax,
    UID_JPEGLSLossyTransferSyntax,          UID_JPEGProcess2_4TransferSyntax,
    UID_JPEGProcess6_8TransferSyntax,       UID_JPEGProcess10_12TransferSyntax,
    UID_JPEGProcess1TransferSyntax};

DcmSCPConfig configFor(const ReceiverOptions& options)
{
    DcmSCPConfig config;
    config.setAETitle(options.ae_title.c_str());
    config.setMaxReceivePDULength(kPduBytes);
    config.setHostLookupEnabled(OFFalse);
    config.setDIMSEBlockingMode(DIMSE_NONBLOCKING);
    config.setDIMSETimeout(Uint32(options.timeout_s));
    config.setACSETimeout(Uint32(options.timeout_s));
    OFList<OFString> syntaxes;
    for (const char* syntax : kTransferSyntaxes)
        syntaxes.push_back(syntax);
    config.addPresentationContext(UID_VerificationSOPClass, syntaxes);
    for (int n = 0; n < numberOfDcmAllStorageSOPClassUIDs; ++n)
        config.addPresentationContext(dcmAllStorageSOPClassUIDs[n], syntaxes);
    return config;
}

/// A loopback of bind() tells a free port; DCMTK takes numbers only.
int freePort()
{
    const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_ANY);
    socklen_t length = sizeof address;
    int port = 0;
    if (::bind(descriptor, reinterpret_cast<sockaddr*>(&address), length) == 0 &&
        ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) == 0)
        port = ntohs(address.sin_port);
    ::close(descriptor);
    return port;
}

/// Remembers the socket of the connection that was accepted last, so that a stop can end it.
class SocketRememberingLayer : public DcmTransportLayer {
public:
    DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool secure) override
    {
        last_ = socket;
        return DcmTransportLayer::createConnection(socket, secure);
    }
    int last() const { return int(last_); }

private:
    DcmNativeSocketType last_ = -1;
};

/// Serves one association.
class StorageAssociation : public DcmThreadSCP {
public:
    StorageAssociation(Incoming& incoming, const ReceiverOptions& options) : incoming_(incoming), options_(options) {}

    void serve(T_ASC_Association* association)
    {
        folder_ = incoming_.open();
        run(association);
        incoming_.close(folder_);
    }

protected:
    OFBool checkCalledAETitleAccepted(const OFString& called) override
    {
        return options_.any_called_title || called == options_.ae_title.c_str();
    }

    OFCondition handleIncomingCommand(T_DIMSE_Message* message, const DcmPresentationContextInfo& context) override
    {
        if (message->CommandField != DIMSE_C_STORE_RQ)
            return DcmThreadSCP::handleIncomingCommand(message, context);
        T_DIMSE_C_StoreRQ& request = message->msg.CStoreRQ;
        Uint16 status = STATUS_Success;
        const OFCondition received = receive(request, context.presentationContextID, status);
        if (received.bad())
            return received;
        return sendSTOREResponse(context.presentationContextID, request, status);
    }

private:
    OFCondition receive(T_DIMSE_C_StoreRQ& request, T_ASC_PresentationContextID context, Uint16& status)
    {
        OFCondition received = EC_Normal;
        const fs::path file = folder_ / (std::to_string(count_++) + ".dcm");
        struct NotReceived {};
        try {
            replaceFile(file, [&](const fs::path& temporary) {
                received = receiveSTORERequest(request, context, OFString(temporary.c_str()));
                if (received.bad())
                    throw NotReceived{};
            });
            incoming_.add(folder_, file);
        } catch (const NotReceived&) {
            incoming_.trouble("an object was not received completely: " + std::string(received.text()));
        } catch (const std::exception& e) {
            status = kOutOfResources;
            incoming_.trouble(e.what());
        }
        return received;
    }

    Incoming& incoming_;
    const ReceiverOptions& options_;
    fs::path folder_;
    int count_ = 0;
};

}  // namespace

class Receiver::Implementation {
public:
    Implementation(const ReceiverOptions& options, const fs::path& folder, OnReceived on_received, OnTrouble on_trouble)
        : options_(options),
          port_(options.port > 0 ? options.port : freePort()),
          incoming_(folder, options.idle_s, std::move(on_received), std::move(on_trouble))
    {
        constexpr std::size_t kLongestTitle = 16;
        if (options_.ae_title.empty() || options_.ae_title.size() > kLongestTitle)
            throw Error(ErrorCode::wrong_use, "an application entity title has 1 to 16 characters", options_.ae_title,
                        "set receive.ae_title");
        setUpDicom();
        const OFCondition opened = ASC_initializeNetwork(NET_ACCEPTOR, port_, int(options_.timeout_s), &network_);
        if (opened.bad())
            throw Error(ErrorCode::peer, "the port cannot be listened on", std::to_string(port_),
                        "another program may use it: set receive.port");
        ASC_setTransportLayer(network_, &layer_, 0);
        shared_config_ = DcmSharedSCPConfig(configFor(options_));
    }

    ~Implementation()
    {
        endAssociations();
        ASC_dropNetwork(&network_);
    }

    void run(const std::atomic<bool>& stop)
    {
        incoming_.start();
        while (!stop) {
            joinFinished();
            acceptOne();
        }
        endAssociations();
        incoming_.finish();
    }

    int port() const { return port_; }

private:
    struct Open {
        std::thread thread;
        int socket = -1;  ///< a duplicate of DCMTK's, so that it cannot name another connection
        std::atomic<bool> finished = false;
    };

    void acceptOne()
    {
        T_ASC_Association* association = nullptr;
        const OFCondition accepted = ASC_receiveAssociation(network_, &association, kPduBytes, nullptr, nullptr,
                                                            OFFalse, DUL_NOBLOCK, kAcceptSeconds);
        if (accepted.bad() || open_.size() >= std::size_t(options_.max_associations)) {
            if (accepted.good()) {
                const T_ASC_RejectParameters busy{ASC_RESULT_REJECTEDTRANSIENT,
                                                  ASC_SOURCE_SERVICEPROVIDER_PRESENTATION_RELATED,
                                                  ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED};
                ASC_rejectAssociation(association, &busy);
            }
            if (association) {
                ASC_dropSCPAssociation(association);
                ASC_destroyAssociation(&association);
            }
            return;
        }
        Open& open = open_.emplace_back();
        open.socket = ::dup(layer_.last());
        open.thread = std::thread([this, &open, association] {
            try {
                StorageAssociation scp(incoming_, options_);
                scp.setSharedConfig(shared_config_);
                scp.serve(association);
            } catch (const std::exception& e) {
                incoming_.trouble(e.what());
            }
            ::close(open.socket);
            open.finished = true;
        });
    }

    void joinFinished()
    {
        for (auto it = open_.begin(); it != open_.end();) {
            if (it->finished) {
                it->thread.join();
                it = open_.erase(it);
            } else {
                ++it;
            }
        }
    }

    void endAssociations()
    {
        for (Open& open : open_) {
            if (!open.finished)
                ::shutdown(open.socket, SHUT_RDWR);
            open.thread.join();
        }
        open_.clear();
    }

    ReceiverOptions options_;
    int port_;
    Incoming incoming_;
    SocketRememberingLayer layer_;
    T_ASC_Network* network_ = nullptr;
    DcmSharedSCPConfig shared_config_;
    std::list<Open> open_;
};

Receiver::Receiver(const ReceiverOptions& options, const fs::path& incoming_folder, OnReceived on_received,
                   OnTrouble on_trouble)
    : implementation_(
          std::make_unique<Implementation>(options, incoming_folder, std::move(on_received), std::move(on_trouble)))
{
}

Receiver::~Receiver() = default;

void Receiver::run(const std::atomic<bool>& stop)
{
    implementation_->run(stop);
}

int Receiver::port() const
{
    return implementation_->port();
}

}  // namespace vicon::ingest
