#include <cstdio>

#include "../command.h"
#include "../text_table.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/printable.h"

namespace vicon::app {
namespace {

/// The keys whose values are not the same, with both: "note: 'a' -> 'b'".
std::string changeIn(const nlohmann::json& before, const nlohmann::json& after)
{
    if (!before.is_object() || !after.is_object())
        return {};
    std::string out;
    const auto shown = [](const nlohmann::json& object, const std::string& key) {
        return object.contains(key) ? object[key].dump() : "nothing";
    };
    nlohmann::json keys = before;
    keys.update(after);
    for (const auto& [key, value] : keys.items())
        if (key != "changed" && shown(before, key) != shown(after, key))
            out += (out.empty() ? "" : "; ") + key + ": " + shown(before, key) + " -> " + shown(after, key);
    return out;
}

const char* praiseOf(const ReportVersion& version)
{
    return version.objects || !version.isSigned() ? "as it was kept"
                                                  : "as it was kept; nothing is known of its DICOM objects";
}

int audit(Context& context, const std::string& given_id)
{
    CaseStore& store = context.existingStore();
    // The trail of a case that was deleted stays.
    const std::string case_id = auditTrail(store, given_id).empty() ? store.requireCase(given_id).id : given_id;
    const std::vector<AuditLine> lines = auditTrail(store, case_id);
    const std::vector<ReportVersion> versions = reportVersions(store, case_id);
    bool intact = true;
    nlohmann::json out = {{"case", case_id}, {"versions", nlohmann::json::array()}, {"trail", nlohmann::json::array()}};
    std::vector<std::vector<std::string>> rows;
    for (const AuditLine& line : lines) {
        out["trail"].push_back(toJson(line));
        rows.push_back({line.at, line.person.empty() ? "-" : line.person, line.event, line.detail,
                        printable(changeIn(line.before, line.after))});
    }
    if (!context.json)
        std::printf("%s", formatTable({"AT", "BY", "WHAT", "OF", "CHANGE"}, rows).c_str());
    for (const ReportVersion& version : versions) {
        const std::string fault = faultOf(version);
        intact = intact && fault.empty();
        nlohmann::json entry = toJson(version);
        entry["fault"] = fault;
        out["versions"].push_back(entry);
        if (!context.json)
            std::printf("version %d, %s, %s: %s\n", version.version, nameOf(version.state).c_str(),
                        version.digest.c_str(), fault.empty() ? praiseOf(version) : fault.c_str());
    }
    if (context.json)
        std::printf("%s\n", out.dump(2).c_str());
    return intact ? 0 : 1;
}

}  // namespace

Subcommand auditCommand()
{
    return {"audit", "Who did what to a case, and whether its reports are as they were kept", [](CommandLine& command) {
                auto case_id = std::make_shared<std::string>();
                command.option("CASE", *case_id, "The case's id").required();
                return [=](Context& context) { return audit(context, *case_id); };
            }};
}

}  // namespace vicon::app
