#pragma once

#include <functional>
#include <memory>
#include <string>

namespace soci {
class session;
}

namespace vicon {

class DatabaseEngine;

/// The state of a store: one connection to its database, migrated to this VICON's schema version. SQLite or PostgreSQL;
/// a connection to a server that broke is made anew. One object serves one thread at a time.
class Database {
public:
    static constexpr int kSchemaVersion = 9;

    /// Opens (and creates) the database. Throws Error{database} when it cannot, or when its schema is newer than
    /// this VICON knows.
    /// @param where a file (SQLite), or the address of a PostgreSQL database, postgresql://USER@HOST/NAME
    explicit Database(const std::string& where);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    const std::string& where() const { return where_; }

    /// For reading; within write() and writeRows() a part of their transaction.
    soci::session& session();

    /// For reading by what runs for months: `work` is run again when the connection broke meanwhile. Database errors
    /// become Error{database}.
    void read(const std::function<void(soci::session&)>& work);

    /// The same again as long as nobody changed anything, over this connection or another; to be compared with what
    /// this object said before.
    std::string version();

    /// Reads all of it: what is damaged, in the database's words; empty where nothing is.
    std::string damage();

    /// Runs `work` in a transaction that nobody else's write() runs beside, so what it reads stays as it is; rolled
    /// back when it throws. Database errors become Error{database}: then nothing was saved.
    void write(const std::function<void(soci::session&)>& work);

    /// Like write(), for what happens often: on a server others write beside it, and only rows that `work` has updated
    /// are safe from them. `work` is run again when the connection broke, or when it gave way to another that wrote
    /// the same rows, so it must not mind that.
    void writeRows(const std::function<void(soci::session&)>& work);

private:
    enum class Beside { nobody, others };
    void migrate();
    void reconnect();
    void transact(const std::function<void(soci::session&)>& work, Beside beside);
    void begin(Beside beside);
    void commit();
    bool wasCommitted(const std::string& name);
    void rollBack();

    std::string where_;
    std::unique_ptr<DatabaseEngine> engine_;
    std::unique_ptr<soci::session> session_;
    bool writing_ = false;
};

}  // namespace vicon
