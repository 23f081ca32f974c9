#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/cases/case_deletion.h"
#include "vicon/core/options.h"

namespace vicon {

struct PurgeOptions {
    double after_days = 0;
    double least_free_gb = 0;
    bool also_unread = false;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("purge.after_days", after_days, "days",
          "'vicon purge' deletes cases with which nothing happened for so long; 0: none for their age.", {0, 100000});
        v("purge.least_free_gb", least_free_gb, "GB",
          "'vicon purge' deletes the cases longest untouched until so much is free; 0: none for space.", {0, 1e9});
        v("purge.also_unread", also_unread, "",
          "Not only cases whose report is signed: also those of which nobody said anything.");
    }
};

/// A case that the rules would delete.
struct PurgeCandidate {
    std::string case_id;
    std::string last_event;  ///< when something happened to it last, UTC
    CaseSize size;
    std::string rule;  ///< why it would go
    std::string kept;  ///< why it stays all the same; empty: it goes
};

/// What would be deleted now, the case longest untouched first; nothing is done.
/// @param free_gb on the store's disk
std::vector<PurgeCandidate> planPurge(CaseStore& store, const PurgeOptions& options, double free_gb,
                                      const std::string& now_utc);

/// What is free on the disk of a store's folder. Throws Error{store}.
double freeGb(const std::filesystem::path& folder);

}  // namespace vicon
