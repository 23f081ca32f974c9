#include <charconv>
#include <cstdio>
#include <utility>

#include "../command.h"
#include "../text_table.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct OutboxArguments {
    std::string case_id;
    std::vector<std::string> retry, drop;
    bool retry_refused = false;

    bool changes() const { return retry_refused || !retry.empty() || !drop.empty(); }
};

int idFrom(const std::string& text)
{
    int id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (error != std::errc() || end != text.data() + text.size() || id < 1)
        throw Error(ErrorCode::wrong_use, "not the number of an item", text, "'vicon outbox' lists them");
    return id;
}

void print(const std::vector<OutboxItem>& items)
{
    if (items.empty()) {
        std::printf("the outbox is empty; 'vicon send CASE PEER' puts something in\n");
        return;
    }
    std::vector<std::vector<std::string>> rows;
    for (const OutboxItem& item : items)
        rows.push_back({std::to_string(item.id), item.case_id, item.peer, nameOf(item.state),
                        std::to_string(item.attempts), item.object.file.filename().string(), item.reason});
    std::printf("%s", formatTable({"ITEM", "CASE", "PEER", "STATE", "TRIES", "FILE", ""}, rows).c_str());
}

int outbox(Context& context, const OutboxArguments& a)
{
    CaseStore& store = context.existingStore();
    const IdPart enough = a.changes() ? IdPart::whole : IdPart::beginning;
    const std::string case_id = a.case_id.empty() ? "" : requireCase(store, a.case_id, enough).id;
    Outbox box(store.database(), context.config().get<OutboxOptions>());
    std::vector<int> retry, drop;  // all are looked at before any is touched
    for (const auto& [texts, ids] : {std::pair(&a.retry, &retry), std::pair(&a.drop, &drop)})
        for (const std::string& text : *texts)
            ids->push_back(idFrom(text));
    for (const int id : retry)
        box.retry(id);
    if (a.retry_refused)
        for (const OutboxItem& item : box.items(case_id))
            if (item.state == DeliveryState::refused)
                box.retry(item.id);
    for (const int id : drop)
        box.drop(id);
    const std::vector<OutboxItem> items = box.items(case_id);
    if (context.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const OutboxItem& item : items)
            list.push_back(toJson(item));
        std::printf("%s\n", nlohmann::json{{"items", list}}.dump(2).c_str());
    } else {
        print(items);
    }
    return 0;
}

}  // namespace

Subcommand outboxCommand()
{
    return {
        "outbox", "List what was sent to PACS and how far each object is", [](CommandLine& command) {
            auto a = std::make_shared<OutboxArguments>();
            command.option("CASE", a->case_id, "Only this case's");
            command.option("--retry", a->retry, "Send this item again, now").typeName("ITEM").oneValueEach();
            command.flag("--retry-refused", a->retry_refused, "Send again, now, all that a peer refused");
            command.option("--drop", a->drop, "Take this item out, whatever its state").typeName("ITEM").oneValueEach();
            return [a](Context& context) { return outbox(context, *a); };
        }};
}

}  // namespace vicon::app
