#include "vicon/support/store_place.h"

#include <soci/postgresql/soci-postgresql.h>

#include <cstdlib>

#include "database_engine.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon::support {
namespace {

std::string serverAddress()
{
    const char* address = std::getenv("VICON_TEST_POSTGRESQL");
    return address ? address : "";
}

}  // namespace

bool usesPostgresql()
{
    return !serverAddress().empty();
}

StorePlace storePlace(const std::filesystem::path& folder)
{
    if (!usesPostgresql())
        return folder;
    const std::string schema =
        "s" + sha256(std::filesystem::absolute(folder).lexically_normal().string()).substr(0, 16);
    soci::session sql(soci::postgresql, serverAddress());
    sql << "SET client_min_messages = 'warning'";
    sql << "CREATE SCHEMA IF NOT EXISTS " + schema;
    return {folder, serverAddress() + "&options=-csearch_path%3D" + schema};
}

void tellServer(const std::string& arguments)
{
    const CommandResult result = runCommand(std::string(std::getenv("VICON_TEST_SERVER")) + " " + arguments);
    ASSERT_EQ(result.exit_code, 0) << result.output;
}

StorePlace storeOfVersion(int version, const std::filesystem::path& folder, const std::vector<std::string>& statements)
{
    StorePlace place = storePlace(folder);
    std::filesystem::create_directories(folder);
    const auto engine = usesPostgresql() ? makePostgresql(place.database) : makeSqlite((folder / "vicon.db").string());
    const auto sql = engine->connect();
    for (int n = 0; n < version; ++n)
        for (const char* statement : schemaMigrations().at(std::size_t(n)))
            *sql << engine->schemaStatement(statement);
    for (const std::string& statement : statements)
        *sql << statement;
    engine->setSchemaVersion(*sql, version);
    return place;
}

}  // namespace vicon::support
