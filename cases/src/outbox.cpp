#include "vicon/cases/outbox.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "case_rows.h"
#include "job_owner.h"
#include "job_rows.h"
#include "outbox_rows.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

/// Doubling further changes nothing: the longest wait is reached.
constexpr int kMostDoublings = 20;

double backOff(const OutboxOptions& options, int attempts)
{
    return std::min(options.longest_backoff_s,
                    options.first_backoff_s * std::pow(2, std::clamp(attempts - 1, 0, kMostDoublings)));
}

/// Of one that nothing more is done about.
AuditEvent eventOf(const OutboxItem& item)
{
    if (item.state == DeliveryState::committed)
        return AuditEvent::object_committed;
    return item.delivered() ? AuditEvent::object_unconfirmed : AuditEvent::object_refused;
}

/// A peer may answer the question of an hour ago after it was asked again: some of the last ones are kept.
std::string withEarlier(const std::string& transaction_uid, const std::string& earlier)
{
    constexpr int kEarlier = 7;
    std::string kept = transaction_uid;
    std::istringstream uids(earlier);
    std::string uid;
    for (int n = 0; n < kEarlier && uids >> uid; ++n)
        kept += " " + uid;
    return kept;
}

OutboxItem requireItem(soci::session& sql, int id)
{
    if (const auto item = findOutboxItem(sql, id))
        return *item;
    throw Error(ErrorCode::not_found, "no such item in the outbox", std::to_string(id), "'vicon outbox' lists them");
}

}  // namespace

Outbox::Outbox(Database& database, OutboxOptions options, Clock clock)
    : database_(database), options_(options), clock_(std::move(clock))
{
}

double Outbox::nowIn(soci::session& sql) const
{
    return clock_ ? clock_() : secondsIn(sql);
}

double Outbox::now()
{
    return database_.read([&](soci::session& sql) { return nowIn(sql); });
}

void Outbox::settle(soci::session& sql, const OutboxItem& item)
{
    updateOutboxItem(sql, item);
    if (item.delivered() || item.state == DeliveryState::refused)
        putAudit(sql, eventOf(item), item.case_id, "",
                 item.peer + " " + item.object.sop_uid + (item.reason.empty() ? "" : ": " + item.reason));
}

void Outbox::settleAsPostponed(soci::session& sql, OutboxItem item, const std::string& reason)
{
    item.state = item.stored ? DeliveryState::sent : DeliveryState::queued;
    ++item.attempts;
    item.reason = reason;
    item.not_before = nowIn(sql) + backOff(options_, item.attempts);
    settle(sql, item);
}

/// What dead senders held; and times that no lease and no back-off can have, from a clock that ran ahead.
void Outbox::dropLost(soci::session& sql)
{
    const double now = nowIn(sql);
    const double latest = now + std::max(options_.longest_backoff_s, options_.commitment_s);
    sql << "UPDATE outbox SET not_before = :l WHERE not_before > :limit", soci::use(latest), soci::use(latest);
    const soci::rowset<soci::row> rows = (sql.prepare << "SELECT * FROM outbox WHERE state = 'sending'");
    for (OutboxItem item : collect(rows, outboxItemFrom)) {
        if (item.lease_until > now && item.lease_until <= now + options_.lease_s && !ownerIsGone(item.owner))
            continue;
        item.state = item.stored ? DeliveryState::sent : DeliveryState::queued;
        item.reason = "the sender stopped without a word";
        item.not_before = 0;
        settle(sql, item);
    }
}

std::vector<OutboxItem> Outbox::claim(const std::string& owner, const OutboxFilter& wanted)
{
    std::vector<OutboxItem> claimed;
    database_.write([&](soci::session& sql) {
        dropLost(sql);
        const double now = nowIn(sql), lease_until = now + options_.lease_s, due_by = std::min(now, wanted.due_by);
        const soci::rowset<soci::row> due =
            (sql.prepare << "SELECT * FROM outbox WHERE state IN ('queued', 'sent') AND not_before <= :now"
                            " AND (:c = '' OR case_id = :c2) AND (:p = '' OR peer = :p2)"
                            " ORDER BY not_before, id LIMIT 1",
             soci::use(due_by), soci::use(wanted.case_id), soci::use(wanted.case_id), soci::use(wanted.peer),
             soci::use(wanted.peer));
        const auto first = collect(due, outboxItemFrom);
        if (first.empty())
            return;
        const std::string peer = first.front().peer;
        const soci::rowset<soci::row> rows =
            (sql.prepare
                 << "UPDATE outbox SET state = 'sending', owner = :o, lease_until = :l, fence = fence + 1 WHERE id IN"
                    " (SELECT id FROM outbox WHERE state IN ('queued', 'sent') AND not_before <= :now AND peer = :p"
                    " AND (:c = '' OR case_id = :c2) ORDER BY not_before, id LIMIT :most) RETURNING *",
             soci::use(owner), soci::use(lease_until), soci::use(due_by), soci::use(peer), soci::use(wanted.case_id),
             soci::use(wanted.case_id), soci::use(options_.at_once));
        claimed = collect(rows, outboxItemFrom);
    });
    std::sort(claimed.begin(), claimed.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return claimed;
}

std::optional<OutboxItem> Outbox::findClaimed(soci::session& sql, const OutboxItem& item)
{
    auto there = findOutboxItem(sql, item.id);
    if (!there || there->state != DeliveryState::sending || there->fence != item.fence)
        return std::nullopt;
    return there;
}

OutboxItem Outbox::requireClaimed(soci::session& sql, const OutboxItem& item)
{
    if (const auto claimed = findClaimed(sql, item))
        return *claimed;
    throw Error(ErrorCode::lease_lost, "another sender has this object now", item.object.sop_uid);
}

void Outbox::renew(const std::vector<OutboxItem>& items)
{
    database_.write([&](soci::session& sql) {
        const double lease_until = nowIn(sql) + options_.lease_s;
        for (const OutboxItem& item : items)
            sql << "UPDATE outbox SET lease_until = :l WHERE id = :id AND fence = :f AND state = 'sending'",
                soci::use(lease_until), soci::use(item.id), soci::use(item.fence);
    });
}

void Outbox::settleAsStored(soci::session& sql, OutboxItem item)
{
    item.stored = true;
    item.attempts = 0;
    item.reason.clear();
    settle(sql, item);
}

void Outbox::markStored(const OutboxItem& item)
{
    database_.write([&](soci::session& sql) { settleAsStored(sql, requireClaimed(sql, item)); });
}

void Outbox::markStored(const std::vector<OutboxItem>& items)
{
    database_.write([&](soci::session& sql) {
        for (const OutboxItem& item : items)
            if (const auto claimed = findClaimed(sql, item))
                settleAsStored(sql, *claimed);
    });
}

void Outbox::refuse(const OutboxItem& item, const std::string& reason)
{
    database_.write([&](soci::session& sql) {
        OutboxItem claimed = requireClaimed(sql, item);
        claimed.state = DeliveryState::refused;
        claimed.reason = reason;
        settle(sql, claimed);
    });
}

void Outbox::postpone(const OutboxItem& item, const std::string& reason)
{
    database_.write([&](soci::session& sql) { settleAsPostponed(sql, requireClaimed(sql, item), reason); });
}

void Outbox::markUnconfirmed(const OutboxItem& item, const std::string& reason)
{
    database_.write([&](soci::session& sql) {
        OutboxItem claimed = requireClaimed(sql, item);
        claimed.state = DeliveryState::unconfirmed;
        claimed.reason = reason;
        settle(sql, claimed);
    });
}

std::vector<OutboxItem> Outbox::beginCommitment(const std::vector<OutboxItem>& items,
                                                const std::string& transaction_uid)
{
    std::vector<OutboxItem> begun;
    database_.write([&](soci::session& sql) {
        for (const OutboxItem& item : items) {
            auto there = findClaimed(sql, item);
            if (!there || !there->stored)
                continue;
            there->transaction_uid = withEarlier(transaction_uid, there->transaction_uid);
            settle(sql, *there);
            begun.push_back(*there);
        }
    });
    return begun;
}

void Outbox::awaitCommitment(const std::vector<OutboxItem>& items)
{
    database_.write([&](soci::session& sql) {
        for (const OutboxItem& item : items) {
            auto there = findClaimed(sql, item);
            if (!there)
                continue;  // its answer came already
            ++there->attempts;
            there->state = DeliveryState::sent;
            there->reason = "the peer was asked to commit to it";
            there->not_before = nowIn(sql) + std::max(options_.commitment_s, backOff(options_, there->attempts));
            settle(sql, *there);
        }
    });
}

int Outbox::report(const std::string& transaction_uid, const std::vector<std::string>& committed,
                   const std::vector<Failed>& failed)
{
    int concerned = 0;
    if (transaction_uid.empty() || transaction_uid.find_first_of("%_ ") != std::string::npos)
        return concerned;
    const std::string among = "% " + transaction_uid + " %";
    database_.write([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM outbox WHERE state IN ('sending', 'sent') AND stored = 1"
                            " AND ' ' || transaction_uid || ' ' LIKE :t",
             soci::use(among));
        for (OutboxItem& item : collect(rows, outboxItemFrom)) {
            const std::string& uid = item.object.sop_uid;
            const auto failure =
                std::find_if(failed.begin(), failed.end(), [&](const Failed& f) { return f.sop_uid == uid; });
            if (failure != failed.end()) {
                item.stored = item.stored && !failure->missing;
                settleAsPostponed(sql, item, "the peer did not commit to it: " + failure->reason);
            } else if (std::find(committed.begin(), committed.end(), uid) != committed.end()) {
                item.state = DeliveryState::committed;
                item.reason.clear();
                settle(sql, item);
            } else {
                continue;
            }
            ++concerned;
        }
    });
    return concerned;
}

std::vector<OutboxItem> Outbox::items(const std::string& case_id)
{
    return database_.read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM outbox WHERE :c = '' OR case_id = :c2 ORDER BY id", soci::use(case_id),
             soci::use(case_id));
        return collect(rows, outboxItemFrom);
    });
}

std::optional<OutboxItem> Outbox::find(int id)
{
    return database_.read([&](soci::session& sql) { return findOutboxItem(sql, id); });
}

void Outbox::retry(int id)
{
    database_.write([&](soci::session& sql) {
        OutboxItem item = requireItem(sql, id);
        if (item.delivered() || item.state == DeliveryState::sending)
            return;
        if (item.state == DeliveryState::refused)
            item.stored = false;
        item.state = item.stored ? DeliveryState::sent : DeliveryState::queued;
        item.attempts = 0;
        item.not_before = 0;
        settle(sql, item);
        putAudit(sql, AuditEvent::object_queued_again, item.case_id, "", item.peer + " " + item.object.sop_uid);
    });
}

void Outbox::drop(int id)
{
    database_.write([&](soci::session& sql) {
        const OutboxItem item = requireItem(sql, id);
        sql << "DELETE FROM outbox WHERE id = :id", soci::use(id);
        putAudit(sql, AuditEvent::object_taken_out, item.case_id, "",
                 item.peer + " " + item.object.sop_uid + ", " + nameOf(item.state));
    });
}

std::optional<double> Outbox::nextDue()
{
    return database_.read([](soci::session& sql) {
        std::optional<double> due;
        for (const char* earliest : {"SELECT MIN(not_before) FROM outbox WHERE state = 'queued'",
                                     "SELECT MIN(not_before) FROM outbox WHERE state = 'sent'",
                                     "SELECT MIN(lease_until) FROM outbox WHERE state = 'sending'"}) {
            double at = 0;
            soci::indicator there = soci::i_null;
            sql << earliest, soci::into(at, there);
            if (there == soci::i_ok)
                due = std::min(due.value_or(at), at);
        }
        return due;
    });
}

}  // namespace vicon
