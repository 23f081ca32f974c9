#include "operation_audit.h"

#include <spdlog/spdlog.h>

#include "vicon/core/error.h"

namespace vicon::app {

void auditOperation(const StorePlace& place, AuditEvent event, const std::string& detail)
try {
    if (place.holdsStore())
        CaseStore(place).audit(event, "", "", detail);
} catch (const Error& e) {
    spdlog::error("'{}' is not in the audit trail: {}", nameOf(event), e.what());
}

void auditRefusedAccount(const StorePlace& place, const std::string& what)
try {
    if (place.holdsStore())
        CaseStore(place).audit(AuditEvent::account_refused, "", "", what);
} catch (const Error&) {  // the refusal itself is what is told
}

AuditedRun::AuditedRun(StorePlace place, std::string program) : place_(std::move(place)), program_(std::move(program))
{
    auditOperation(place_, AuditEvent::application_started, program_);
}

AuditedRun::~AuditedRun()
{
    auditOperation(place_, AuditEvent::application_stopped, program_);
}

RefusedCallers::RefusedCallers(StorePlace place, Clock clock) : place_(std::move(place)), clock_(std::move(clock)) {}

void RefusedCallers::note(const std::string& host, const std::string& line)
{
    constexpr auto kPause = std::chrono::minutes(1);
    constexpr std::size_t kMostHosts = 1000;
    const auto now = clock_();
    const std::lock_guard lock(mutex_);
    if (hosts_.size() >= kMostHosts)
        std::erase_if(hosts_, [&](const auto& one) { return now - one.second.told >= kPause; });
    const auto known = hosts_.find(host);
    if (known != hosts_.end() && now - known->second.told < kPause) {
        ++known->second.untold;
        return;
    }
    if (known == hosts_.end() && hosts_.size() >= kMostHosts)
        return;
    Host& told = hosts_[host];
    const std::string more = told.untold == 0 ? "" : "; before, " + std::to_string(told.untold) + " more of this host";
    told = {now, 0};
    auditOperation(place_, AuditEvent::caller_refused, line + more);
}

}  // namespace vicon::app
