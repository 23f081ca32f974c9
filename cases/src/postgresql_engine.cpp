#include <poll.h>
#include <soci/postgresql/soci-postgresql.h>

#include <map>

#include "database_engine.h"
#include "postgresql_schema.h"

namespace vicon {
namespace {

/// Added to an address that does not say otherwise: the other side is given up when it is silent for 20 s.
constexpr std::pair<const char*, const char*> kConnection[] = {
    {"application_name", "vicon"}, {"client_encoding", "UTF8"},  {"connect_timeout", "5"},
    {"keepalives_idle", "10"},     {"keepalives_interval", "5"}, {"keepalives_count", "2"},
    {"tcp_user_timeout", "20000"},
};
/// Who stops in the middle of a transaction (a machine switched off) loses it before those who wait give up.
constexpr const char* kSettings[] = {
    "SET lock_timeout = '60s'",
    "SET idle_in_transaction_session_timeout = '45s'",
    "SET default_transaction_isolation = 'read committed'",
    "SET client_min_messages = 'warning'",
};
constexpr const char* kDiskFull = "53100";
constexpr const char* kLockNotAvailable = "55P03";
constexpr const char* kDeadlock = "40P01";
constexpr const char* kNotSerializable = "40001";
constexpr const char *kDataCorrupted = "XX001", *kIndexCorrupted = "XX002";
constexpr const char* kDataException = "22";  // begins the state
constexpr const char* kAddressRemedy = "give it as postgresql://USER@HOST:PORT/NAME";

/// What libpq reads in an address, by keyword.
std::map<std::string, std::string> partsOf(const std::string& address)
{
    char* fault = nullptr;
    const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> options(PQconninfoParse(address.c_str(), &fault),
                                                                               PQconninfoFree);
    const std::unique_ptr<char, decltype(&PQfreemem)> why(fault, PQfreemem);
    if (!options)
        throw Error(ErrorCode::wrong_use, "the database's address cannot be understood (" + inOneLine(why.get()) + ")",
                    "store.database", kAddressRemedy);
    std::map<std::string, std::string> parts;
    for (const PQconninfoOption* option = options.get(); option->keyword; ++option)
        if (option->val)
            parts[option->keyword] = option->val;
    return parts;
}

std::string joined(const std::map<std::string, std::string>& parts)
{
    std::string out;
    for (const auto& [keyword, value] : parts) {
        out += keyword + "='";
        for (const char c : value) {
            if (c == '\\' || c == '\'')
                out += '\\';
            out += c;
        }
        out += "' ";
    }
    return out;
}

/// For messages: without user and password.
std::string nameOf(const std::map<std::string, std::string>& parts)
{
    const auto part = [&](const char* key, const char* otherwise) {
        const auto found = parts.find(key);
        return found == parts.end() ? std::string(otherwise) : found->second;
    };
    return "PostgreSQL database '" + part("dbname", "") + "' at " + part("host", "this machine");
}

PGconn* connectionOf(soci::session& sql)
{
    auto* backend = static_cast<soci::postgresql_session_backend*>(sql.get_backend());
    return backend ? backend->conn_ : nullptr;
}

/// Whether something came from the other side that was not asked for: mostly that it is gone.
bool isReadable(PGconn* connection)
{
    pollfd socket{.fd = PQsocket(connection), .events = POLLIN, .revents = 0};
    return ::poll(&socket, 1, 0) > 0;
}

std::string stateOf(const soci::soci_error& e)
{
    const auto* postgresql = dynamic_cast<const soci::postgresql_soci_error*>(&e);
    return postgresql ? postgresql->sqlstate() : "";
}

class Postgresql : public DatabaseEngine {
public:
    explicit Postgresql(const std::string& address)
    {
        auto parts = partsOf(address);
        if (parts.contains("password"))
            throw Error(ErrorCode::wrong_use, "a password in the database's address is shown by 'vicon config'",
                        "store.database", "put it into ~/.pgpass or $PGPASSWORD");
        name_ = nameOf(parts);
        for (const auto& [keyword, value] : kConnection)
            parts.try_emplace(keyword, value);
        connection_ = joined(parts);
    }

    std::unique_ptr<soci::session> connect() override
    {
        return std::make_unique<soci::session>(soci::postgresql, connection_);
    }
    void prepare(soci::session& sql) override
    {
        for (const char* setting : kSettings)
            sql << setting;
    }
    bool isLost(soci::session& sql) override
    {
        PGconn* connection = connectionOf(sql);
        if (!connection)
            return true;
        while (PQstatus(connection) == CONNECTION_OK && isReadable(connection))
            if (PQconsumeInput(connection) == 0)
                break;
        return PQstatus(connection) != CONNECTION_OK;
    }

    int schemaVersion(soci::session& sql) override
    {
        int version = 0;
        bool there = false;
        std::string table;
        soci::indicator found = soci::i_null;
        sql << "SELECT CAST(to_regclass('store') AS text)", soci::into(table, found);
        there = found == soci::i_ok;
        if (there)
            sql << "SELECT schema_version FROM store", soci::into(version);
        return version;
    }
    void setSchemaVersion(soci::session& sql, int version) override
    {
        if (schemaVersion(sql) == 0) {
            sql << "CREATE TABLE store (id TEXT NOT NULL, schema_version INTEGER NOT NULL)";
            sql << "INSERT INTO store VALUES ('', :version)", soci::use(version);
        }
        sql << "UPDATE store SET schema_version = :version", soci::use(version);
    }
    void beginMigration(soci::session& sql) override
    {
        sql << "BEGIN";
        sql << "SELECT pg_advisory_xact_lock(hashtext('vicon ' || current_schema()))";
    }
    std::string schemaStatement(const std::string& statement) override { return inPostgresql(statement); }

    void beginAlone(soci::session& sql) override
    {
        sql << "BEGIN";
        sql << "LOCK TABLE store IN EXCLUSIVE MODE";
    }
    void beginBesideOthers(soci::session& sql) override { sql << "BEGIN"; }
    std::string transactionName(soci::session& sql) override;
    bool wasCommitted(soci::session& sql, const std::string& name) override;
    bool gaveWay(const soci::soci_error& e) override
    {
        const std::string state = stateOf(e);
        return state == kDeadlock || state == kNotSerializable;
    }

    std::string reasonOf(const soci::soci_error& e) override;
    Error refusal(const soci::soci_error& e, soci::session* sql) override;
    Error damaged() override
    {
        return {ErrorCode::database, "the database is damaged", name_,
                "stop VICON, and restore the last backup into an empty database by 'vicon restore'"};
    }
    Error connectionBroke() override
    {
        return {ErrorCode::database, "the connection to the database broke; nothing was saved", name_,
                "try again; if it stays so, see whether the server runs"};
    }
    Error cannotBeOpened(const soci::soci_error& e) override
    {
        return {ErrorCode::database, "the database cannot be reached (" + reasonOf(e) + ")", name_,
                "see whether the server runs and lets this account in"};
    }

    void readBeginnings(soci::session&) override {}
    std::string version(soci::session& sql) override
    {
        std::string snapshot;
        sql << "SELECT CAST(pg_current_snapshot() AS text)", soci::into(snapshot);
        return snapshot;
    }
    std::string damage(soci::session& sql) override;

private:
    std::string connection_, name_;
    std::string last_;  ///< the name of the transaction before
};

/// A row, and not the server's own number of the transaction: after a breakdown that number can be given again. The row
/// of this connection's transaction before goes with it.
std::string Postgresql::transactionName(soci::session& sql)
{
    int writes = 0;
    sql << "SELECT CASE WHEN pg_current_xact_id_if_assigned() IS NULL THEN 0 ELSE 1 END", soci::into(writes);
    if (writes == 0)
        return {};
    if (last_.empty())  // what connections that have ended left behind
        sql << "DELETE FROM commits WHERE name IN (SELECT name FROM commits"
               " WHERE at < EXTRACT(EPOCH FROM now()) - 86400 FOR UPDATE SKIP LOCKED)";
    std::string name;
    sql << "WITH earlier AS (DELETE FROM commits WHERE name = :last) INSERT INTO commits (name, at)"
           " VALUES (CAST(gen_random_uuid() AS text), EXTRACT(EPOCH FROM now())) RETURNING name",
        soci::use(last_), soci::into(name);
    last_ = name;
    return name;
}

/// Who writes the same name waits until the transaction that wrote it has ended.
bool Postgresql::wasCommitted(soci::session& sql, const std::string& name)
{
    std::string written;
    sql << "BEGIN";
    sql << "INSERT INTO commits (name, at) VALUES (:name, 0) ON CONFLICT (name) DO NOTHING RETURNING name",
        soci::use(name), soci::into(written);
    const bool is_new = sql.got_data();
    sql << "ROLLBACK";
    return !is_new;
}

/// What a server says of a statement holds values from its second line on, of data that it cannot take (class 22) in
/// the first as well. Without a state it is of the connection.
std::string Postgresql::reasonOf(const soci::soci_error& e)
{
    const std::string state = stateOf(e), text = e.get_error_message();
    if (state.starts_with(kDataException))
        return "data that it cannot take, SQLSTATE " + state;
    return inOneLine(state.empty() ? text : text.substr(0, text.find('\n')));
}

Error Postgresql::refusal(const soci::soci_error& e, soci::session* sql)
{
    const std::string state = stateOf(e);
    if (state == kDiskFull)
        return {ErrorCode::database, "the database's disk is full; nothing was saved", name_,
                "free some space on it and try again"};
    if (state == kLockNotAvailable)
        return {ErrorCode::database, "another program keeps the database busy; nothing was saved", name_,
                "try again in a moment"};
    if (state == kDataCorrupted || state == kIndexCorrupted)
        return damaged();
    if (sql && isLost(*sql))
        return connectionBroke();
    return {ErrorCode::database, "the database refused (" + reasonOf(e) + ")", name_,
            "see the server's log, then try again"};
}

/// Every page of every table is read; the server says what it cannot read, also by checksums where it keeps them.
std::string Postgresql::damage(soci::session& sql)
{
    const soci::rowset<std::string> tables =
        (sql.prepare << "SELECT CAST(tablename AS text) FROM pg_tables WHERE schemaname = current_schema()");
    for (const std::string& table : tables) {
        long long characters = 0;
        sql << "SELECT COALESCE(SUM(length(CAST(t AS text))), 0) FROM " + table + " AS t", soci::into(characters);
    }
    for (const char* setting : {"fsync", "full_page_writes", "synchronous_commit"}) {
        std::string value;
        sql << std::string("SHOW ") + setting, soci::into(value);
        if (value == "off")
            return std::string("the server's setting ") + setting + " is off: what was saved is lost with its power";
    }
    return {};
}

}  // namespace

std::unique_ptr<DatabaseEngine> makePostgresql(const std::string& address)
{
    return std::make_unique<Postgresql>(address);
}

bool isServerAddress(const std::string& where)
{
    return where.starts_with("postgresql://") || where.starts_with("postgres://");
}

bool isPostgresql(soci::session& sql)
{
    return sql.get_backend_name() == "postgresql";
}

}  // namespace vicon
