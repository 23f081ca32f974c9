#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/options.h"

namespace vicon {

///     queued --claim--> sending --stored--> sent --reported--> committed
///       ^                |  |  \             |
///       +---postponed----+  |   \            +-- the peer offers no commitment --> unconfirmed
///       |   or dropped      |    \           |
///       +--retry by hand-- refused           +-- the peer does not have it --> queued
enum class DeliveryState {
    queued,       ///< waits, or waits again
    sending,      ///< a sender has it
    sent,         ///< the peer took it and has not yet committed to keep it
    committed,    ///< the peer keeps it
    unconfirmed,  ///< the peer took it, and whether it keeps it as it was cannot be asked
    refused,      ///< trying again cannot help; the reason says why
};
std::string nameOf(DeliveryState state);
DeliveryState deliveryStateFrom(const std::string& name);

/// A DICOM object that lies in a case's folder.
struct OutboxObject {
    std::filesystem::path file;  ///< below the store's folder, or relative to it
    std::string sop_class, sop_uid;
};

/// One object for one peer.
struct OutboxItem {
    int id = 0;
    std::string case_id;
    std::string peer;  ///< as the configuration calls it
    OutboxObject object;
    std::string sha256;  ///< of the file when it was queued: nothing else is ever sent
    DeliveryState state = DeliveryState::queued;
    bool stored = false;  ///< the peer took it; what is missing is its commitment
    int attempts = 0;     ///< without success since it was queued, or stored
    int fence = 0;        ///< grows with every claim
    std::string owner, reason;
    std::string transaction_uid;  ///< under which it was asked for, before it the earlier ones, with spaces between
    double not_before = 0, lease_until = 0;

    /// Nothing more is done about it.
    bool delivered() const { return state == DeliveryState::committed || state == DeliveryState::unconfirmed; }
};
nlohmann::json toJson(const OutboxItem& item);
/// How many objects of a case are in which state.
std::map<DeliveryState, int> countDeliveries(CaseStore& store, const std::string& case_id);
/// "3 committed, 1 refused"; empty when there are none.
std::string deliveryInBrief(const std::map<DeliveryState, int>& counts);

struct OutboxOptions {
    double lease_s = 120;
    double first_backoff_s = 5;
    double longest_backoff_s = 600;
    double commitment_s = 60;
    int at_once = 200;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("outbox.lease_s", lease_s, "s", "A sender that is silent for this long is taken for dead.", {1, 86400});
        v("outbox.first_backoff_s", first_backoff_s, "s",
          "Wait before an object is sent again; doubled for each further time.", {0, 86400});
        v("outbox.longest_backoff_s", longest_backoff_s, "s", "Longest wait before an object is sent again.",
          {0, 86400});
        v("outbox.commitment_s", commitment_s, "s",
          "A peer that does not answer a request for commitment for so long is asked again.", {1, 86400});
        v("outbox.at_once", at_once, "", "Most objects that are sent over one association.", {1, 10000});
    }
};

/// Puts objects of a case into the outbox, within a transaction of the caller; the same object for the same peer is one
/// item. Returns the items in the order of the objects. Throws Error{store} when a file is not there, Error{bad_input}
/// when an object of that UID with other bytes is in the outbox.
std::vector<OutboxItem> queueObjects(CaseStore& store, soci::session& sql, const std::string& case_id,
                                     const std::string& peer, const std::vector<OutboxObject>& objects);
/// The same in a transaction of its own.
std::vector<OutboxItem> queueObjects(CaseStore& store, const std::string& case_id, const std::string& peer,
                                     const std::vector<OutboxObject>& objects);

/// What a sender asks for; empty: any.
struct OutboxFilter {
    std::string case_id, peer;
    double due_by = 1e300;  ///< the database's time: what was due then, and not what is due again since
};

/// The outbox's table. Every method is one transaction; any number of processes may share it.
class Outbox {
public:
    /// @param clock empty: the database's, which all senders share
    Outbox(Database& database, OutboxOptions options, Clock clock = {});

    /// Takes what is due for one peer, the longest waiting first; before, drops what dead senders held.
    std::vector<OutboxItem> claim(const std::string& owner, const OutboxFilter& wanted = {});
    /// Extends the leases of those that are still this sender's.
    void renew(const std::vector<OutboxItem>& items);

    // Outcomes. Throw Error{lease_lost} when another sender has the item, or a person changed it.
    void markStored(const OutboxItem& item);
    /// Those of them that are still this sender's; at once, as each transaction waits for the disk.
    void markStored(const std::vector<OutboxItem>& items);
    void refuse(const OutboxItem& item, const std::string& reason);
    /// Gives the item back to be tried again after a while, longer each time, as often as it takes.
    void postpone(const OutboxItem& item, const std::string& reason);
    void markUnconfirmed(const OutboxItem& item,
                         const std::string& reason = "the peer took it and offers no storage commitment");

    /// Notes under which transaction the peer will be asked to commit to these; to be called before it is asked.
    /// Returns those that are still this sender's.
    std::vector<OutboxItem> beginCommitment(const std::vector<OutboxItem>& items, const std::string& transaction_uid);
    /// The peer was asked. Those whose answer has not come meanwhile wait for it.
    void awaitCommitment(const std::vector<OutboxItem>& items);

    /// An object that a peer could not commit to.
    struct Failed {
        std::string sop_uid, reason;
        bool missing = false;  ///< the peer does not have it: it is sent again
    };
    /// What a peer reported of a transaction; it may come over any association, more than once. Returns how many items
    /// it concerned.
    int report(const std::string& transaction_uid, const std::vector<std::string>& committed,
               const std::vector<Failed>& failed);

    std::vector<OutboxItem> items(const std::string& case_id = {});
    std::optional<OutboxItem> find(int id);
    /// Makes it due now. What was refused begins anew; what is delivered stays so. Throws Error{not_found}.
    void retry(int id);
    /// Takes it out of the outbox, whatever its state. Throws Error{not_found}.
    void drop(int id);
    /// When the next item is due or the next lease lapses; nothing when none waits.
    std::optional<double> nextDue();
    double now();

private:
    double nowIn(soci::session& sql) const;
    void dropLost(soci::session& sql);
    /// As it is now; nothing where another sender has it.
    static std::optional<OutboxItem> findClaimed(soci::session& sql, const OutboxItem& item);
    static OutboxItem requireClaimed(soci::session& sql, const OutboxItem& item);
    void settleAsStored(soci::session& sql, OutboxItem item);
    void settle(soci::session& sql, const OutboxItem& item);
    void settleAsPostponed(soci::session& sql, OutboxItem item, const std::string& reason);

    Database& database_;
    OutboxOptions options_;
    Clock clock_;
};

}  // namespace vicon
