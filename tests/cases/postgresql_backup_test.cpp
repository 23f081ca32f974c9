// A store whose database lies on a server is backed up and restored like any other.
#include <gmock/gmock.h>
#include <soci/soci.h>

#include <cstdlib>

#include "vicon/cases/backup.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/message_of.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

using support::messageOf;
using testing::HasSubstr;

/// An empty database of the server that this program runs beside.
std::string newDatabase(const std::string& name)
{
    std::string address = std::getenv("VICON_TEST_POSTGRESQL");
    const auto made = support::runCommand("psql '" + address + "' -q -c 'DROP DATABASE IF EXISTS " + name +
                                          "' -c 'CREATE DATABASE " + name + "' 2>&1");
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return address.replace(address.find("/postgres?"), std::string("/postgres").size(), "/" + name);
}

class PostgresqlBackup : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    NoProgress quiet_;
    const fs::path to_ = folder_ / "backup", restored_ = folder_ / "restored";
    const std::string from_database_ = newDatabase("backed_up"), to_database_ = newDatabase("restored");
    CaseStore store_{StorePlace(folder_ / "store", from_database_)};

    void SetUp() override
    {
        CaseRecord a_case;
        a_case.id = "c1";
        a_case.study.uid = "1.2.3";
        a_case.patient.id = "P1";
        ScanRecord scan;
        scan.id = "s1";
        scan.case_id = "c1";
        makePrivateFolder(store_.scanFolder("c1", "s1") / "dicom");
        replaceFile(object(store_), "an object");
        store_.addScan(a_case, scan, {{"1.2.3.1", "c1", "s1", sha256("an object"), "1.dcm"}}, true);
        makePrivateFolder(keptReportsFolder(store_));
        replaceFile(keptReportsFolder(store_) / "r", "a report");
        KeptReport report{.sop_uid = "1.9", .sha256 = sha256("a report"), .file = "r"};
        report.patient.id = "P1";
        keepReport(store_, report);
    }
    static fs::path object(const CaseStore& store) { return store.scanFolder("c1", "s1") / "dicom" / "1.dcm"; }
};

TEST_F(PostgresqlBackup, GivesTheSameStoreBack)
{
    EXPECT_EQ(backUp(store_, to_, quiet_).cases, 1);
    store_.audit(AuditEvent::case_opened, "c1", "", "");
    EXPECT_EQ(restore(to_, {restored_, to_database_}, quiet_).cases, 1);
    CaseStore again(StorePlace(restored_, to_database_));
    EXPECT_EQ(again.requireCase("c1").patient.id, "P1");
    EXPECT_EQ(readFile(object(again)), "an object");
    EXPECT_EQ(readFile(keptReportsFolder(again) / keptReportsOf(again, "P1").at(0).file), "a report");
    again.audit(AuditEvent::case_opened, "c1", "", "");
    EXPECT_THROW(again.database().write([](soci::session& sql) { sql << "DELETE FROM audit"; }), Error)
        << "triggers as well";
    EXPECT_EQ(backUp(store_, to_, quiet_).copied, 0) << "the next one copies what is new";
}

TEST_F(PostgresqlBackup, WhoseRestoreIsStoppedLeavesTheDatabaseAsEmptyAsItWas)
{
    struct StoppedWhileChecking : NoProgress {
        bool stopped = false;
        void report(double, std::string_view what) override { stopped = what.starts_with("checking"); }
        bool cancelled() const override { return stopped; }
    } stopping;
    backUp(store_, to_, quiet_);
    EXPECT_THROW(restore(to_, {restored_, to_database_}, stopping), Error);
    EXPECT_TRUE(stopping.stopped);
    EXPECT_EQ(messageOf([&] { restore(to_, {restored_, to_database_}, quiet_); }), "");
}

/// Puts a program before all others of its name, for as long as the object lives.
class InPlaceOf {
public:
    InPlaceOf(const fs::path& folder, const std::string& name, const std::string& script)
    {
        const fs::path program = folder / name;
        replaceFile(program, "#!/bin/sh\nset -e\n" + script + "\n");
        fs::permissions(program, fs::perms::owner_all);
        ::setenv("PATH", (folder.string() + ":" + before_).c_str(), 1);
    }
    ~InPlaceOf() { ::setenv("PATH", before_.c_str(), 1); }
    InPlaceOf(const InPlaceOf&) = delete;
    InPlaceOf& operator=(const InPlaceOf&) = delete;

private:
    const std::string before_ = std::getenv("PATH");
};

/// The server gives up whoever idles in a transaction for a second; the dump begins two later.
TEST_F(PostgresqlBackup, WithASlowDumpHoldsNobodyUpAndIsNotGivenUp)
{
    const std::string psql = "psql '" + from_database_ + "' -q -v ON_ERROR_STOP=1 -c ";
    support::runCommand(psql + "\"ALTER DATABASE backed_up SET idle_in_transaction_session_timeout = '1s'\"");
    const InPlaceOf slow(folder_.path(), "pg_dump",
                         psql +
                             "\"BEGIN; LOCK TABLE store IN EXCLUSIVE MODE NOWAIT; INSERT INTO counters (name, value)"
                             " VALUES ('meanwhile', 1); COMMIT\"\n" +
                             psql + "'SELECT pg_sleep(2)'\n" + "exec $(pg_config --bindir)/pg_dump \"$@\"");
    EXPECT_EQ(messageOf([&] { backUp(store_, to_, quiet_); }), "");
    restore(to_, {restored_, to_database_}, quiet_);
    Database again(to_database_);
    int meanwhile = 1;
    again.session() << "SELECT COUNT(*) FROM counters WHERE name = 'meanwhile'", soci::into(meanwhile);
    EXPECT_EQ(meanwhile, 0) << "the dump is of the moment of the backup";
}

TEST_F(PostgresqlBackup, GoesNowhereElse)
{
    backUp(store_, to_, quiet_);
    const auto told = [&](const StorePlace& place) { return messageOf([&] { restore(to_, place, quiet_); }); };
    EXPECT_THAT(told(restored_), HasSubstr("whose database lies on a server"));
    EXPECT_THAT(told({restored_, from_database_}), HasSubstr("into an empty database"));
    EXPECT_THAT(told({restored_, "postgresql:///nowhere?host=/nowhere"}), HasSubstr("cannot be reached"));
    EXPECT_FALSE(fs::exists(restored_));
    replaceFile(to_ / "reports" / "r", "another report");
    const CopyCounts restored = restore(to_, {restored_, to_database_}, quiet_);
    ASSERT_EQ(restored.faults.size(), 1u);
    EXPECT_EQ(textOf(restored.faults.front()), "reports/r is not what it was");
}

}  // namespace
}  // namespace vicon
