#include "named_options.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "audit_forwarding.h"
#include "metrics.h"
#include "peers.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/error.h"
#include "vicon/ingest/orders.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/tls.h"
#include "vicon/picture/png_file.h"
#include "vicon/report/options.h"
#include "vicon/report/report_objects.h"

namespace vicon::app {
namespace {

/// Throws Error{wrong_use} where nothing can be listened on there.
void requireOwnAddress(std::string address)
{
    if (address.starts_with('[') && address.ends_with(']'))  // as IPv6 stands beside a port
        address = address.substr(1, address.size() - 2);
    addrinfo hints{}, *found = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    const int unknown = ::getaddrinfo(address.c_str(), "0", &hints, &found);  // port 0: any free one
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> held(found, ::freeaddrinfo);
    int number = EADDRNOTAVAIL;
    for (const addrinfo* one = found; unknown == 0 && one && number != 0; one = one->ai_next) {
        const int descriptor = ::socket(one->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
        number = descriptor >= 0 && ::bind(descriptor, one->ai_addr, one->ai_addrlen) == 0 ? 0 : errno;
        if (descriptor >= 0)
            ::close(descriptor);
    }
    if (number != 0)
        throw Error(ErrorCode::wrong_use,
                    std::string("this machine has no such address (") + std::strerror(number) + ")", address,
                    "give one of its own");
}

void requirePeers(const Config& config)
{
    for (const std::string& peer : config.get<SigningOptions>().send_to)
        requirePeer(config, peer, PeerUse::send);
}

void requireObjectKinds(const Config& config)
{
    for (const std::string& name : config.get<SigningOptions>().objects)
        report::objectKindNamed(name);
}

void requireTlsFiles(const Config& config)
{
    const auto tls = config.get<ingest::TlsOptions>();
    if (config.get<ingest::ReceiverOptions>().tls == ingest::TlsUse::off && tls == ingest::TlsOptions())
        return;
    ingest::certificateTerms(tls);
    if (!std::ifstream(tls.key))
        throw Error(ErrorCode::wrong_use, "the certificate's key cannot be read", "'" + tls.key + "'", "see tls.key");
}

}  // namespace

const std::vector<NamedOption>& namedOptions()
{
    static const std::vector<NamedOption> kOptions = {
        {"report.send_to", requirePeers},
        {"report.objects", requireObjectKinds},
        {"report.logo",
         [](const Config& config) {
             if (const std::string logo = config.get<report::ReportOptions>().logo; !logo.empty())
                 picture::readPng(logo);
         }},
        {"orders.peer",
         [](const Config& config) {
             if (const std::string peer = config.get<ingest::OrderOptions>().peer; !peer.empty())
                 requirePeer(config, peer, PeerUse::query);
         }},
        {"receive.count_at",
         [](const Config& config) {
             if (const std::string peer = config.get<ingest::ReceiverOptions>().count_at; !peer.empty())
                 requirePeer(config, peer, PeerUse::query);
         }},
        {"receive.address",
         [](const Config& config) { requireOwnAddress(config.get<ingest::ReceiverOptions>().address); }},
        {"receive.tls", requireTlsFiles},
        {"metrics.address", [](const Config& config) { requireOwnAddress(config.get<MetricsOptions>().address); }},
        {"audit.syslog", [](const Config& config) { requireSyslog(config.get<AuditOptions>()); }},
    };
    return kOptions;
}

void requireDeliverable(const Config& config)
{
    requirePeers(config);
    requireObjectKinds(config);
}

}  // namespace vicon::app
