#pragma once

#include <soci/soci.h>

#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/outbox.h"

namespace vicon {

// How the outbox lies in the database; the writing ones run within a transaction of the caller.

OutboxItem outboxItemFrom(const soci::row& row);
void addOutboxItem(soci::session& sql, const OutboxItem& item);
/// Everything that can change of it; frees its lease unless it is being sent.
void updateOutboxItem(soci::session& sql, const OutboxItem& item);
std::optional<OutboxItem> findOutboxItem(soci::session& sql, const std::string& peer, const std::string& sop_uid);
std::optional<OutboxItem> findOutboxItem(soci::session& sql, int id);

}  // namespace vicon
