#pragma once

#include <soci/soci.h>

#include <memory>
#include <string>
#include <vector>

#include "vicon/core/error.h"

namespace vicon {

/// What differs between the databases that the state of a store may lie in. Everything else is the same SQL.
class DatabaseEngine {
public:
    virtual ~DatabaseEngine() = default;

    virtual std::unique_ptr<soci::session> connect() = 0;
    /// Settings of a connection that was just made.
    virtual void prepare(soci::session& sql) = 0;
    /// Whether the connection is broken, as far as that can be known without asking the other side.
    virtual bool isLost(soci::session& sql) = 0;

    /// 0: there is no schema yet.
    virtual int schemaVersion(soci::session& sql) = 0;
    virtual void setSchemaVersion(soci::session& sql, int version) = 0;
    /// Begins the transaction that may migrate: one at a time.
    virtual void beginMigration(soci::session& sql) = 0;
    /// A statement of the schema, written for SQLite, as this database takes it.
    virtual std::string schemaStatement(const std::string& statement) = 0;

    /// Begins a transaction that no other of its kind runs beside.
    virtual void beginAlone(soci::session& sql) = 0;
    virtual void beginBesideOthers(soci::session& sql) = 0;
    /// Leaves in the running transaction what it can be asked for by later; empty where a commit's outcome is never in
    /// doubt.
    virtual std::string transactionName(soci::session& sql) = 0;
    /// Whether the transaction of that name was committed. Waits until it is decided.
    virtual bool wasCommitted(soci::session& sql, const std::string& name) = 0;
    /// Whether the transaction gave way to another, and may be run again.
    virtual bool gaveWay(const soci::soci_error& e) = 0;

    /// The database's own words in one line, without the statement and its values: those are patients'.
    virtual std::string reasonOf(const soci::soci_error& e) = 0;
    /// In the reader's words where one can do something about it.
    virtual Error refusal(const soci::soci_error& e, soci::session* sql) = 0;
    virtual Error connectionBroke() = 0;
    /// What is told where a page or a row is not as it was written.
    virtual Error damaged() = 0;
    virtual Error cannotBeOpened(const soci::soci_error& e) = 0;

    /// As Database::requireReadable(), version() and damage().
    virtual void readBeginnings(soci::session& sql) = 0;
    virtual std::string version(soci::session& sql) = 0;
    virtual std::string damage(soci::session& sql) = 0;
};

std::unique_ptr<DatabaseEngine> makeSqlite(const std::string& file);
std::unique_ptr<DatabaseEngine> makePostgresql(const std::string& address);

/// Whether it is the address of a PostgreSQL database.
bool isServerAddress(const std::string& where);
bool isPostgresql(soci::session& sql);

/// The statements that lead from schema version n to n+1, in SQLite's words.
const std::vector<std::vector<const char*>>& schemaMigrations();

/// What is told where the data of a store are there, and its database is not, or is empty.
Error databaseIsLost(const std::string& where);

/// The text of an error in one line.
std::string inOneLine(const std::string& text);

}  // namespace vicon
