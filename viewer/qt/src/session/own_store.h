#pragma once

#include <filesystem>
#include <memory>
#include <utility>

#include "vicon/cases/case_store.h"

namespace vicon::viewer {

/// A thread's own connection to the store, opened when it is first asked for.
class OwnStore {
public:
    explicit OwnStore(StorePlace place) : place_(std::move(place)) {}
    CaseStore& operator()()
    {
        if (!opened_)
            opened_ = std::make_unique<CaseStore>(place_);
        return *opened_;
    }

private:
    StorePlace place_;
    std::unique_ptr<CaseStore> opened_;
};

}  // namespace vicon::viewer
