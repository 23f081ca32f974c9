// What was received is in a case or waits for it, whenever the line to the server breaks.
#include "dicom_writer.h"
#include "postgresql_proxy.h"
#include "running_receiver.h"
#include "vicon/core/file.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/sender.h"
#include "vicon/support/store_place.h"

namespace fs = std::filesystem;

namespace vicon::test {
namespace {

/// Where the line is cut, and how many times in a row.
struct Cut {
    const char* before;
    int times;
};

class CutImport : public testing::TestWithParam<Cut> {
protected:
    support::TemporaryFolder folder_;
    StorePlace direct_ = support::storePlace(folder_ / "store");
    std::string serverFolder() const
    {
        const auto from = direct_.database.find("host=") + 5;
        return direct_.database.substr(from, direct_.database.find('&', from) - from);
    }
    PostgresqlProxy proxy_{folder_.path(), serverFolder()};
    StorePlace through_{direct_.folder, std::string(direct_.database)
                                            .replace(direct_.database.find(serverFolder()), serverFolder().size(),
                                                     folder_.path().string())};
    NoProgress quiet_;
};

TEST_P(CutImport, LosesNothingThatWasAcknowledged)
{
    CaseStore store(through_);
    const auto files = writeSeries(folder_ / "in", {});
    RunningReceiver receiver(store.folder() / "incoming", {}, [&](const std::vector<fs::path>& received) {
        EXPECT_TRUE(ingest::importPaths(store, received, {}, quiet_).not_stored.empty());
    });
    proxy_.cutBefore(GetParam().before, GetParam().times);
    ASSERT_TRUE(ingest::storeFiles(receiver.peer(), files, "SENDER", quiet_).complete());
    EXPECT_EQ(receiver.waitFor(files.size()).size(), files.size());
    receiver.stop();
    EXPECT_EQ(proxy_.cuts(), GetParam().times);
    CaseStore seen(direct_);
    const auto scans = seen.scans(seen.cases().at(0).id);
    EXPECT_EQ(seen.instances(scans.at(0).case_id, scans.at(0).id).size(), files.size());
    EXPECT_FALSE(fs::exists(store.folder() / "quarantine"));
}

INSTANTIATE_TEST_SUITE_P(WhileItReadsAndWrites, CutImport,
                         testing::Values(Cut{"FROM cases WHERE study_uid", 1}, Cut{"FROM scans WHERE case_id", 1},
                                         Cut{"FROM instances WHERE sop_uid", 1}, Cut{"INSERT INTO scans", 1},
                                         Cut{"COMMIT", 1}, Cut{"BEGIN", 2}),
                         [](const auto& info) { return "Cut" + std::to_string(info.index); });

}  // namespace
}  // namespace vicon::test
