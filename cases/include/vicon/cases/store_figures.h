#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "vicon/cases/case_store.h"

namespace vicon {

/// What a store holds and how its queue stands, for those who watch many: numbers alone.
struct StoreFigures {
    struct Step {
        std::int64_t count = 0;  ///< scans on which it is done
        double seconds = 0;      ///< that it took for all of them
    };
    std::map<std::string, int> jobs;    ///< by state; every state is there
    std::map<std::string, int> outbox;  ///< by state; every state is there
    std::int64_t cases = 0, scans = 0, instances = 0;
    std::int64_t quarantined = 0;  ///< objects
    double oldest_wait_s = 0;      ///< how long the job at the head of the queue has been due
    double free_bytes = 0;         ///< on the store's disk
    std::map<std::string, Step> steps;
};
StoreFigures figuresOf(CaseStore& store);

/// What lies in the store's quarantine until a person has looked at it.
struct Quarantine {
    std::int64_t objects = 0;
    std::string since;  ///< the date on which the oldest came, YYYY-MM-DD; empty without any
};
Quarantine quarantineOf(const std::filesystem::path& store);

}  // namespace vicon
