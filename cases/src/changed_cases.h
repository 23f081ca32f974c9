#pragma once

#include <soci/soci.h>

#include <set>
#include <string>

#include "vicon/cases/case_store.h"

namespace vicon {

/// Which cases somebody changes from a moment on: who changes one leaves a line in the audit trail, a worker holds a
/// job.
class ChangedCases {
public:
    /// From now on.
    explicit ChangedCases(CaseStore& store);
    /// Those of until now. Throws Error{database}.
    std::set<std::string> untilNow();

private:
    CaseStore& store_;
    long long last_line_ = 0;
    std::string since_;
    std::set<std::string> worked_on_;
};

}  // namespace vicon
