#include "vicon/ingest/receiver.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <mutex>
#include <thread>

#include "caller_rules.h"
#include "incoming.h"
#include "listening_socket.h"
#include "lobby.h"
#include "storage_association.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr Uint32 kPduBytes = 131072;
constexpr int kLookMilliseconds = 200;  // how soon a stop is noticed
constexpr int kAcceptedAtOnce = 64;
/// What a peer must send within receive.timeout_s: a thousandth of what the slowest line brings, more than a trickle.
constexpr unsigned long long kLeastBytes = 4096;
constexpr std::size_t kMostRefusing = 16;  // threads that tell too many peers that they are too many

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

/// One association and the thread that serves it.
struct Served {
    std::thread thread;
    std::string host;
    int socket = -1;  ///< a duplicate of DCMTK's, so that it cannot name another connection
    bool crowded = false;
    bool ended = false;
    std::atomic<bool> finished = false;
    SteadyClock::time_point alive = SteadyClock::now();  ///< when it last had sent enough
    unsigned long long bytes = 0;                        ///< that it had sent then
};

void requireTitle(const std::string& title)
{
    constexpr std::size_t kLongestTitle = 16;
    if (title.empty() || title.size() > kLongestTitle)
        throw Error(ErrorCode::wrong_use, "an application entity title has 1 to 16 characters", title,
                    "set receive.ae_title");
}

}  // namespace

class Receiver::Implementation {
public:
    Implementation(const ReceiverOptions& options, const fs::path& folder, Handlers handlers)
        : options_((requireTitle(options.ae_title), options)),
          rules_(options.allow),
          handlers_(std::move(handlers)),
          incoming_(folder, {options.quiet_s, options.idle_s}, handlers_.on_received, handlers_.on_trouble),
          listening_(options.address, options.port),
          lobby_(options.max_half_open, options.request_s)
    {
        setUpDicom();
        const LentSocket none_is_opened(0);
        if (ASC_initializeNetwork(NET_ACCEPTOR, port(), int(options_.timeout_s), &network_).bad())
            throw Error(ErrorCode::peer, "the network cannot be used", std::to_string(port()));
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
            waitForNews();
            acceptCallers();
            std::vector<std::string> ended;
            for (const Caller& caller : lobby_.takeReady(ended))
                serve(caller);
            for (const std::string& line : ended)
                incoming_.trouble(line);
            endSilent();
        }
        endAssociations();
        incoming_.finish();
    }

    int port() const { return listening_.port(); }

private:
    void waitForNews() const
    {
        std::vector<pollfd> watched{{listening_.descriptor(), POLLIN, 0}};
        lobby_.addTo(watched);
        ::poll(watched.data(), watched.size(), kLookMilliseconds);
    }

    void acceptCallers()
    {
        for (int n = 0; n < kAcceptedAtOnce; ++n)
            if (const auto caller = listening_.accept())
                lobby_.enter(*caller);
            else
                return;
    }

    /// The request is there as a whole: reading it does not wait.
    T_ASC_Association* readRequest(const Caller& caller)
    {
        constexpr int kNoWait = 1;
        T_ASC_Association* association = nullptr;
        const LentSocket lent(caller.socket);
        const OFCondition received =
            ASC_receiveAssociation(network_, &association, kPduBytes, nullptr, nullptr, OFFalse, DUL_NOBLOCK, kNoWait);
        if (received.good())
            return association;
        incoming_.trouble("a connection from " + caller.host + " made no proper association request");
        if (association) {
            ASC_dropSCPAssociation(association);
            ASC_destroyAssociation(&association);
        }
        return nullptr;
    }

    void serve(const Caller& caller)
    {
        const bool crowded = !makeRoomFor(caller.host);
        if (crowded && refusing() >= kMostRefusing) {
            ::close(caller.socket);
            return;
        }
        const int socket = ::dup(caller.socket);
        T_ASC_Association* association = readRequest(caller);
        if (!association || socket < 0) {
            ::close(socket);
            return;
        }
        Served& served = served_.emplace_back();
        served.host = caller.host;
        served.socket = socket;
        served.crowded = crowded;
        served.thread = std::thread([this, &served, association] {
            try {
                const StorageService service{options_, rules_, incoming_, handlers_};
                StorageAssociation scp(service, served.host);
                scp.serve(association, served.crowded);
            } catch (const std::exception& e) {
                incoming_.trouble(e.what());
            }
            ::shutdown(served.socket, SHUT_RDWR);
            served.finished = true;
        });
    }

    std::size_t refusing() const
    {
        return std::size_t(std::count_if(served_.begin(), served_.end(), [](const Served& s) { return s.crowded; }));
    }

    /// Whether one more of this host can be served; where there are too many, one that is idle ends for it.
    bool makeRoomFor(const std::string& host)
    {
        const auto counts = [](const Served& s) { return !s.crowded && !s.ended && !s.finished; };
        const auto of_host = [&](const Served& s) { return counts(s) && s.host == host; };
        if (std::count_if(served_.begin(), served_.end(), of_host) >= options_.max_per_host)
            return endIdlest(of_host);
        if (std::count_if(served_.begin(), served_.end(), counts) >= options_.max_associations)
            return endIdlest(counts);
        return true;
    }

    template <class Which>
    bool endIdlest(Which which)
    {
        Served* idlest = nullptr;
        for (Served& one : served_)
            if (which(one) && (!idlest || one.alive < idlest->alive))
                idlest = &one;
        if (!idlest || SteadyClock::now() - idlest->alive < std::chrono::duration<double>(options_.idle_s))
            return false;
        end(*idlest, "was idle, and another peer needs its place");
        return true;
    }

    /// Ends associations that bring next to nothing: silent, idle or trickling.
    void endSilent()
    {
        const auto now = SteadyClock::now();
        for (Served& one : served_) {
            if (one.ended || one.finished)
                continue;
            const unsigned long long bytes = bytesReceived(one.socket);
            if (bytes - one.bytes >= kLeastBytes) {
                one.bytes = bytes;
                one.alive = now;
            } else if (now - one.alive > std::chrono::duration<double>(options_.timeout_s)) {
                end(one, "sent next to nothing for " + std::to_string(int(options_.timeout_s)) + " s");
            }
        }
    }

    void end(Served& one, const std::string& why)
    {
        incoming_.trouble("an association from " + one.host + " was ended: it " + why);
        one.ended = true;
        ::shutdown(one.socket, SHUT_RDWR);
    }

    void joinFinished()
    {
        served_.remove_if([](Served& one) {
            if (!one.finished)
                return false;
            one.thread.join();
            ::close(one.socket);
            return true;
        });
    }

    void endAssociations()
    {
        for (const Served& one : served_)
            ::shutdown(one.socket, SHUT_RDWR);
        for (Served& one : served_) {
            one.thread.join();
            ::close(one.socket);
        }
        served_.clear();
    }

    const ReceiverOptions options_;
    const CallerRules rules_;
    const Handlers handlers_;
    Incoming incoming_;
    const ListeningSocket listening_;
    Lobby lobby_;
    T_ASC_Network* network_ = nullptr;
    std::list<Served> served_;
};

Receiver::Receiver(const ReceiverOptions& options, const fs::path& incoming_folder, Handlers handlers)
    : implementation_(std::make_unique<Implementation>(options, incoming_folder, std::move(handlers)))
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
