#pragma once

#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"

namespace vicon::app {

struct AuditOptions {
    std::string syslog;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("audit.syslog", syslog, "",
          "Where 'vicon receive' sends the audit trail as ATNA messages: /dev/log, or HOST:PORT (UDP); empty: "
          "nowhere.");
    }
};

/// Throws Error{peer} where nothing can be sent there. Nothing is.
void requireSyslog(const AuditOptions& options);

/// Sends what the audit trail has got since the last call, and keeps how far it came. Returns how many lines. Throws
/// Error{peer} where they cannot be sent; those are sent by the next call.
int forwardAudit(CaseStore& store, const AuditOptions& options);

/// Does so, over a store connection of its own, until told to stop. Whatever goes wrong is said and tried again.
void forwardAuditInBackground(const StorePlace& place, const AuditOptions& options);

}  // namespace vicon::app
