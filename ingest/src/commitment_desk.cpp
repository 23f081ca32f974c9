#include "commitment_desk.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr auto kLook = std::chrono::milliseconds(100);
constexpr std::size_t kMostWaiting = 10000;  // requests; each is a file of some kilobytes
constexpr double kFirstBackoff_s = 2, kLongestBackoff_s = 600;
constexpr int kMostDoublings = 20;

struct Demand {
    std::string title, host;
    CommitmentDemand what;
};

nlohmann::json toJson(const Demand& demand)
{
    nlohmann::json objects = nlohmann::json::array();
    for (const ObjectName& object : demand.what.objects)
        objects.push_back({object.sop_class, object.sop_uid});
    return {{"title", demand.title},
            {"host", demand.host},
            {"transaction_uid", demand.what.transaction_uid},
            {"objects", objects}};
}

Demand demandIn(const fs::path& file)
{
    const auto json = nlohmann::json::parse(readFile(file));
    Demand demand{json.at("title"), json.at("host"), {json.at("transaction_uid"), {}}};
    for (const auto& object : json.at("objects"))
        demand.what.objects.push_back({object.at(0), object.at(1)});
    return demand;
}

}  // namespace

CommitmentDesk::CommitmentDesk(fs::path folder, const ReceiverOptions& options, const Receiver::Handlers& handlers,
                               const CallerRules& rules)
    : folder_(std::move(folder)), options_(options), handlers_(handlers), rules_(rules)
{
    if (!fs::exists(folder_))
        return;
    removeTemporaries(folder_);
    for (const auto& entry : fs::directory_iterator(folder_))
        if (entry.path().extension() == ".json")
            waiting_[entry.path().stem().string()] = {};
}

CommitmentDesk::~CommitmentDesk()
{
    finish();
}

void CommitmentDesk::start()
{
    if (isOpen())
        thread_ = std::thread([this] { work(); });
}

void CommitmentDesk::finish()
{
    {
        const std::lock_guard lock(mutex_);
        finishing_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

fs::path CommitmentDesk::fileOf(const std::string& number) const
{
    return folder_ / (number + ".json");
}

std::string CommitmentDesk::take(const std::string& title, const std::string& host, const CommitmentDemand& demand)
{
    constexpr std::size_t kDigits = 32;
    std::string number = sha256(title + '\n' + host + '\n' + demand.transaction_uid).substr(0, kDigits);
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() >= kMostWaiting && !waiting_.contains(number))
            throw Error(ErrorCode::no_memory, "too many requests for commitment wait to be reported");
        waiting_[number].held = true;
    }
    try {
        makePrivateFolder(folder_);
        // A title may hold any byte.
        constexpr int kOneLine = -1;
        replaceFile(fileOf(number),
                    toJson({title, host, demand}).dump(kOneLine, ' ', false, nlohmann::json::error_handler_t::replace));
    } catch (...) {
        close(number);
        throw;
    }
    return number;
}

void CommitmentDesk::close(const std::string& number)
{
    const std::lock_guard lock(mutex_);
    waiting_.erase(number);
    std::error_code gone;
    fs::remove(fileOf(number), gone);
}

void CommitmentDesk::putBack(const std::string& number)
{
    const std::lock_guard lock(mutex_);
    waiting_[number].held = false;
    changed_.notify_all();
}

std::string CommitmentDesk::nextDue() const
{
    const auto now = std::chrono::steady_clock::now();
    for (const auto& [number, waiting] : waiting_)
        if (!waiting.held && waiting.not_before <= now)
            return number;
    return {};
}

void CommitmentDesk::work()
{
    std::unique_lock lock(mutex_);
    while (!finishing_) {
        const std::string number = nextDue();
        if (number.empty()) {
            changed_.wait_for(lock, kLook);
            continue;
        }
        waiting_[number].held = true;
        lock.unlock();
        report(number);
        lock.lock();
    }
}

/// Once more and later each time, until the peer has taken it, or nobody wants to know any more.
void CommitmentDesk::report(const std::string& number)
{
    std::string why;
    std::string whom = "a peer";
    try {
        const Demand demand = demandIn(fileOf(number));
        whom = "'" + demand.title + "' at " + demand.host;
        const Peer* peer = rules_.peerOf(demand.title, demand.host);
        if (!peer)
            throw Error(ErrorCode::peer, "no peer of this title and host is configured", {}, "add it to [peers]");
        reportCommitment(*peer, answer(demand.what), options_.ae_title);
        close(number);
        return;
    } catch (const std::exception& e) {
        why = e.what();
    }
    std::error_code unknown;
    const auto asked = fs::last_write_time(fileOf(number), unknown);
    const bool too_old =
        !unknown && fs::file_time_type::clock::now() - asked > std::chrono::hours(24 * options_.report_days);
    if (handlers_.on_trouble)
        handlers_.on_trouble("a commitment was not reported to " + whom + (too_old ? " and never will be: " : ": ") +
                             why);
    if (too_old) {
        close(number);
        return;
    }
    const std::lock_guard lock(mutex_);
    Waiting& waiting = waiting_[number];
    waiting.held = false;
    const double wait_s =
        std::min(kLongestBackoff_s, kFirstBackoff_s * std::pow(2, std::min(waiting.failures++, kMostDoublings)));
    waiting.not_before =
        std::chrono::steady_clock::now() +
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(wait_s));
}

}  // namespace vicon::ingest
