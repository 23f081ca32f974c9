#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"

namespace vicon {

/// The procedure that a case was made for, as a department's system told it. Texts are UTF-8, empty where it said
/// nothing.
struct Order {
    std::string peer;  ///< who told it, as the configuration calls it
    std::string accession_number;
    std::string referring_physician;  ///< "Family^Given"
    std::string procedure_id, procedure, reason;
    std::string taken;  ///< when; set by keepOrder()
};
void to_json(nlohmann::json& json, const Order& from);
void from_json(const nlohmann::json& json, Order& to);

std::optional<Order> orderOf(CaseStore& store, const std::string& case_id);

/// Keeps the order of a case, and what the case has of it from now on, in one transaction; then rewrites its scan.json.
/// An order that was kept before is replaced. Whoever calls holds the StoreLock.
/// @param with the case with its study as it shall be; its flags stay as they are
/// @param require runs first, within the transaction: when it throws, nothing is written
/// @throws Error{database}, Error{store}
void keepOrder(CaseStore& store, const CaseRecord& with, Order order, const std::function<void()>& require);

/// Cases without an order whose study is of this date or later, of those that came after this moment.
/// @param study_date YYYYMMDD
/// @param created as CaseRecord::created
std::vector<CaseRecord> casesWithoutOrder(CaseStore& store, const std::string& study_date, const std::string& created);

}  // namespace vicon
