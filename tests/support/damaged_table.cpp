#include "vicon/support/damaged_table.h"

#include <sqlite3.h>

#include <fstream>

namespace vicon::support {
namespace {

long numberSaid(sqlite3* database, const std::string& sql)
{
    long number = 0;
    const auto first = [](void* to, int, char** values, char**) {
        *static_cast<long*>(to) = std::stol(values[0]);
        return 0;
    };
    sqlite3_exec(database, sql.c_str(), first, &number, nullptr);
    return number;
}

}  // namespace

DamagedTable::DamagedTable(const std::filesystem::path& store, const std::string& table) : file_(store / "vicon.db")
{
    sqlite3* database = nullptr;
    sqlite3_open(file_.c_str(), &database);
    numberSaid(database, "PRAGMA wal_checkpoint(TRUNCATE)");
    page_.resize(std::size_t(numberSaid(database, "PRAGMA page_size")));
    const long page = numberSaid(database, "SELECT rootpage FROM sqlite_master WHERE name = '" + table + "'");
    sqlite3_close(database);
    at_ = (page - 1) * long(page_.size());
    std::ifstream(file_, std::ios::binary).seekg(at_).read(page_.data(), std::streamsize(page_.size()));
    write(std::string(page_.size(), '\xa5'));
}

void DamagedTable::mend() const
{
    write(page_);
}

void DamagedTable::write(const std::string& page) const
{
    std::fstream(file_, std::ios::binary | std::ios::in | std::ios::out)
        .seekp(at_)
        .write(page.data(), std::streamsize(page.size()));
}

}  // namespace vicon::support
