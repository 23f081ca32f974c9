// What becomes of objects that were received.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/scu.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <set>
#include <thread>

#include "network_fixture.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"
#include "vicon/support/damaged_table.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using namespace std::chrono_literals;

namespace {

TEST_F(Network, AnOpenAssociationThatFallsSilentIsHandedOver)
{
    const auto files = writeSeries(folder / "in", {});
    ingest::ReceiverOptions options;
    options.idle_s = 0.3;
    RunningReceiver receiver(incoming, options);
    DcmSCU scu;
    scu.setPeerHostName("127.0.0.1");
    scu.setPeerAETitle("VICON");
    scu.setPeerPort(Uint16(receiver.port()));
    OFList<OFString> syntaxes;
    syntaxes.push_back(UID_LittleEndianExplicitTransferSyntax);
    scu.addPresentationContext(UID_CTImageStorage, syntaxes);
    ASSERT_TRUE(scu.initNetwork().good());
    ASSERT_TRUE(scu.negotiateAssociation().good());
    for (std::size_t n = 0; n < 3; ++n) {
        Uint16 status = 1;
        ASSERT_TRUE(scu.sendSTORERequest(0, files[n].c_str(), nullptr, status).good());
        EXPECT_EQ(status, 0);
        EXPECT_EQ(receiver.waitFor(n + 1).size(), n + 1);
    }
    const auto begin = std::chrono::steady_clock::now();
    receiver.stop();  // ends the open association rather than waiting for it
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 30s);
}

TEST_F(Network, WhatWasNotTakenIsHandedOverAgainAtTheNextStart)
{
    const auto files = writeSeries(folder / "in", {});
    {
        RunningReceiver receiver(incoming, {}, [](const auto&) { throw Error(ErrorCode::database, "no"); });
        ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
        receiver.stop();
        EXPECT_EQ(receiver.troubles().size(), 1u);
    }
    EXPECT_EQ(filesIn(incoming), 12u);
    std::ofstream(fs::directory_iterator(incoming)->path().parent_path() / "stray") << "x";
    RunningReceiver again(incoming, {});
    EXPECT_EQ(again.waitFor(12).size(), 12u);
    again.stop();
    EXPECT_EQ(filesIn(incoming), 0u);
}

TEST_F(Network, WaitingForTheStoreIsNoTrialOfAFile)
{
    const auto files = writeSeries(folder / "in", {}, {0});
    RunningReceiver receiver(incoming, {});
    {
        const StoreLock busy(store.folder(), quiet);
        ASSERT_TRUE(ingest::storeFiles(receiver.peer(), files, "SENDER", quiet).complete());
        EXPECT_TRUE(receiver.tells("received objects wait: waiting for another import"));
        EXPECT_FALSE(fs::exists(incoming / "being_taken.json"));
        EXPECT_EQ(receiver.calls(), 0);
    }
    EXPECT_EQ(receiver.waitFor(1).size(), 1u);
}

TEST_F(Network, OneAssociationAnImageIsOneHandOver)
{
    const auto files = writeSeries(folder / "in", {});
    ingest::ReceiverOptions options;
    options.quiet_s = 3600;
    RunningReceiver receiver(incoming, options);
    for (const fs::path& file : files)
        ASSERT_TRUE(ingest::storeFiles(receiver.peer(), {file}, "SENDER", quiet).complete());
    EXPECT_EQ(receiver.calls(), 0) << "the study may not be complete";
    receiver.stop();
    EXPECT_EQ(receiver.calls(), 1);
    EXPECT_EQ(receiver.waitFor(files.size()).size(), files.size());
}

TEST_F(Network, WhatNoCaseTakesIsKeptInQuarantine)
{
    const auto files = writeSeries(folder / "in", {});
    SeriesSpec localizer;
    localizer.series_uid += ".5";
    localizer.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
    const fs::path no_slice = writeSeries(folder / "scout", localizer, {0}).at(0);
    SeriesSpec other_pixels;
    other_pixels.densities = [](Point3 p) { return 9 * p.x; };
    const fs::path same_uid = writeSeries(folder / "clash", other_pixels, {3}).at(0);
    std::atomic<bool> stop = false;
    std::atomic<int> taken = 0;
    ingest::ReceiverOptions receive;
    receive.port = 0;
    receive.quiet_s = 0;
    ingest::Receiver receiver(receive, incoming, {[&](const ingest::Receiver::Files& received) {
                                  CaseStore own(store.folder());
                                  ++taken;
                                  return ingest::importPaths(own, received, options, quiet).not_stored;
                              }});
    std::thread thread([&] { receiver.run(stop); });
    const ingest::Peer peer{"receiver", "127.0.0.1", "VICON", receiver.port()};
    ASSERT_TRUE(ingest::storeFiles(peer, files, "S", quiet).complete());
    ASSERT_TRUE(ingest::storeFiles(peer, {no_slice, same_uid}, "S", quiet).complete());
    stop = true;
    thread.join();
    std::multiset<std::string> expected{datasetBytes(readFile(no_slice)), datasetBytes(readFile(same_uid))}, kept;
    for (const auto& entry : fs::recursive_directory_iterator(store.folder() / "quarantine"))
        if (entry.is_regular_file())
            kept.insert(datasetBytes(readFile(entry.path())));
    EXPECT_EQ(kept, expected);
    EXPECT_EQ(filesIn(incoming), 0u);
}

TEST_F(Network, WhatCouldNotBeTakenIsTriedAgainWhileTheReceiverRuns)
{
    const auto files = writeSeries(folder / "in", {});
    std::atomic<int> tries = 0;
    RunningReceiver receiver(incoming, {}, [&](const auto&) {
        if (++tries == 1)
            throw Error(ErrorCode::database, "locked");
    });
    ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
    EXPECT_EQ(receiver.waitFor(12).size(), 12u);
    receiver.stop();
    EXPECT_EQ(filesIn(incoming), 0u);
}

TEST_F(Network, WhatADamagedDatabaseDoesNotTakeWaitsUntilItIsMended)
{
    const auto files = writeSeries(folder / "in", {});
    const support::DamagedTable damaged(store.folder(), "cases");
    RunningReceiver receiver(incoming, {}, [&](const auto& received) {
        CaseStore own(store.folder());
        EXPECT_TRUE(ingest::importPaths(own, received, options, quiet).not_stored.empty());
    });
    ASSERT_TRUE(ingest::storeFiles(receiver.peer(), files, "SENDER", quiet).complete());
    EXPECT_TRUE(receiver.tells("12 received objects could not be taken and wait in incoming: "));
    EXPECT_TRUE(receiver.tells("the database is damaged; stop VICON"));
    for (const std::string& trouble : receiver.troubles())
        for (const char* patients : {"Doe", "P1", "19600101", "SELECT"})
            EXPECT_EQ(trouble.find(patients), std::string::npos) << trouble;
    EXPECT_EQ(filesIn(incoming), 12u);
    damaged.mend();
    EXPECT_EQ(receiver.waitFor(12).size(), 12u);
    receiver.stop();
    EXPECT_EQ(filesIn(incoming), 0u);
    CaseStore mended(store.folder());
    const ScanRecord scan = mended.scans(mended.cases().at(0).id).at(0);
    EXPECT_EQ(mended.instances(scan.case_id, scan.id).size(), 12u);
}

TEST_F(Network, OneBadObjectDoesNotStrandItsCompanions)
{
    const auto files = writeSeries(folder / "in", {});
    const std::string bad = datasetBytes(readFile(files[7]));
    RunningReceiver receiver(incoming, {}, [&](const std::vector<fs::path>& received) {
        for (const fs::path& file : received)
            if (datasetBytes(readFile(file)) == bad)
                throw std::runtime_error("a reader's fault");
    });
    ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
    EXPECT_EQ(receiver.waitFor(11).size(), 11u);
    EXPECT_TRUE(receiver.tells("put into quarantine")) << "the bad one is kept, and said";
    receiver.stop();
    EXPECT_EQ(filesIn(incoming), 0u);
    EXPECT_EQ(filesIn(store.folder() / "quarantine"), 1u);
}

TEST_F(Network, AFileThatKillsItsReaderIsFoundAndSetAside)
{
    const auto files = writeSeries(folder / "in", {});
    fs::create_directories(incoming / "20260101-1-0");
    for (const fs::path& file : files)
        fs::copy_file(file, incoming / "20260101-1-0" / file.filename());
    const std::string bad = "20260101-1-0/" + files[7].filename().string();
    int starts = 0;
    for (; filesIn(incoming) > 0 && starts < 20; ++starts) {  // a child dies whenever it reads that file
        const pid_t child = ::fork();
        if (child == 0) {
            std::atomic<bool> stop = true;
            ingest::ReceiverOptions receive;
            receive.port = 0;
            ingest::Receiver receiver(receive, incoming, {[&](const ingest::Receiver::Files& received) {
                                          for (const fs::path& file : received)
                                              if (file == incoming / bad)
                                                  ::_exit(1);
                                          return ingest::Receiver::Files{};
                                      }});
            receiver.run(stop);
            ::_exit(0);
        }
        int how = 0;
        ::waitpid(child, &how, 0);
        if (WEXITSTATUS(how) != 0) {
            EXPECT_EQ(support::schemaFaults("being_taken", {incoming / "being_taken.json"}), "");
        }
    }
    EXPECT_LT(starts, 20);
    EXPECT_EQ(filesIn(store.folder() / "quarantine"), 1u);
}

}  // namespace
