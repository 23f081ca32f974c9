#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vicon::ingest {

/// The IPv4 addresses of hosts, as digits. Names are looked up again and again, on a thread of its own, one at a time:
/// a name server that is off today or a host that moves needs no restart, and who asks here never waits. What was known
/// counts until another answer comes.
class HostAddresses {
public:
    using Lookup = std::function<std::vector<std::string>(const std::string& host)>;
    /// How often hosts are looked up that have no address, and those that have one.
    struct Intervals {
        std::chrono::milliseconds unknown = std::chrono::seconds(5), known = std::chrono::minutes(1);
    };
    /// Waits for the first answers, but not for a name server that gives none.
    HostAddresses(const std::vector<std::string>& hosts, Lookup lookup, Intervals intervals);
    ~HostAddresses();
    HostAddresses(const HostAddresses&) = delete;
    HostAddresses& operator=(const HostAddresses&) = delete;

    bool has(const std::string& host, const std::string& address) const;
    /// Whether it has any address.
    bool isKnown(const std::string& host) const;

private:
    struct Book;
    std::shared_ptr<Book> book_;  ///< a thread that a name server keeps waiting may outlive this object
};

}  // namespace vicon::ingest
