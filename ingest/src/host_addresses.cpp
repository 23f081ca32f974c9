#include "host_addresses.h"

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

namespace vicon::ingest {

struct HostAddresses::Book {
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::map<std::string, std::vector<std::string>> addresses;  ///< empty: not known
    bool all_asked = false, stop = false;
};

namespace {

using BookClock = std::chrono::steady_clock;

/// @param known whether to ask for those as well that have an address
template <class Book>
void lookUpAll(Book& book, const HostAddresses::Lookup& lookup, bool known)
{
    std::vector<std::string> hosts;
    {
        const std::lock_guard lock(book.mutex);
        for (const auto& [host, addresses] : book.addresses)
            if (known || addresses.empty())
                hosts.push_back(host);
    }
    for (const std::string& host : hosts) {
        std::vector<std::string> found = lookup(host);
        const std::lock_guard lock(book.mutex);
        if (book.stop)
            return;
        if (!found.empty())
            book.addresses[host] = std::move(found);
    }
    const std::lock_guard lock(book.mutex);
    book.all_asked = true;
    book.changed.notify_all();
}

template <class Book>
void keepLookingUp(const std::shared_ptr<Book>& book, const HostAddresses::Lookup& lookup,
                   HostAddresses::Intervals intervals)
{
    auto all_asked = BookClock::now();
    lookUpAll(*book, lookup, true);
    for (;;) {
        {
            std::unique_lock lock(book->mutex);
            if (book->changed.wait_for(lock, intervals.unknown, [&] { return book->stop; }))
                return;
        }
        const bool all = BookClock::now() - all_asked >= intervals.known;
        if (all)
            all_asked = BookClock::now();
        lookUpAll(*book, lookup, all);
    }
}

}  // namespace

HostAddresses::HostAddresses(const std::vector<std::string>& hosts, Lookup lookup, Intervals intervals)
    : book_(std::make_shared<Book>())
{
    constexpr auto kFirstAnswers = std::chrono::seconds(2);
    for (const std::string& host : hosts)
        if (!host.empty())
            book_->addresses[host];
    if (book_->addresses.empty())
        return;
    std::thread(keepLookingUp<Book>, book_, std::move(lookup), intervals).detach();
    std::unique_lock lock(book_->mutex);
    book_->changed.wait_for(lock, kFirstAnswers, [&] { return book_->all_asked; });
}

HostAddresses::~HostAddresses()
{
    const std::lock_guard lock(book_->mutex);
    book_->stop = true;
    book_->changed.notify_all();
}

bool HostAddresses::has(const std::string& host, const std::string& address) const
{
    const std::lock_guard lock(book_->mutex);
    const auto found = book_->addresses.find(host);
    return found != book_->addresses.end() &&
           std::find(found->second.begin(), found->second.end(), address) != found->second.end();
}

bool HostAddresses::isKnown(const std::string& host) const
{
    const std::lock_guard lock(book_->mutex);
    const auto found = book_->addresses.find(host);
    return found != book_->addresses.end() && !found->second.empty();
}

}  // namespace vicon::ingest
