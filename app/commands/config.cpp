#include <cstdio>

#include "../audit_forwarding.h"
#include "../command.h"
#include "../log_lines.h"
#include "../metrics.h"
#include "../text_table.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/placing.h"
#include "vicon/cases/prior_match.h"
#include "vicon/cases/purge.h"
#include "vicon/cases/report_texts.h"
#include "vicon/cases/report_versions.h"
#include "vicon/cases/roles.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/orders.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/tls.h"
#include "vicon/ingest/watch.h"
#include "vicon/pipeline/scan_work.h"
#include "vicon/pipeline/worker.h"
#include "vicon/report/options.h"

namespace vicon::app {
namespace {

nlohmann::json describe(const OptionSpec& spec, const Config::Value& now)
{
    nlohmann::json out = {{"value", now.value},
                          {"source", now.source},
                          {"default", spec.default_value},
                          {"unit", spec.unit},
                          {"help", spec.help}};
    const OptionLimits none;
    if (spec.lowest > none.lowest)
        out["lowest"] = spec.lowest;
    if (spec.highest < none.highest)
        out["highest"] = spec.highest;
    if (!spec.choices.empty())
        out["choices"] = spec.choices;
    return out;
}

int printConfig(Context& context)
{
    const Config& config = context.config();
    if (context.json) {
        nlohmann::json out = nlohmann::json::object();
        for (const OptionSpec& spec : config.specs())
            out[spec.key] = describe(spec, config.at(spec.key));
        out["peers"] = config.peers();
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    std::vector<std::vector<std::string>> rows;
    for (const OptionSpec& spec : config.specs())
        rows.push_back({spec.key, config.at(spec.key).value.dump(), spec.unit, config.at(spec.key).source, spec.help});
    std::printf("%s", formatTable({"OPTION", "VALUE", "UNIT", "FROM", "MEANING"}, rows).c_str());
    for (const auto& [name, peer] : config.peers().items())
        std::printf("peer %s: %s\n", name.c_str(), peer.dump().c_str());
    return 0;
}

}  // namespace

Config declaredConfig()
{
    Config config;
    config.declare(specsOf<StoreOptions>());
    config.declare(specsOf<ingest::ImportOptions>());
    config.declare(specsOf<ingest::ReceiverOptions>());
    config.declare(specsOf<ingest::TlsOptions>());
    config.declare(specsOf<ingest::WatchOptions>());
    config.declare(specsOf<ingest::OrderOptions>());
    config.declare(pipeline::stepOptionSpecs());
    config.declare(specsOf<QueueOptions>());
    config.declare(specsOf<pipeline::WorkOptions>());
    config.declare(specsOf<MarkOptions>());
    config.declare(specsOf<report::ReportOptions>());
    config.declare(specsOf<SigningOptions>());
    config.declare(specsOf<ReportTexts>());
    config.declare(specsOf<PriorOptions>());
    config.declare(specsOf<OutboxOptions>());
    config.declare(specsOf<PurgeOptions>());
    config.declare(specsOf<RoleOptions>());
    config.declare(specsOf<AuditOptions>());
    config.declare(specsOf<MetricsOptions>());
    config.declare(specsOf<LogOptions>());
    return config;
}

Subcommand configCommand()
{
    return {"config", "Print the effective configuration, and where each value comes from",
            [](CommandLine&) { return [](Context& context) { return printConfig(context); }; }};
}

}  // namespace vicon::app
