#pragma once

#include <filesystem>
#include <string>

namespace vicon::support {

/// Overwrites the page at which a table of a store's SQLite database begins.
class DamagedTable {
public:
    DamagedTable(const std::filesystem::path& store, const std::string& table);
    /// Puts the page back. Who has read it meanwhile may not see that.
    void mend() const;

private:
    void write(const std::string& page) const;

    std::filesystem::path file_;
    std::string page_;
    long at_ = 0;
};

}  // namespace vicon::support
