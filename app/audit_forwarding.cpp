#include "audit_forwarding.h"

#include <netdb.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "atna_message.h"
#include "command.h"
#include "vicon/cases/store_presence.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

/// Where syslog listens: a datagram socket, local or UDP.
class Syslog {
public:
    explicit Syslog(const std::string& place) : place_(place)
    {
        if (place.starts_with('/'))
            connectLocally();
        else
            connectByNetwork();
        if (descriptor_ < 0)
            throw trouble();
    }
    ~Syslog() { ::close(descriptor_); }
    Syslog(const Syslog&) = delete;
    Syslog& operator=(const Syslog&) = delete;

    void send(const std::string& packet) const
    {
        if (::send(descriptor_, packet.data(), packet.size(), MSG_NOSIGNAL) != ssize_t(packet.size()))
            throw trouble();
    }

private:
    Error trouble() const
    {
        return {ErrorCode::peer, std::string("the audit trail cannot be sent to syslog (") + std::strerror(errno) + ")",
                place_, "check audit.syslog, and that syslog listens there"};
    }

    void connectLocally()
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        if (place_.size() >= sizeof address.sun_path) {
            errno = ENAMETOOLONG;
            return;
        }
        std::memcpy(address.sun_path, place_.c_str(), place_.size() + 1);
        tryToConnect(AF_UNIX, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    }

    void connectByNetwork()
    {
        const auto colon = place_.rfind(':');
        addrinfo hints{}, *found = nullptr;
        hints.ai_socktype = SOCK_DGRAM;
        errno = EDESTADDRREQ;
        if (colon == std::string::npos ||
            ::getaddrinfo(place_.substr(0, colon).c_str(), place_.substr(colon + 1).c_str(), &hints, &found) != 0)
            return;
        for (const addrinfo* one = found; one && descriptor_ < 0; one = one->ai_next)
            tryToConnect(one->ai_family, one->ai_addr, one->ai_addrlen);
        ::freeaddrinfo(found);
    }

    void tryToConnect(int family, const sockaddr* address, socklen_t length)
    {
        constexpr timeval kPatience{.tv_sec = 2, .tv_usec = 0};  // with a syslog that does not read
        descriptor_ = ::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
        ::setsockopt(descriptor_, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
        if (descriptor_ < 0 || ::connect(descriptor_, address, length) == 0)
            return;
        const int number = errno;
        ::close(descriptor_);
        descriptor_ = -1;
        errno = number;
    }

    std::string place_;
    int descriptor_ = -1;
};

std::string thisMachine()
{
    char name[256] = {};
    ::gethostname(name, sizeof name - 1);
    return name;
}

}  // namespace

void requireSyslog(const AuditOptions& options)
{
    if (!options.syslog.empty())
        const Syslog tried(options.syslog);
}

int forwardAudit(CaseStore& store, const AuditOptions& options)
{
    constexpr int kAtOnce = 100;  // lines: what is noted once
    int sent = 0;
    for (;;) {
        const auto lines = auditAfter(store, lastToldAudit(store), kAtOnce);
        if (lines.empty())
            return sent;
        const Syslog syslog(options.syslog);
        const std::string machine = thisMachine();
        long long last_sent = 0;
        try {
            for (const NumberedAuditLine& line : lines) {
                syslog.send(
                    syslogPacket(atnaMessage(line, subjectOf(store, line.case_id), machine), line.line.at, machine));
                last_sent = line.number;
                ++sent;
            }
        } catch (const Error&) {  // a syslog that reads slowly took some: they are not sent again
            if (last_sent > 0)
                noteToldAudit(store, last_sent);
            throw;
        }
        noteToldAudit(store, last_sent);
    }
}

void forwardAuditInBackground(const StorePlace& place, const AuditOptions& options)
{
    constexpr auto kLook = std::chrono::milliseconds(500);
    std::string said;
    while (!options.syslog.empty() && !stopRequested()) {
        try {
            CaseStore store = openAgain(place);
            while (!stopRequested()) {
                requireThere(place);
                forwardAudit(store, options);
                said.clear();
                std::this_thread::sleep_for(kLook);
            }
        } catch (const std::exception& e) {
            if (e.what() != said)
                spdlog::error("{}", said = e.what());
            std::this_thread::sleep_for(kLook);
        }
    }
}

}  // namespace vicon::app
