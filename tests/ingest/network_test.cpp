// Objects that are sent and received, by VICON and by others.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/scu.h>

#include <atomic>
#include <fstream>
#include <mutex>
#include <set>

#include "network_fixture.h"
#include "orthanc.h"
#include "vicon/core/error.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;

namespace {

TEST_F(Network, AFileWithBytesBehindItsEndIsSentWithoutThem)
{
    const auto files = writeSeries(folder / "in", {}, {0, 1});
    const std::string whole = datasetBytes(readFile(files[0]));
    std::ofstream(files[0], std::ios::binary | std::ios::app) << "a note of the archive";
    RunningReceiver receiver(incoming, {});
    const ingest::SendResult result = ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
    EXPECT_TRUE(result.complete());
    std::multiset<std::string> received;
    for (const std::string& content : receiver.waitFor(files.size()))
        received.insert(datasetBytes(content));
    EXPECT_TRUE(received.contains(whole));
}

TEST_F(Network, AStudySentByStorescuIsHandedOverAndImports)
{
    const auto files = writeSeries(folder / "in", {});
    std::atomic<int> stored = 0;
    RunningReceiver receiver(incoming, {}, [&](const std::vector<fs::path>& received) {
        CaseStore own(store.folder());
        stored = ingest::importPaths(own, received, options, quiet).scans_stored;
    });
    const auto echo = support::runCommand("echoscu -aec VICON 127.0.0.1 " + std::to_string(receiver.port()));
    EXPECT_EQ(echo.exit_code, 0) << echo.output;
    const auto sent = support::runCommand("storescu -aec VICON 127.0.0.1 " + std::to_string(receiver.port()) + " +sd " +
                                          (folder / "in").string());
    ASSERT_EQ(sent.exit_code, 0) << sent.output;
    std::multiset<std::string> expected, received;
    for (const fs::path& file : files)
        expected.insert(datasetBytes(readFile(file)));
    for (const std::string& content : receiver.waitFor(files.size()))
        received.insert(datasetBytes(content));
    EXPECT_EQ(received, expected);
    EXPECT_EQ(stored, 1);
    receiver.stop();
    EXPECT_EQ(filesIn(incoming), 0u);
    EXPECT_EQ(load(onlyScan()).grid.size[2], 12);
    EXPECT_EQ(onlyScan().ingest.value(kIngestSender, ""), "STORESCU") << "whose turn it is in the queue";
}

TEST_F(Network, EveryEncodingArrivesAsItIs)
{
    VICON_NEEDS_DATA("dicom/syntaxes");
    RunningReceiver receiver(incoming, {});
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(support::sharedData("dicom/syntaxes")))
        if (entry.path().extension() == ".dcm")
            files.push_back(entry.path());
    const auto result = ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
    EXPECT_EQ(result.sent, 16);
    for (const auto& failure : result.failures)
        ADD_FAILURE() << failure.file << ": " << failure.reason;
    const auto contents = receiver.waitFor(files.size());
    ASSERT_EQ(contents.size(), files.size());
    std::multiset<std::string> sent, received;
    for (const fs::path& file : files)
        sent.insert(fingerprint(readFile(file)));
    for (const std::string& content : contents)
        received.insert(fingerprint(content));
    EXPECT_EQ(received, sent);
}

TEST_F(Network, EveryStorageClassIsTaken)
{
    RunningReceiver receiver(incoming, {});
    OFList<OFString> syntaxes;
    syntaxes.push_back(UID_LittleEndianImplicitTransferSyntax);
    int taken = 0;
    constexpr int kAtOnce = 100;
    for (int from = 0; from < numberOfDcmAllStorageSOPClassUIDs; from += kAtOnce) {
        DcmSCU scu;
        scu.setPeerHostName("127.0.0.1");
        scu.setPeerAETitle("VICON");
        scu.setPeerPort(Uint16(receiver.port()));
        const int to = std::min(from + kAtOnce, numberOfDcmAllStorageSOPClassUIDs);
        for (int n = from; n < to; ++n)
            scu.addPresentationContext(dcmAllStorageSOPClassUIDs[n], syntaxes);
        ASSERT_TRUE(scu.initNetwork().good());
        ASSERT_TRUE(scu.negotiateAssociation().good());
        for (int n = from; n < to; ++n)
            taken += scu.findPresentationContextID(dcmAllStorageSOPClassUIDs[n], "") != 0 ? 1 : 0;
        scu.releaseAssociation();
    }
    EXPECT_EQ(taken, numberOfDcmAllStorageSOPClassUIDs);
    EXPECT_GT(taken, 128) << "more than an association has contexts";
}

TEST_F(Network, AnObjectLiesInTheStoreBeforeItsSuccessIsAnswered)
{
    const auto files = writeSeries(folder / "in", {});
    std::mutex held;
    held.lock();  // nothing is taken over while the sender looks
    RunningReceiver receiver(incoming, {}, [&](const auto&) { const std::lock_guard wait(held); });
    const auto result = ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
    EXPECT_EQ(result.sent, 12);
    EXPECT_EQ(filesIn(incoming), 12u);
    held.unlock();
    EXPECT_EQ(receiver.waitFor(12).size(), 12u);
}

TEST_F(Network, AFileThatIsNoObjectIsAFailureOfItsOwn)
{
    const auto files = writeSeries(folder / "in", {});
    std::ofstream(folder / "in/text.txt") << "hello";
    RunningReceiver receiver(incoming, {});
    const auto result = ingest::storeFiles(receiver.peer(), {files[0], folder / "in/text.txt", files[1]}, "S", quiet);
    EXPECT_EQ(result.sent, 2);
    ASSERT_EQ(result.failures.size(), 1u);
    EXPECT_EQ(result.failures[0].file, folder / "in/text.txt");
}

TEST_F(Network, OrthancKeepsWhatIsSentElementByElement)
{
    auto files = writeSeries(folder / "in", {});
    if (fs::exists(support::sharedData("dicom/syntaxes")))
        for (const char* name : {"CTImage.dcm_JPEG2000LosslessOnlyTransferSyntax_1.2.840.10008.1.2.4.90.dcm",
                                 "CTImage.dcm_JPEGLSLossyTransferSyntax_1.2.840.10008.1.2.4.81.dcm"})
            files.push_back(support::sharedData("dicom/syntaxes") / name);
    const Orthanc orthanc(folder / "orthanc");
    ASSERT_TRUE(orthanc.answers()) << readFile(folder / "orthanc/log");
    const auto result = ingest::storeFiles(orthanc.peer(), files, "VICON", quiet);
    for (const auto& failure : result.failures)
        ADD_FAILURE() << failure.file << ": " << failure.reason;
    EXPECT_EQ(result.sent, int(files.size()));
    std::multiset<std::string> sent, kept;
    for (const fs::path& file : files)
        sent.insert(fingerprint(readFile(file)));
    for (const auto& id : nlohmann::json::parse(orthanc.get("/instances")))
        kept.insert(fingerprint(orthanc.get("/instances/" + id.get<std::string>() + "/file")));
    EXPECT_EQ(kept, sent);
}

TEST_F(Network, TheSameObjectsFromDiscAndThenByStoreAreTheSame)
{
    const auto files = writeSeries(folder / "in", {});
    ASSERT_EQ(import({folder / "in"}).scans_stored, 1);
    ingest::ImportReport again;
    {
        RunningReceiver receiver(incoming, {}, [&](const std::vector<fs::path>& received) {
            CaseStore own(store.folder());
            again = ingest::importPaths(own, received, options, quiet);
        });
        const auto sent = support::runCommand("storescu -xi -aec VICON 127.0.0.1 " + std::to_string(receiver.port()) +
                                              " +sd " + (folder / "in").string());
        ASSERT_EQ(sent.exit_code, 0) << sent.output;
        receiver.waitFor(files.size());
    }
    EXPECT_EQ(again.refused, 0) << lines(again);
    EXPECT_EQ(again.scans_unchanged, 1) << lines(again);
    EXPECT_TRUE(again.not_stored.empty());
}

TEST_F(Network, AStoreThatIsGoneTakesNothing)
{
    const auto files = writeSeries(folder / "in", {});
    RunningReceiver receiver(incoming, {});
    fs::remove_all(store.folder());
    const auto result = ingest::storeFiles(receiver.peer(), files, "SENDER", quiet);
    EXPECT_EQ(result.sent, 0);
    ASSERT_EQ(result.failures.size(), files.size());
    EXPECT_NE(result.failures[0].reason.find("a700"), std::string::npos) << result.failures[0].reason;
    EXPECT_TRUE(receiver.tells("the store is gone"));
    EXPECT_FALSE(fs::exists(store.folder()));
}

}  // namespace
