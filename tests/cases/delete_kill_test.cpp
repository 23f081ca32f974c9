// Killed while it deletes a case: the case is there as it was, or nothing of it is.
#include <gtest/gtest.h>
#include <signal.h>
#include <soci/soci.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "case_tables.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/store_place.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;
using namespace vicon;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

namespace {

constexpr int kObjects = 50;
const int kKills = support::inFull() ? 1000 : 10;

class KilledDeletion : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    CaseStore store_{support::storePlace(folder_ / "store")};
    NoProgress quiet_;
    int cases_ = 0;

    /// A case with objects, one in quarantine, and an earlier report of its patient.
    std::string makeCase()
    {
        CaseRecord c;
        c.id = "c" + std::to_string(++cases_);
        c.study.uid = "1.2." + std::to_string(cases_);
        c.patient.id = "P" + std::to_string(cases_);
        ScanRecord scan;
        scan.id = "s1";
        scan.case_id = c.id;
        const fs::path dicom = store_.scanFolder(c.id, scan.id) / "dicom";
        makePrivateFolder(dicom);
        std::vector<InstanceRecord> instances;
        for (int n = 0; n < kObjects; ++n) {
            const std::string name = std::to_string(n) + ".dcm";
            std::ofstream(dicom / name) << name;
            instances.push_back({c.study.uid + "." + name, c.id, scan.id, sha256(name), name});
        }
        store_.addScan(c, scan, instances, false);
        makePrivateFolder(store_.folder() / "quarantine" / c.id);
        std::ofstream(store_.folder() / "quarantine" / c.id / "x.dcm") << "x";
        makePrivateFolder(keptReportsFolder(store_));
        std::ofstream(keptReportsFolder(store_) / c.id) << "a report";
        KeptReport report{.sop_uid = c.study.uid + ".9", .sha256 = sha256("a report"), .file = c.id};
        report.patient.id = c.patient.id;
        keepReport(store_, report);
        return c.id;
    }
    std::size_t filesOf(const std::string& id) const
    {
        std::size_t count = 0;
        for (const fs::path& place : {store_.caseFolder(id), store_.folder() / "quarantine" / id})
            if (fs::exists(place))
                for (const auto& entry : fs::recursive_directory_iterator(place))
                    count += entry.is_regular_file() ? 1 : 0;
        return count + (fs::exists(keptReportsFolder(store_) / id) ? 1 : 0);
    }
    int rowsOf(const std::string& id)
    {
        int all = 0;
        const auto add = [&](const std::string& from) {
            int rows = 0;
            store_.database().session() << "SELECT COUNT(*) FROM " + from, soci::use(id), soci::into(rows);
            all += rows;
        };
        for (const char* table : kCaseTables)
            add(std::string(table) + " WHERE case_id = :c");
        add("cases WHERE id = :c");
        add("kept_reports WHERE file = :c");
        return all;
    }
    pid_t deleteInChild(const std::string& id)
    {
        const pid_t child = ::fork();
        if (child == 0) {
            try {
                CaseStore own(store_.place());
                deleteCase(own, id, true, "a test", quiet_);
            } catch (...) {
                ::_exit(1);
            }
            ::_exit(0);
        }
        return child;
    }
    /// How long a deletion in a child takes here that nobody kills: disks differ by a factor of a hundred.
    Seconds deletionLasts()
    {
        std::array<Seconds, 3> lasted;
        for (Seconds& one : lasted) {
            const std::string id = makeCase();
            const auto begin = Clock::now();
            int status = 0;
            ::waitpid(deleteInChild(id), &status, 0);
            one = Clock::now() - begin;
            EXPECT_EQ(status, 0);
        }
        return *std::min_element(lasted.begin(), lasted.end());
    }
    /// Deletes in a child that is killed after a while. Returns whether it was still at work.
    bool deleteAndKill(const std::string& id, Seconds after)
    {
        const pid_t child = deleteInChild(id);
        // The moment of the kill is what is tried.
        std::this_thread::sleep_for(after);
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) != 0);
        return WIFSIGNALED(status);
    }
};

TEST_F(KilledDeletion, LeavesTheCaseOrNothing)
{
    const std::string whole = makeCase();
    const std::size_t files = filesOf(whole);
    const int rows = rowsOf(whole);
    deleteCase(store_, whole, true, "a test", quiet_);
    const auto whole_deletion = deletionLasts();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> moment(0, 1.2);
    int at_work = 0, gone = 0;
    for (int round = 0; round < kKills; ++round) {
        const std::string id = makeCase();
        at_work += deleteAndKill(id, moment(random) * whole_deletion);
        {
            const StoreLock lock(store_.folder(), quiet_);
            finishDeletions(store_, lock);
        }
        ASSERT_FALSE(hasBegunDeletions(store_)) << "round " << round;
        if (store_.findCase(id)) {
            ASSERT_EQ(filesOf(id), files) << "round " << round;
            ASSERT_EQ(rowsOf(id), rows) << "round " << round;
            deleteCase(store_, id, true, "the end of a round", quiet_);
        } else {
            ++gone;
        }
        ASSERT_EQ(filesOf(id), 0u) << "round " << round;
        ASSERT_EQ(rowsOf(id), 0) << "round " << round;
    }
    std::printf("%d deletions killed, %d of them at work, %d cases gone\n", kKills, at_work, gone);
    EXPECT_GT(at_work, kKills / 4) << "else the kills come too late to show anything";
}

}  // namespace
