// Wherever a store lies, its database lies in it, for its owner alone.
#include <gtest/gtest.h>
#include <soci/soci.h>
#include <sys/stat.h>

#include "vicon/cases/case_store.h"
#include "vicon/cases/database.h"
#include "vicon/core/error.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

class SqlitePath : public testing::TestWithParam<const char*> {
protected:
    support::TemporaryFolder folder;
};

TEST_P(SqlitePath, HoldsItsDatabaseAndNothingBesideIt)
{
    const fs::path root = folder / "root", place = root / GetParam();
    fs::create_directories(root);
    {
        const CaseStore store(place);
        EXPECT_TRUE(fs::is_regular_file(place / "vicon.db"));
        for (const auto& entry : fs::directory_iterator(place)) {
            struct stat about {};
            ASSERT_EQ(::stat(entry.path().c_str(), &about), 0);
            EXPECT_TRUE(!entry.is_regular_file() || (about.st_mode & 0077) == 0) << entry.path();
        }
    }
    for (const auto& entry : fs::directory_iterator(root))
        EXPECT_EQ(entry.path(), place);
    EXPECT_NO_THROW(CaseStore again(place));
}

INSTANTIATE_TEST_SUITE_P(Names, SqlitePath,
                         testing::Values("plain", "with space", "two  spaces ", "quote\"d", "apostrophe's",
                                         "Übung-患者", "semi;colon", "equals=sign", "dbname=x timeout=1",
                                         "latin-\xe9"));

TEST(SqliteDatabase, ThatCannotBeOpenedSaysWhatTheSystemSays)
{
    const support::TemporaryFolder folder;
    try {
        const Database database(folder / "none" / "vicon.db");
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("cannot be opened (No such file or directory); check"), std::string::npos)
            << e.what();
    }
}

/// Another program that opens the database and closes it, as every command does.
void openAndCloseElsewhere(const fs::path& file)
{
    const auto result = support::runCommand("sqlite3 '" + file.string() + "' 'SELECT count(*) FROM cases'");
    ASSERT_EQ(result.exit_code, 0) << result.output;
}

TEST(SqliteDatabase, KeepsItsLogWhileAnotherConnectionOfThisProcessCloses)
{
    const support::TemporaryFolder folder;
    const fs::path file = folder / "vicon.db";
    Database kept(file);
    const auto count = [](Database& database) {
        int rows = 0;
        database.session() << "SELECT count(*) FROM counters", soci::into(rows);
        return rows;
    };
    for (int n = 1; n <= 3; ++n) {
        std::make_unique<Database>(file).reset();
        openAndCloseElsewhere(file);
        EXPECT_TRUE(fs::exists(file.string() + "-wal")) << "another program took it away";
        const std::string name = std::to_string(n);
        kept.write(
            [&](soci::session& sql) { sql << "INSERT INTO counters VALUES (:name, 1)", soci::use(name, "name"); });
        EXPECT_EQ(count(kept), n);
        Database fresh(file);
        EXPECT_EQ(count(fresh), n) << "what was written is there for everybody";
    }
}

}  // namespace
