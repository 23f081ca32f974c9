#pragma once

#include <memory>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {

struct MetricsOptions {
    int port = 0;
    std::string address = "127.0.0.1";

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("metrics.port", port, "", "Port on which 'receive' gives figures to Prometheus; 0: none.", {0, 65535});
        v("metrics.address", address, "", "Address of that port; whoever reaches it can read the figures.");
    }
};

/// Answers GET /metrics for as long as it lives, from a store connection of its own; nothing is listened on when the
/// port is 0. No figure tells of a patient.
class MetricsServer {
public:
    /// Throws Error{wrong_use} when the port cannot be had.
    MetricsServer(const StorePlace& place, const Config& config);
    ~MetricsServer();
    MetricsServer(const MetricsServer&) = delete;
    MetricsServer& operator=(const MetricsServer&) = delete;

    /// Gives what a receiver has done as well.
    void add(std::shared_ptr<const ingest::ReceiverCounts> counts);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace vicon::app
