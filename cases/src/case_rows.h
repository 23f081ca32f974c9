#pragma once

#include <soci/soci.h>

#include <string>
#include <vector>

#include "vicon/cases/audit_event.h"
#include "vicon/cases/records.h"

namespace vicon {

/// How the store's records lie in the tables of its database. The writing ones run within a transaction of the caller.
CaseRecord caseFrom(const soci::row& row);
ScanRecord scanFrom(const soci::row& row);
InstanceRecord instanceFrom(const soci::row& row);
StepRecord stepFrom(const soci::row& row);

/// Reads all rows of a query into records.
template <class Record, class Statement>
std::vector<Record> collect(Statement&& rows, Record (*from)(const soci::row&))
{
    std::vector<Record> records;
    for (const soci::row& row : rows)
        records.push_back(from(row));
    return records;
}

/// Their ids as SQL's list: "('c1', 'c2')". Ids are VICON's own.
std::string inList(const std::vector<CaseRecord>& cases);

/// A case that is there stays as it is.
void putCase(soci::session& sql, const CaseRecord& c);
/// Adds a flag to those that the case has at this moment. Returns whether it did: the same line is kept once.
bool putFlag(soci::session& sql, const std::string& case_id, const std::string& line);
void putScan(soci::session& sql, const ScanRecord& s);
void putInstances(soci::session& sql, const std::vector<InstanceRecord>& instances);
/// A line of the audit trail, by who works here, now.
void putAudit(soci::session& sql, AuditEvent event, const std::string& case_id, const std::string& scan_id,
              const std::string& detail);
/// What was there before a change of `subject`, and what is after it: JSON; empty: nothing was, or is, there.
struct AuditedChange {
    AuditEvent event;
    std::string case_id, scan_id, subject, before, after;
};
void putAudit(soci::session& sql, const AuditedChange& change);
/// Next value of a counter, starting with 1.
int takeNumber(soci::session& sql, const std::string& name);

}  // namespace vicon
