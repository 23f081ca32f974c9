#include "metrics.h"

#include <prometheus/collectable.h>
#include <prometheus/exposer.h>
#include <prometheus/metric_family.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <optional>

#include "vicon/cases/store_figures.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

ClientMetric gauge(double value)
{
    ClientMetric metric;
    metric.gauge.value = value;
    return metric;
}

ClientMetric counter(long long value)
{
    ClientMetric metric;
    metric.counter.value = double(value);
    return metric;
}

ClientMetric labelled(ClientMetric metric, const std::string& name, const std::string& value)
{
    metric.label = {{name, value}};
    return metric;
}

MetricFamily family(const std::string& name, const std::string& help, std::vector<ClientMetric> metrics,
                    MetricType type = MetricType::Gauge)
{
    MetricFamily out;
    out.name = name;
    out.help = help;
    out.type = type;
    out.metric = std::move(metrics);
    return out;
}

MetricFamily byState(const std::string& name, const std::string& help, const std::map<std::string, int>& counts)
{
    std::vector<ClientMetric> metrics;
    for (const auto& [state, count] : counts)
        metrics.push_back(labelled(gauge(count), "state", state));
    return family(name, help, std::move(metrics));
}

std::vector<MetricFamily> familiesOf(const StoreFigures& figures)
{
    std::vector<ClientMetric> steps;
    for (const auto& [name, step] : figures.steps) {
        ClientMetric metric;
        metric.summary.sample_count = std::uint64_t(step.count);
        metric.summary.sample_sum = step.seconds;
        steps.push_back(labelled(metric, "step", name));
    }
    return {
        family("vicon_up", "1 when the store could be read.", {gauge(1)}),
        byState("vicon_jobs", "Scans in the queue's table, by state.", figures.jobs),
        family("vicon_queue_wait_seconds", "How long the job at the head of the queue has been due.",
               {gauge(figures.oldest_wait_s)}),
        byState("vicon_outbox_objects", "Objects for peers, by state.", figures.outbox),
        family("vicon_cases", "Cases in the store.", {gauge(double(figures.cases))}),
        family("vicon_scans", "Scans in the store.", {gauge(double(figures.scans))}),
        family("vicon_instances", "DICOM instances in the store.", {gauge(double(figures.instances))}),
        family("vicon_quarantine_objects", "Objects in quarantine, for a person to look at.",
               {gauge(double(figures.quarantined))}),
        family("vicon_store_free_bytes", "Free space on the store's disk.", {gauge(figures.free_bytes)}),
        family("vicon_step_seconds", "Time that steps took, over all scans on which they are done.", std::move(steps),
               MetricType::Summary),
    };
}

/// Asked on a thread of the server's. A store that cannot be read is said in the figures and tried again.
class StoreCollectable : public prometheus::Collectable {
public:
    explicit StoreCollectable(StorePlace place) : place_(std::move(place)) {}

    std::vector<MetricFamily> Collect() const override
    {
        const std::lock_guard lock(mutex_);
        try {
            if (!place_.holdsStore())  // its open database would go on to answer
                throw Error(ErrorCode::store, "the store is gone", place_.folder.string(),
                            "see whether its disk is mounted");
            if (!store_)
                store_.emplace(place_);
            return familiesOf(figuresOf(*store_));
        } catch (const std::exception& e) {
            store_.reset();
            spdlog::warn("no figures for Prometheus: {}", e.what());
            return {family("vicon_up", "1 when the store could be read.", {gauge(0)})};
        }
    }

private:
    StorePlace place_;
    mutable std::mutex mutex_;
    mutable std::optional<CaseStore> store_;
};

class ReceiverCollectable : public prometheus::Collectable {
public:
    explicit ReceiverCollectable(std::shared_ptr<const ingest::ReceiverCounts> counts) : counts_(std::move(counts)) {}

    std::vector<MetricFamily> Collect() const override
    {
        const auto served = [](const std::string& name, const std::string& help, long long yes, long long no) {
            return family(name, help,
                          {labelled(counter(yes), "answer", "accepted"), labelled(counter(no), "answer", "refused")},
                          MetricType::Counter);
        };
        return {
            served("vicon_received_associations_total", "Associations that peers asked for.", counts_->associations,
                   counts_->refused_associations),
            served("vicon_received_objects_total", "Objects that peers sent.", counts_->objects,
                   counts_->refused_objects),
            family("vicon_received_last_object_timestamp_seconds", "When the last object was accepted; 0: none was.",
                   {gauge(counts_->last_object_s)}),
        };
    }

private:
    std::shared_ptr<const ingest::ReceiverCounts> counts_;
};

}  // namespace

struct MetricsServer::Parts {
    std::shared_ptr<prometheus::Collectable> figures, received;
    prometheus::Exposer exposer;  // ends first

    Parts(const StorePlace& place, const std::string& address)
        : figures(std::make_shared<StoreCollectable>(place)), exposer(address, 1)
    {
        exposer.RegisterCollectable(figures);
    }
};

MetricsServer::MetricsServer(const StorePlace& place, const Config& config)
{
    const auto options = config.get<MetricsOptions>();
    if (options.port == 0)
        return;
    const std::string address = options.address + ":" + std::to_string(options.port);
    try {
        parts_ = std::make_unique<Parts>(place, address);
    } catch (const std::exception&) {
        throw Error(ErrorCode::wrong_use,
                    "figures cannot be given there: the address is not this machine's, or the "
                    "port is taken",
                    address, "set metrics.port and metrics.address");
    }
}

MetricsServer::~MetricsServer() = default;

void MetricsServer::add(std::shared_ptr<const ingest::ReceiverCounts> counts)
{
    if (!parts_)
        return;
    parts_->received = std::make_shared<ReceiverCollectable>(std::move(counts));
    parts_->exposer.RegisterCollectable(parts_->received);
}

}  // namespace vicon::app
