// What a server does that a file does not: it breaks off, is started anew, and serves many at once.
#include <gmock/gmock.h>
#include <soci/soci.h>
#include <sys/wait.h>
#include <unistd.h>

#include <barrier>
#include <csignal>
#include <cstdlib>
#include <future>
#include <set>
#include <thread>

#include "database_engine.h"
#include "fake_jobs.h"
#include "postgresql_proxy.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/cases/job_queue.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

using pipeline::FakeStore;
using support::tellServer;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string messageOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& e) {
        return e.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

void put(soci::session& sql, const std::string& name)
{
    sql << "INSERT INTO counters (name, value) VALUES (:name, 1)", soci::use(name);
}

int countOf(Database& database, const std::string& name)
{
    int count = 0;
    database.session() << "SELECT COUNT(*) FROM counters WHERE name = :name", soci::use(name), soci::into(count);
    return count;
}

TEST(PostgresqlServer, StartedAnewIsUsedAgainWithoutAWord)
{
    FakeStore fake;
    fake.addJobs(1);
    tellServer("restart -m fast");
    EXPECT_EQ(fake.store.scans("c").size(), 1u);
    tellServer("restart -m immediate");
    fake.store.audit(AuditEvent::case_opened, "c", "s0", "");
    EXPECT_EQ(auditTrail(fake.store, "c").back().event, "case opened");
}

TEST(PostgresqlServer, ThatBreaksOffInAChangeSavesNothingAndSaysSoInOneLine)
{
    FakeStore fake;
    Database& database = fake.store.database();
    const std::string said = messageOf([&] {
        database.write([&](soci::session& sql) {
            put(sql, "half");
            tellServer("restart -m immediate");
            put(sql, "other half");
        });
    });
    EXPECT_THAT(said, AllOf(HasSubstr("connection to the database broke; nothing was saved"), Not(HasSubstr("\n"))));
    EXPECT_EQ(countOf(database, "half"), 0);
    database.write([](soci::session& sql) { put(sql, "whole"); });
    EXPECT_EQ(countOf(database, "whole"), 1);
}

TEST(PostgresqlServer, ThatBreaksOffInAWorkersChangeGetsItAgain)
{
    FakeStore fake;
    int runs = 0;
    fake.store.database().writeRows([&](soci::session& sql) {
        put(sql, "step");
        if (++runs == 1)
            tellServer("restart -m fast");
        put(sql, "progress");
    });
    EXPECT_EQ(runs, 2);
    EXPECT_EQ(countOf(fake.store.database(), "step"), 1);
}

TEST(PostgresqlServer, ThatIsAwayIsOneClearLineWithoutUserAndAnswersLater)
{
    FakeStore fake;
    tellServer("stop -m fast");
    const std::string said = messageOf([&] { CaseStore{fake.store.place()}; });
    EXPECT_THAT(said, AllOf(HasSubstr("cannot be reached"), HasSubstr("PostgreSQL database 'postgres'"),
                            Not(HasSubstr("vicon@")), Not(HasSubstr("\n"))));
    std::thread starter([] { tellServer("start"); });
    EXPECT_NO_THROW(fake.store.audit(AuditEvent::case_opened, "c", "", "")) << "it waits while the server starts";
    starter.join();
}

/// A store whose line to the server can be cut.
class CutLine : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    StorePlace direct_ = support::storePlace(folder_ / "store");
    std::string serverFolder() const
    {
        const auto from = direct_.database.find("host=") + 5;
        return direct_.database.substr(from, direct_.database.find('&', from) - from);
    }
    test::PostgresqlProxy proxy_{folder_.path(), serverFolder()};
    CaseStore store_{StorePlace(direct_.folder, std::string(direct_.database)
                                                    .replace(direct_.database.find(serverFolder()),
                                                             serverFolder().size(), folder_.path().string()))};
};

TEST_F(CutLine, AfterACommitReachedTheServerIsASuccessDoneOnce)
{
    proxy_.cutAfter("COMMIT");
    EXPECT_NO_THROW(store_.audit(AuditEvent::report_signed, "c", "", ""));
    EXPECT_EQ(proxy_.cuts(), 1);
    EXPECT_EQ(auditTrail(store_, "c").size(), 1u);
}

TEST_F(CutLine, BeforeACommitReachedTheServerSavesNothing)
{
    proxy_.cutBefore("COMMIT");
    EXPECT_THAT(messageOf([&] { store_.audit(AuditEvent::report_signed, "c", "", ""); }),
                HasSubstr("nothing was saved"));
    EXPECT_EQ(proxy_.cuts(), 1);
    EXPECT_TRUE(auditTrail(store_, "c").empty());
}

TEST_F(CutLine, TwiceAtTheBeginningOfAChangeIsMadeAgainByTheNext)
{
    proxy_.cutBefore("BEGIN", 2);
    EXPECT_THAT(messageOf([&] { store_.audit(AuditEvent::report_signed, "c", "", ""); }),
                HasSubstr("nothing was saved"));
    EXPECT_EQ(proxy_.cuts(), 2);
    EXPECT_TRUE(auditTrail(store_, "c").empty());
    EXPECT_NO_THROW(store_.audit(AuditEvent::report_signed, "c", "", ""));
    EXPECT_EQ(auditTrail(store_, "c").size(), 1u);
}

TEST_F(CutLine, ForLongerThanItIsWaitedForIsForgottenWhenTheServerIsBack)
{
    store_.database().setPatience(std::chrono::milliseconds(0));
    proxy_.stayAwayAfterCut();
    proxy_.cutBefore("BEGIN");
    EXPECT_THAT(messageOf([&] { store_.audit(AuditEvent::report_signed, "c", "", ""); }),
                HasSubstr("cannot be reached"));
    EXPECT_THAT(messageOf([&] { auditTrail(store_, "c"); }), HasSubstr("cannot be reached"));
    proxy_.comeBack();
    EXPECT_NO_THROW(store_.audit(AuditEvent::report_signed, "c", "", ""));
    EXPECT_EQ(auditTrail(store_, "c").size(), 1u);
}

TEST_F(CutLine, InAWorkersCommitIsSavedOnceWhetherItArrivedOrNot)
{
    int runs = 0;
    const auto step = [&](const std::string& name) {
        store_.database().writeRows([&](soci::session& sql) {
            ++runs;
            put(sql, name);
        });
    };
    proxy_.cutAfter("COMMIT");
    step("arrived");
    EXPECT_EQ(runs, 1) << "what was committed is not done again: its second run would fail on the same name";
    proxy_.cutBefore("COMMIT");
    step("did not arrive");
    EXPECT_EQ(runs, 3);
    EXPECT_EQ(countOf(store_.database(), "arrived") + countOf(store_.database(), "did not arrive"), 2);
}

TEST_F(CutLine, InAClaimGivesTheJobToWhoeverGotItMeanwhileAlone)
{
    makePrivateFolder(store_.scanFolder("c", "s0"));
    store_.addScan({.id = "c", .study = {.uid = "1.2.3"}}, {.id = "s0", .case_id = "c"}, {}, true);
    Database direct(direct_.database);
    std::optional<Job> of_other;
    // The clock is read in each run of the claim: in the second the other was faster.
    JobQueue queue(store_.database(), {}, [&] {
        if (proxy_.cuts() > 0 && !of_other)
            of_other = JobQueue(direct, {}, [] { return 1000; }).claim("other");
        return 1000;
    });
    proxy_.cutBefore("COMMIT");
    EXPECT_FALSE(queue.claim("a"));
    ASSERT_TRUE(of_other);
    EXPECT_EQ(of_other->owner, "other");
}

/// A deletion during whose commit the server goes away for longer than it is waited for.
class CutDeletion : public CutLine {
protected:
    NoProgress quiet_;

    CutDeletion()
    {
        makePrivateFolder(store_.scanFolder("c", "s0"));
        replaceFile(store_.scanFolder("c", "s0") / "mask.mha", "a mask");
        store_.addScan({.id = "c", .study = {.uid = "1.2.3"}}, {.id = "s0", .case_id = "c"}, {}, false);
        store_.database().setPatience(std::chrono::milliseconds(0));
        proxy_.stayAwayAfterCut();
    }
    void deleteAndFinish()
    {
        EXPECT_THROW(deleteCase(store_, "c", true, "a test", quiet_), Error);
        EXPECT_FALSE(fs::exists(store_.caseFolder("c"))) << "nobody knows yet whether it goes";
        EXPECT_TRUE(hasBegunDeletions(store_));
        proxy_.comeBack();
        finishDeletions(store_, StoreLock(store_.folder(), quiet_));
        EXPECT_FALSE(hasBegunDeletions(store_));
        EXPECT_EQ(fs::exists(store_.scanFolder("c", "s0") / "mask.mha"), store_.findCase("c").has_value());
    }
};

TEST_F(CutDeletion, ThatWasCommittedIsBroughtToAnEndWhenTheServerIsBack)
{
    proxy_.cutAfter("COMMIT");
    deleteAndFinish();
    EXPECT_FALSE(store_.findCase("c"));
}

TEST_F(CutDeletion, ThatWasNotCommittedGivesTheCaseBackWhenTheServerIsBack)
{
    proxy_.cutBefore("COMMIT");
    deleteAndFinish();
    EXPECT_TRUE(store_.findCase("c"));
}

TEST(PostgresqlServer, ThatBreaksDownDoesNotTakeALostTransactionForOneThatGotItsNumber)
{
    FakeStore fake;
    const auto number = [](soci::session& sql) {
        std::string number;
        sql << "SELECT CAST(pg_current_xact_id() AS text)", soci::into(number);
        return number;
    };
    const auto engine = makePostgresql(fake.store.place().database);
    const auto connection = engine->connect();
    engine->beginBesideOthers(*connection);
    put(*connection, "lost");
    const std::string lost_number = number(*connection), name = engine->transactionName(*connection);
    tellServer("restart -m immediate");
    bool given_again = false;
    while (!given_again)
        fake.store.database().write([&](soci::session& sql) {
            put(sql, "kept " + number(sql));
            given_again = std::stoll(number(sql)) >= std::stoll(lost_number);
        });
    connection->reconnect();
    EXPECT_FALSE(engine->wasCommitted(*connection, name));
}

TEST(PostgresqlServer, IsWaitedForUntilItKnowsOfACommit)
{
    FakeStore fake;
    const auto engine = makePostgresql(fake.store.place().database);
    const auto connection = engine->connect(), asking = engine->connect();
    engine->beginBesideOthers(*connection);
    put(*connection, "late");
    const std::string name = engine->transactionName(*connection);
    auto answer = std::async(std::launch::async, [&] { return engine->wasCommitted(*asking, name); });
    EXPECT_EQ(answer.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
    *connection << "COMMIT";
    EXPECT_TRUE(answer.get());
}

TEST(PostgresqlServer, LetsTwoThatWaitForEachOtherBothWriteInTheEnd)
{
    FakeStore fake;
    fake.store.database().write([](soci::session& sql) { put(sql, "a"), put(sql, "b"); });
    std::barrier both_hold_one(2);
    const auto raise = [&](const std::string& first, const std::string& second) {
        Database database(fake.store.place().database);
        int runs = 0;
        database.writeRows([&](soci::session& sql) {
            sql << "UPDATE counters SET value = value + 1 WHERE name = :name", soci::use(first);
            if (++runs == 1)
                both_hold_one.arrive_and_wait();
            sql << "UPDATE counters SET value = value + 1 WHERE name = :name", soci::use(second);
        });
    };
    auto other = std::async(std::launch::async, [&] { raise("b", "a"); });
    EXPECT_NO_THROW(raise("a", "b"));
    EXPECT_NO_THROW(other.get());
    int sum = 0;
    fake.store.database().session() << "SELECT SUM(value) FROM counters WHERE name IN ('a', 'b')", soci::into(sum);
    EXPECT_EQ(sum, 6);
}

TEST(PostgresqlStore, IsNotMixedWithAnother)
{
    const support::TemporaryFolder folder;
    const StorePlace place = support::storePlace(folder / "a");
    CaseStore{place};
    EXPECT_NO_THROW(CaseStore{place});
    EXPECT_THAT(messageOf([&] { CaseStore(StorePlace(folder / "b", place.database)); }),
                HasSubstr("belong to different stores"));
    EXPECT_THAT(messageOf([&] { CaseStore(folder / "a"); }), HasSubstr("set store.database"));
    CaseStore{StorePlace(folder / "own")};
    EXPECT_THAT(messageOf([&] { CaseStore(support::storePlace(folder / "own")); }), HasSubstr("its own vicon.db"));
}

TEST(PostgresqlStore, OfWhoseCasesTheDatabaseKnowsNothingIsNotMadeAnew)
{
    const support::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "a" / "cases" / "c1");
    const StorePlace place = support::storePlace(folder / "a");
    EXPECT_THAT(messageOf([&] { CaseStore{place}; }), HasSubstr("its database is gone or empty"));
    EXPECT_FALSE(place.holdsStore());
    std::filesystem::remove(folder / "a" / "cases" / "c1");
    EXPECT_NO_THROW(CaseStore{place});
}

TEST(PostgresqlStore, TakesNoPasswordThatIsShownAndNoAddressThatIsNone)
{
    const support::TemporaryFolder folder;
    const auto said = [&](const std::string& address) {
        return messageOf([&] { CaseStore(StorePlace(folder / "store", address)); });
    };
    EXPECT_THAT(said("postgresql://anna:secret@host/vicon"), AllOf(HasSubstr(".pgpass"), Not(HasSubstr("secret"))));
    EXPECT_THAT(said("postgresql://host/%zz"), HasSubstr("postgresql://USER@HOST"));
    EXPECT_THAT(said("mysql://host/vicon"), HasSubstr("no address"));
    EXPECT_FALSE(StorePlace(folder / "store").holdsStore());
}

TEST(PostgresqlServer, ThatDoesNotFlushIsFoundOut)
{
    FakeStore fake;
    EXPECT_THAT(fake.store.database().damage(), HasSubstr("fsync is off")) << "tests run faster so";
}

TEST(PostgresqlQueue, IsClaimedFromWhileAReportIsBeingSigned)
{
    FakeStore fake;
    fake.addJobs(1);
    CaseStore reader(fake.store.place());
    reader.database().write([&](soci::session&) {
        EXPECT_TRUE(JobQueue(fake.store.database(), {}).claim("a")) << "it does not wait for the other's lock";
    });
}

TEST(PostgresqlQueue, MakesNoClaimWaitForAnother)
{
    FakeStore fake;
    fake.addJobs(2);
    Database other(fake.store.database().where());
    other.writeRows([&](soci::session& sql) {
        sql << "UPDATE jobs SET fence = fence WHERE scan_id = 's0'";
        EXPECT_EQ(JobQueue(fake.store.database(), {}).claim("a")->scan_id, "s1");
    });
}

/// As whatever starts workers does: one that finds no server is started again.
std::unique_ptr<Database> openAgainAndAgain(const std::string& where)
{
    std::unique_ptr<Database> database;
    support::waitUntil([&] {
        try {
            database = std::make_unique<Database>(where);
        } catch (const Error&) {
        }
        return database != nullptr;
    });
    return database;
}

/// A worker's process, which does jobs until none is left; of each job it leaves a line in a file.
pid_t startWorker(const StorePlace& place, const fs::path& done)
{
    const pid_t child = ::fork();
    if (child != 0)
        return child;
    try {
        const auto database = openAgainAndAgain(place.database);
        JobQueue queue(*database, {.lease_s = 2});
        while (true)
            try {
                const auto job = queue.claim(thisOwner());
                if (!job && !queue.nextDue())
                    ::_exit(0);
                if (!job)
                    continue;
                queue.renew(*job, "step", 0.5);
                const auto publish = [&] {
                    replaceFile(done / (job->scan_id + "-" + std::to_string(job->fence)), "done");
                };
                queue.commitStep(*job, {.step = "step", .version = 1, .digest = "d"}, publish);
                queue.complete(*job);
            } catch (const Error& e) {
                if (e.code() != ErrorCode::lease_lost)
                    throw;
            }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
    }
    ::_exit(1);
}

TEST(PostgresqlQueue, LosesNoJobOfManyProcessesThatAreKilledWhileTheServerIsStartedAnew)
{
    FakeStore fake;
    constexpr int kJobs = 60, kWorkers = 4;
    fake.addJobs(kJobs);
    const fs::path done = fake.folder / "done";
    makePrivateFolder(done);
    std::vector<pid_t> workers;
    for (int n = 0; n < kWorkers; ++n)
        workers.push_back(startWorker(fake.store.place(), done));
    const auto finished = [&] {
        int count = 0;
        fake.store.database().session() << "SELECT COUNT(*) FROM jobs WHERE state = 'done'", soci::into(count);
        return count;
    };
    for (int n = 1; n <= 4; ++n) {
        ASSERT_TRUE(support::waitUntil([&] { return finished() >= n * kJobs / 6; }));
        ::kill(workers.front(), SIGKILL);
        ::waitpid(workers.front(), nullptr, 0);
        workers.erase(workers.begin());
        tellServer(n % 2 ? "restart -m immediate" : "restart -m fast");
        workers.push_back(startWorker(fake.store.place(), done));
    }
    for (const pid_t worker : workers) {
        int status = 0;
        ::waitpid(worker, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "a worker gave up";
    }
    EXPECT_EQ(finished(), kJobs);
    std::set<std::string> scans;
    for (const auto& entry : fs::directory_iterator(done)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("s"))  // others are of workers killed while they wrote
            scans.insert(name.substr(0, name.find('-')));
    }
    EXPECT_EQ(int(scans.size()), kJobs);
}

}  // namespace
}  // namespace vicon
