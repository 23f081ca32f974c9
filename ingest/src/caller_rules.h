#pragma once

#include <string>
#include <vector>

namespace vicon::ingest {

/// Who may call: a list of TITLE, TITLE@HOST and @HOST, separated by commas; empty: anybody.
class CallerRules {
public:
    /// Hosts given by name are looked up now. Throws Error{wrong_use} for an entry that is none of these, or a host
    /// that has no address.
    explicit CallerRules(const std::string& list);
    bool allows(const std::string& title, const std::string& address) const;

private:
    struct Rule {
        std::string title, address;  ///< empty: any
    };
    std::vector<Rule> rules_;
};

}  // namespace vicon::ingest
