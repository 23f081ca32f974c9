#include "vicon/cases/audit_event.h"

#include <gtest/gtest.h>

namespace vicon {
namespace {

/// What stores hold and syslog was told cannot be called otherwise later.
TEST(AuditEvent, KeepsTheNamesThatTrailsHold)
{
    const std::vector<std::string> names = {
        "imported",
        "scan removed",
        "scan read",
        "case opened",
        "case deleted",
        "case written without names",
        "quarantined",
        "flagged",
        "flag settled",
        "order taken",
        "organ",
        "corrections",
        "lumen given",
        "lumen taken back",
        "bridge confirmed",
        "bridge rejected",
        "bridge unjudged",
        "marker saved",
        "marker removed",
        "finding added",
        "finding changed",
        "finding removed",
        "assessment changed",
        "comparison confirmed",
        "comparison rejected",
        "comparison taken back",
        "picture saved",
        "report written",
        "report preliminary",
        "report signed",
        "report amended",
        "report exported",
        "report kept",
        "amendment begun",
        "amendment cancelled",
        "queued for a peer",
        "object committed",
        "object unconfirmed",
        "object refused",
        "object to be sent again",
        "object taken out of the outbox",
        "account refused",
        "application started",
        "application stopped",
        "files imported",
        "store backed up",
        "store restored",
        "peer asked",
        "caller refused",
    };
    EXPECT_EQ(auditEventNames(), names);
    for (std::size_t n = 0; n < names.size(); ++n) {
        EXPECT_EQ(nameOf(AuditEvent(n)), names[n]) << "every event has its name";
        EXPECT_EQ(auditEventFrom(names[n]), AuditEvent(n));
    }
    EXPECT_FALSE(auditEventFrom("dreamt of"));
}

}  // namespace
}  // namespace vicon
