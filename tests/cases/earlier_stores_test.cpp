// A store that an earlier VICON made opens, holds what it held, and can be worked with.
#include <gmock/gmock.h>
#include <soci/soci.h>

#include "this_person.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/job_queue.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/report_versions.h"
#include "vicon/cases/worklist.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon {
namespace {

namespace fs = std::filesystem;

/// Makes a store of one that lies in stores/, as sqlite3 dumped it.
fs::path storeOf(const std::string& version, const fs::path& folder)
{
    makePrivateFolder(folder);
    const auto made =
        support::runCommand("sqlite3 " + (folder / "vicon.db").string() + " < " VICON_STORES "/" + version + ".sql");
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return folder;
}

class EarlierSqliteStore : public testing::TestWithParam<const char*> {
protected:
    support::TemporaryFolder folder_;
    CaseStore store_{storeOf(GetParam(), folder_ / "store")};
    const std::string id_ = store_.cases().at(0).id;
};

TEST_P(EarlierSqliteStore, HoldsWhatItHeld)
{
    int version = 0;
    store_.database().session() << "PRAGMA user_version", soci::into(version);
    EXPECT_EQ(version, Database::kSchemaVersion);
    EXPECT_EQ(store_.database().damage(), "");
    EXPECT_EQ(store_.requireCase(id_).patient.name, "Phantom^Seed3");
    const ScanRecord scan = store_.requireScan(id_, "");
    EXPECT_EQ(store_.instances(id_, scan.id).size(), 3u);
    EXPECT_EQ(store_.steps(id_, scan.id).size(), 7u);
    EXPECT_EQ(store_.markers(id_).at(0).note, "a note");
    EXPECT_EQ(findings(store_, id_).at(0).markers, std::vector<std::string>{"m1"});
    const auto versions = reportVersions(store_, id_);
    ASSERT_EQ(versions.size(), 1u);
    EXPECT_EQ(digestOf(versions[0].content, versions[0].file_sha256), versions[0].digest);
    EXPECT_FALSE(versions[0].objects) << "nobody kept their hashes then";
    EXPECT_NO_THROW(requireObjects(versions[0]));
    EXPECT_TRUE(reportStatus(store_, id_).amending);
    EXPECT_EQ(Outbox(store_.database(), {}).items(id_).at(0).state, DeliveryState::queued);
    EXPECT_EQ(auditTrail(store_, id_).front().event, "imported");
    EXPECT_EQ(makeWorklist(store_, {}).at(0).state, WorkState::done);
}

TEST_P(EarlierSqliteStore, CanBeWorkedWith)
{
    const ScanRecord scan = store_.requireScan(id_, "");
    store_.saveMarker(id_, {.scan_id = scan.id});
    EXPECT_EQ(store_.markers(id_).size(), 2u);
    JobQueue queue(store_.database(), {});
    queue.retry(id_, scan.id);
    queue.complete(*queue.claim(thisOwner()));
    cancelAmendment(store_, {.signers = {thisPerson()}}, id_);
    EXPECT_THROW(store_.database().write([](soci::session& sql) { sql << "DELETE FROM report_versions"; }),
                 std::exception);
    NoProgress quiet;
    deleteCase(store_, id_, true, "a test", quiet);
    EXPECT_TRUE(store_.cases().empty());
}

INSTANTIATE_TEST_SUITE_P(Versions, EarlierSqliteStore, testing::Values("0.1.0"));

}  // namespace
}  // namespace vicon
