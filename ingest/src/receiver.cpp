#include "vicon/ingest/receiver.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <map>
#include <mutex>
#include <thread>

#include "association_reader.h"
#include "caller_rules.h"
#include "commitment_desk.h"
#include "incoming.h"
#include "listening_socket.h"
#include "lobby.h"
#include "pace.h"
#include "storage_association.h"
#include "tls_server.h"
#include "vicon/core/error.h"
#include "vicon/dicom/dicom_setup.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kLookMilliseconds = 200;  // how soon a stop is noticed
constexpr int kAcceptedAtOnce = 64;
/// What a peer must send within receive.timeout_s: a thousandth of what the slowest line brings, more than a trickle.
constexpr unsigned long long kLeastBytes = 4096;
constexpr std::size_t kMostRefusing = 16;  // threads that tell too many peers that they are too many

void requireTitle(const std::string& title)
{
    constexpr std::size_t kLongestTitle = 16;
    if (title.empty() || title.size() > kLongestTitle)
        throw Error(ErrorCode::wrong_use, "an application entity title has 1 to 16 characters", title,
                    "set receive.ae_title");
}

}  // namespace

class Receiver::Implementation {
    /// One association and the thread that serves it.
    struct Served {
        std::thread thread;
        std::string host;
        const Peer* peer = nullptr;  ///< by the configuration
        int socket = -1;             ///< a duplicate of DCMTK's, so that it cannot name another connection
        bool crowded = false;
        bool ended = false;
        std::atomic<bool> finished = false;
        SteadyClock::time_point alive = SteadyClock::now();  ///< when it last had sent enough
        unsigned long long bytes = 0;                        ///< that it had sent then
    };

public:
    Implementation(const ReceiverOptions& options, const fs::path& folder, Handlers handlers, const Network& network)
        : options_((setUpDicom(), requireTitle(options.ae_title), options)),
          rules_(options, network.peers),
          handlers_(std::move(handlers)),
          pace_(options.mb_per_s),
          desk_(folder.parent_path() / "commitments", options_, handlers_, rules_),
          incoming_(folder, {options.quiet_s, options.idle_s, options.incomplete_s}, handlers_),
          listening_(options.address, options.port),
          tls_(options_.tls == TlsUse::off ? nullptr : std::make_unique<TlsServer>(network.tls, handlers_.on_trouble)),
          lobby_(options.max_half_open, options.request_s, options_.tls, tls_.get()),
          reader_(port(), int(options.timeout_s))
    {
    }

    ~Implementation() { endAssociations(); }

    void run(const std::atomic<bool>& stop)
    {
        incoming_.start();
        desk_.start();
        while (!stop) {
            for (const std::string& line : rules_.news())
                incoming_.trouble(line);
            joinFinished();
            waitForNews();
            acceptCallers();
            std::vector<Lobby::Ended> ended;
            for (Caller& caller : lobby_.takeReady(ended))
                serve(std::move(caller));
            for (const Lobby::Ended& one : ended)
                tellOf(one);
            endSilent();
        }
        endAssociations();
        desk_.finish();
        incoming_.finish();
    }

    int port() const { return listening_.port(); }
    std::shared_ptr<const ReceiverCounts> counts() const { return counts_; }

private:
    void tellOf(const Lobby::Ended& ended) const
    {
        incoming_.trouble(ended.line);
        if (ended.refused && handlers_.on_refused)
            handlers_.on_refused(ended.host, ended.line);
    }

    void waitForNews() const
    {
        std::vector<pollfd> watched{{listening_.descriptor(), POLLIN, 0}};
        lobby_.addTo(watched);
        ::poll(watched.data(), watched.size(), kLookMilliseconds);
    }

    void acceptCallers()
    {
        for (int n = 0; n < kAcceptedAtOnce; ++n)
            if (auto caller = listening_.accept())
                lobby_.enter(std::move(*caller));
            else
                return;
    }

    void serve(Caller caller)
    {
        const std::string host = caller.host;
        const bool secure = caller.tls != nullptr, crowded = !makeRoomFor(host);
        if (crowded && refusing() >= kMostRefusing) {
            ::close(caller.socket);
            ++counts_->refused_associations;
            return;
        }
        const int socket = ::dup(caller.socket);
        const auto [association, watch] = reader_.read(std::move(caller));
        if (!association || socket < 0) {
            incoming_.trouble("a connection from " + host + " made no proper association request");
            ::close(socket);
            return;
        }
        const Peer* peer = rules_.peerOf(association->params->DULparams.callingAPTitle, host);
        const bool too_many = peer && !makeRoomFor(*peer);
        Served& served = served_.emplace_back();
        served.host = host;
        served.peer = peer;
        served.socket = socket;
        served.crowded = crowded || too_many;
        Pace* const pace = peer ? &paces_.try_emplace(peer, peer->mb_per_s).first->second : nullptr;
        served.thread = std::thread([this, &served, pace, secure, association = association, watch = watch] {
            try {
                const StorageService service{options_, rules_, incoming_, desk_, pace_, handlers_, *counts_};
                StorageAssociation scp(service, {served.host, served.socket, secure, served.peer, pace, watch});
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

    bool makeRoomFor(const Peer& peer)
    {
        const auto of_peer = [&](const Served& s) { return !s.crowded && !s.ended && !s.finished && s.peer == &peer; };
        return peer.max_associations == 0 ||
               std::count_if(served_.begin(), served_.end(), of_peer) < peer.max_associations || endIdlest(of_peer);
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
    CallerRules rules_;
    const Handlers handlers_;
    const std::shared_ptr<ReceiverCounts> counts_ = std::make_shared<ReceiverCounts>();
    Pace pace_;                          ///< of all
    std::map<const Peer*, Pace> paces_;  ///< of each
    CommitmentDesk desk_;
    Incoming incoming_;
    const ListeningSocket listening_;
    const std::unique_ptr<TlsServer> tls_;
    Lobby lobby_;
    AssociationReader reader_;
    std::list<Served> served_;
};

Receiver::Receiver(const ReceiverOptions& options, const fs::path& incoming_folder, Handlers handlers,
                   const Network& network)
    : implementation_(std::make_unique<Implementation>(options, incoming_folder, std::move(handlers), network))
{
}

Receiver::Receiver(const ReceiverOptions& options, const fs::path& incoming_folder, Handlers handlers)
    : Receiver(options, incoming_folder, std::move(handlers), Network{})
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

std::shared_ptr<const ReceiverCounts> Receiver::counts() const
{
    return implementation_->counts();
}

}  // namespace vicon::ingest
