#pragma once

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

    /// The connection itself, made anew when it broke. Its errors name the statement and its values: whoever reads for
    /// VICON takes read().
    soci::session& session();

    /// For reading: returns what `work` returns. It is run again when the connection broke meanwhile; within write()
    /// and writeRows() it is a part of their transaction. Database errors, and rows that cannot be understood, become
    /// Error{database}.
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

    /// The same again as long as nobody changed anything, over this connection or another; to be compared with what
    /// this object said before.
    std::string version();

    /// Throws Error{database} where a table cannot be read at its beginning: in milliseconds, and so not all of the
    /// damage that damage() finds. A server says so by itself.
    void requireReadable();

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
    void readAgain(const std::function<void(soci::session&)>& work);
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
