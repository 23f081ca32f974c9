#include "vicon/cases/orders.h"

#include <soci/soci.h>

#include <utility>

#include "case_rows.h"
#include "search_words.h"
#include "vicon/core/file.h"

using nlohmann::json;

namespace vicon {
namespace {

constexpr std::pair<const char*, std::string Order::*> kOrderTexts[] = {
    {"peer", &Order::peer},
    {"accession_number", &Order::accession_number},
    {"referring_physician", &Order::referring_physician},
    {"procedure_id", &Order::procedure_id},
    {"procedure", &Order::procedure},
    {"reason", &Order::reason},
    {"taken", &Order::taken},
};

}  // namespace

void to_json(json& out, const Order& from)
{
    out = json::object();
    for (const auto& [name, member] : kOrderTexts)
        out[name] = from.*member;
}

void from_json(const json& in, Order& to)
{
    for (const auto& [name, member] : kOrderTexts)
        to.*member = in.value(name, "");
}

std::optional<Order> orderOf(CaseStore& store, const std::string& case_id)
{
    std::string content;
    const bool found = store.database().read([&](soci::session& sql) {
        sql << "SELECT content FROM orders WHERE case_id = :c", soci::use(case_id), soci::into(content);
        return sql.got_data();
    });
    return found ? std::optional(json::parse(content).get<Order>()) : std::nullopt;
}

void keepOrder(CaseStore& store, const CaseRecord& with, Order order, const std::function<void()>& require)
{
    order.taken = nowUtc();
    const std::string content = json(order).dump(), study = json(with.study).dump();
    const std::string before = json(store.requireCase(with.id).study).dump();
    store.database().write([&](soci::session& sql) {
        require();
        sql << "INSERT INTO orders (case_id, content) VALUES (:c, :content)"
               " ON CONFLICT (case_id) DO UPDATE SET content = excluded.content",
            soci::use(with.id), soci::use(content);
        sql << "UPDATE cases SET study = :study WHERE id = :c", soci::use(study), soci::use(with.id);
        putSearchWords(sql, with);
        putAudit(sql, {AuditEvent::order_taken, with.id, "", order.peer, before, study});
    });
    for (const ScanRecord& scan : store.scans(with.id))
        store.writeScanFile(with.id, scan.id);
}

std::vector<CaseRecord> casesWithoutOrder(CaseStore& store, const std::string& study_date, const std::string& created)
{
    auto cases = store.database().read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM cases WHERE created >= :at AND NOT EXISTS"
                            " (SELECT 1 FROM orders WHERE case_id = cases.id) ORDER BY created, id",
             soci::use(created));
        return collect(rows, caseFrom);
    });
    std::erase_if(cases, [&](const CaseRecord& c) { return c.study.date < study_date; });
    return cases;
}

}  // namespace vicon
