#pragma once

#include <filesystem>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/support/store_place.h"
#include "vicon/support/support.h"

namespace vicon::pipeline {

/// A store with one case "c" and scans "s0", "s1", ... that hold no image.
struct FakeStore {
    support::TemporaryFolder folder;
    CaseStore store{support::storePlace(folder.path())};

    void addJobs(int count)
    {
        for (int n = 0; n < count; ++n) {
            const std::string scan = "s" + std::to_string(n);
            std::filesystem::create_directories(store.scanFolder("c", scan));
            store.addScan({.id = "c", .study = {.uid = "1.2.3"}}, {.id = scan, .case_id = "c"}, {}, true);
        }
    }
};

}  // namespace vicon::pipeline
