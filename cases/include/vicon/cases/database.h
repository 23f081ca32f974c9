#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace soci {
class session;
}

namespace vicon {

class DatabaseEngine;

/// The state of a store: one connection to its database, migrated to this VICON's schema version. SQLite or PostgreSQL;
/// a broken connection to a server is made again. One object serves one thread at a time.
class Database {
public:
    static constexpr int kSchemaVersion = 10;

    /// Opens (and creates) the database. Throws Error{database} when it cannot, or when its schema is newer than
    /// this VICON knows.
    /// @param where a file (SQLite), or the address of a PostgreSQL database, postgresql://USER@HOST/NAME
    /// @param may_be_new an empty one is made a store's; else Error{database}
    explicit Database(const std::string& where, bool may_be_new = true);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    const std::string& where() const { return where_; }
    /// How long a server that does not answer is waited for.
    void setPatience(std::chrono::milliseconds patience) { patience_ = patience; }

    /// The connection itself, made again after it broke. SOCI's errors name the statement and its values, which may be
    /// a patient's: code of VICON reads by read().
    soci::session& session();

    /// Runs `work`, which only reads, and returns what it returns. It is run again when the connection breaks; within
    /// write() and writeRows() it is part of their transaction. Throws Error{database} where the database fails, or a
    /// row makes no sense.
    template <class Work>
    auto read(const Work& work)
    {
        using Result = std::invoke_result_t<const Work&, soci::session&>;
        if constexpr (std::is_void_v<Result>) {
            readAgain(work);
        } else {
            std::optional<Result> result;
            readAgain([&](soci::session& sql) { result.emplace(work(sql)); });
            return std::move(*result);
        }
    }

    /// A text that stays the same until somebody changes the database, over this connection or another. Only texts of
    /// one object can be compared.
    std::string version();

    /// Throws Error{database} where the beginning of a table cannot be read. Takes milliseconds, and so misses damage
    /// that damage() finds. Does nothing on a server, which tells of damage itself.
    void requireReadable();

    /// Reads the whole database and returns what is damaged, in the database's words; empty where nothing is.
    std::string damage();

    /// Runs `work` in a transaction. No other write() runs at the same time, so what `work` reads stays as it is.
    /// Rolled back when it throws. Throws Error{database} where the database fails; then nothing was saved.
    void write(const std::function<void(soci::session&)>& work);

    /// Like write(), for what happens often: on a server others write at the same time, and only the rows that `work`
    /// has updated are safe from them. `work` may run more than once: after the connection broke, or after it gave way
    /// to another writer of the same rows.
    void writeRows(const std::function<void(soci::session&)>& work);

private:
    enum class Writers { one, several };  // at the same time
    void migrate(bool may_be_new);
    void readAgain(const std::function<void(soci::session&)>& work);
    void reconnect();
    void transact(const std::function<void(soci::session&)>& work, Writers writers);
    void begin(Writers writers);
    void commit();
    bool wasCommitted(const std::string& name);
    void rollBack();

    std::string where_;
    std::unique_ptr<DatabaseEngine> engine_;
    std::unique_ptr<soci::session> session_;
    bool writing_ = false;
    std::chrono::milliseconds patience_ = std::chrono::seconds(20);  ///< a server started anew answers within this
};

}  // namespace vicon
