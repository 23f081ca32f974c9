#include "outbox_rows.h"

#include <map>

#include "case_rows.h"
#include "vicon/core/enum_names.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

constexpr EnumNames<DeliveryState, 6> kDeliveryNames = {{{DeliveryState::queued, "queued"},
                                                         {DeliveryState::sending, "sending"},
                                                         {DeliveryState::sent, "sent"},
                                                         {DeliveryState::committed, "committed"},
                                                         {DeliveryState::unconfirmed, "unconfirmed"},
                                                         {DeliveryState::refused, "refused"}}};

std::optional<OutboxItem> firstOf(const std::vector<OutboxItem>& found)
{
    return found.empty() ? std::nullopt : std::optional(found.front());
}

/// Below the store's folder, so that a store that was moved keeps its outbox.
fs::path relativeToStore(const CaseStore& store, const std::string& case_id, const fs::path& file)
{
    const fs::path whole = file.is_absolute() ? file : store.folder() / file;
    const fs::path inside = fs::relative(whole, store.caseFolder(case_id));
    if (inside.empty() || *inside.begin() == "..")
        throw Error(ErrorCode::bad_input, "only what lies in the case's folder can be sent", file.string());
    if (!fs::is_regular_file(whole))
        throw Error(ErrorCode::store, "the object's file is not there", file.string());
    return fs::relative(whole, store.folder());
}

}  // namespace

std::string nameOf(DeliveryState state)
{
    return nameIn(kDeliveryNames, state);
}

DeliveryState deliveryStateFrom(const std::string& name)
{
    return valueIn(kDeliveryNames, name, "a state of the outbox");
}

nlohmann::json toJson(const OutboxItem& item)
{
    return {{"id", item.id},
            {"case", item.case_id},
            {"peer", item.peer},
            {"sop_class_uid", item.object.sop_class},
            {"sop_instance_uid", item.object.sop_uid},
            {"file", item.object.file.string()},
            {"sha256", item.sha256},
            {"state", nameOf(item.state)},
            {"attempts", item.attempts},
            {"reason", item.reason}};
}

std::map<DeliveryState, int> countDeliveries(CaseStore& store, const std::string& case_id)
{
    return store.database().read([&](soci::session& sql) {
        const soci::rowset<std::string> states =
            (sql.prepare << "SELECT state FROM outbox WHERE case_id = :c", soci::use(case_id));
        std::map<DeliveryState, int> counts;
        for (const std::string& state : states)
            ++counts[valueIn(kDeliveryNames, state, "a state of the outbox")];
        return counts;
    });
}

std::string deliveryInBrief(const std::map<DeliveryState, int>& counts)
{
    std::string out;
    for (const auto& [state, count] : counts)
        out += (out.empty() ? "" : ", ") + std::to_string(count) + " " + nameOf(state);
    return out;
}

OutboxItem outboxItemFrom(const soci::row& row)
{
    OutboxItem item;
    item.id = row.get<int>("id");
    item.case_id = row.get<std::string>("case_id");
    item.peer = row.get<std::string>("peer");
    item.object = {row.get<std::string>("file"), row.get<std::string>("sop_class"), row.get<std::string>("sop_uid")};
    item.sha256 = row.get<std::string>("sha256");
    item.state = valueIn(kDeliveryNames, row.get<std::string>("state"), "a state of the outbox");
    item.stored = row.get<int>("stored") != 0;
    item.attempts = row.get<int>("attempts");
    item.fence = row.get<int>("fence");
    item.owner = row.get<std::string>("owner");
    item.transaction_uid = row.get<std::string>("transaction_uid");
    item.reason = row.get<std::string>("reason");
    item.not_before = row.get<double>("not_before");
    item.lease_until = row.get<double>("lease_until");
    return item;
}

void addOutboxItem(soci::session& sql, const OutboxItem& item)
{
    const std::string file = item.object.file.string(), now = nowUtc();
    sql << "INSERT INTO outbox (case_id, peer, sop_class, sop_uid, file, sha256, state, stored, attempts, not_before,"
           " fence, owner, lease_until, transaction_uid, reason, created, changed) VALUES (:case, :peer, :class, :uid,"
           " :file, :sha, 'queued', 0, 0, 0, 0, '', 0, '', '', :created, :changed)",
        soci::use(item.case_id), soci::use(item.peer), soci::use(item.object.sop_class), soci::use(item.object.sop_uid),
        soci::use(file), soci::use(item.sha256), soci::use(now), soci::use(now);
}

void updateOutboxItem(soci::session& sql, const OutboxItem& item)
{
    const bool held = item.state == DeliveryState::sending;
    const std::string state = nameOf(item.state), owner = held ? item.owner : "", now = nowUtc();
    const int stored = item.stored ? 1 : 0;
    const double lease_until = held ? item.lease_until : 0;
    sql << "UPDATE outbox SET state = :state, stored = :stored, attempts = :attempts, not_before = :nb, owner = :owner,"
           " lease_until = :lease, transaction_uid = :t, reason = :reason, changed = :changed WHERE id = :id",
        soci::use(state), soci::use(stored), soci::use(item.attempts), soci::use(item.not_before), soci::use(owner),
        soci::use(lease_until), soci::use(item.transaction_uid), soci::use(item.reason), soci::use(now),
        soci::use(item.id);
}

std::optional<OutboxItem> findOutboxItem(soci::session& sql, const std::string& peer, const std::string& sop_uid)
{
    const soci::rowset<soci::row> rows =
        (sql.prepare << "SELECT * FROM outbox WHERE peer = :p AND sop_uid = :u", soci::use(peer), soci::use(sop_uid));
    return firstOf(collect(rows, outboxItemFrom));
}

std::optional<OutboxItem> findOutboxItem(soci::session& sql, int id)
{
    const soci::rowset<soci::row> rows = (sql.prepare << "SELECT * FROM outbox WHERE id = :id", soci::use(id));
    return firstOf(collect(rows, outboxItemFrom));
}

std::vector<OutboxItem> queueObjects(CaseStore& store, soci::session& sql, const std::string& case_id,
                                     const std::string& peer, const std::vector<OutboxObject>& objects)
{
    std::vector<OutboxItem> items;
    for (const OutboxObject& object : objects) {
        OutboxItem item{.case_id = case_id, .peer = peer, .object = object};
        item.object.file = relativeToStore(store, case_id, object.file);
        item.sha256 = sha256OfFile(store.folder() / item.object.file);
        const auto there = findOutboxItem(sql, peer, object.sop_uid);
        if (there && there->sha256 != item.sha256)
            throw Error(ErrorCode::bad_input, "an object of that UID with other bytes is in the outbox for " + peer,
                        object.sop_uid, "'vicon outbox --drop " + std::to_string(there->id) + "' takes it out");
        if (!there) {
            addOutboxItem(sql, item);
            putAudit(sql, AuditEvent::object_queued, case_id, "", peer + " " + object.sop_uid);
        }
        items.push_back(*findOutboxItem(sql, peer, object.sop_uid));
    }
    return items;
}

std::vector<OutboxItem> queueObjects(CaseStore& store, const std::string& case_id, const std::string& peer,
                                     const std::vector<OutboxObject>& objects)
{
    std::vector<OutboxItem> items;
    store.database().write([&](soci::session& sql) { items = queueObjects(store, sql, case_id, peer, objects); });
    return items;
}

}  // namespace vicon
