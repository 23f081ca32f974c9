#include <arpa/inet.h>
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/scu.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

#include "dicom_writer.h"
#include "orthanc.h"
#include "store_fixture.h"
#include "vicon/core/error.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using namespace std::chrono_literals;

namespace {

/// A receiver on a thread of its own, and what it handed over.
class RunningReceiver {
public:
    RunningReceiver(const fs::path& incoming, ingest::ReceiverOptions options,
                    std::function<void(const std::vector<fs::path>&)> also = {})
        : receiver_(
              with(options), incoming,
              [this, also](std::vector<fs::path> files) {
                  if (also)
                      also(files);
                  const std::lock_guard lock(mutex_);
                  for (const fs::path& file : files)
                      contents_.push_back(readFile(file));
                  ++calls_;
                  changed_.notify_all();
              },
              [this](const std::string& what) {
                  const std::lock_guard lock(mutex_);
                  troubles_.push_back(what);
              }),
          thread_([this] { receiver_.run(stop_); })
    {
    }
    ~RunningReceiver() { stop(); }
    void stop()
    {
        stop_ = true;
        if (thread_.joinable())
            thread_.join();
    }
    std::vector<std::string> waitFor(std::size_t count)
    {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, kPatience, [&] { return contents_.size() >= count; });
        return contents_;
    }
    int port() const { return receiver_.port(); }
    ingest::Peer peer() const { return {"receiver", "127.0.0.1", "VICON", port()}; }
    std::vector<std::string> troubles()
    {
        const std::lock_guard lock(mutex_);
        return troubles_;
    }

private:
    static ingest::ReceiverOptions with(ingest::ReceiverOptions options)
    {
        options.port = 0;
        return options;
    }
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> contents_, troubles_;
    int calls_ = 0;
    std::atomic<bool> stop_ = false;
    ingest::Receiver receiver_;
    std::thread thread_;
};

class Network : public StoreFixture {
protected:
    fs::path incoming = store.folder() / "incoming";
    std::size_t filesIn(const fs::path& where)
    {
        std::size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(where))
            count += entry.is_regular_file() && entry.path().extension() == ".dcm" ? 1 : 0;
        return count;
    }
};

TEST_F(Network, AStudySentByStorescuIsHandedOverAndImports)
{
    const auto files = writeSeries(folder / "in", {});
    std::atomic<int> stored = 0;
    RunningReceiver receiver(incoming, {}, [&](const std::vector<fs::path>& received) {
        CaseStore own(store.folder());
        stored = ingest::importPaths(own, received, options, quiet).scans_stored;
    });
    const auto echo = support::runCommand("echoscu 127.0.0.1 " + std::to_string(receiver.port()));
    EXPECT_EQ(echo.exit_code, 0) << echo.output;
    const auto sent = support::runCommand("storescu 127.0.0.1 " + std::to_string(receiver.port()) + " +sd " +
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

TEST_F(Network, AnOpenAssociationThatFallsSilentIsHandedOver)
{
    const auto files = writeSeries(folder / "in", {});
    ingest::ReceiverOptions options;
    options.idle_s = 0.3;
    RunningReceiver receiver(incoming, options);
    DcmSCU scu;
    scu.setPeerHostName("127.0.0.1");
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

TEST_F(Network, NoiseOnThePortDoesNotStopTheService)
{
    RunningReceiver receiver(incoming, {});
    for (int n = 0; n < 3; ++n) {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(std::uint16_t(receiver.port()));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        ASSERT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
        const std::string noise(n * 50, 'x');
        EXPECT_EQ(::send(socket, noise.data(), noise.size(), MSG_NOSIGNAL), ssize_t(noise.size()));
        ::close(socket);
    }
    EXPECT_NO_THROW(ingest::echo(receiver.peer(), "SENDER"));
}

TEST_F(Network, TitlesPortsAndSecondReceiversAreChecked)
{
    RunningReceiver receiver(incoming, {});
    EXPECT_THROW(ingest::Receiver({}, incoming, [](auto) {}), Error) << "one receiver a store";
    ingest::ReceiverOptions same_port;
    same_port.port = receiver.port();
    EXPECT_THROW(ingest::Receiver(same_port, folder / "other", [](auto) {}), Error);
    ingest::ReceiverOptions long_title;
    long_title.port = 0;
    long_title.ae_title = "A TITLE OF MORE THAN 16";
    EXPECT_THROW(ingest::Receiver(long_title, folder / "third", [](auto) {}), Error);
    EXPECT_THROW(ingest::echo({"gone", "127.0.0.1", "X", 1}, "SENDER"), Error);
}

TEST_F(Network, ATitleThatIsNotOursIsRefusedWhenAskedFor)
{
    ingest::ReceiverOptions strict;
    strict.any_called_title = false;
    RunningReceiver receiver(incoming, strict);
    EXPECT_NO_THROW(ingest::echo(receiver.peer(), "SENDER"));
    ingest::Peer wrong = receiver.peer();
    wrong.ae_title = "SOMEBODY";
    EXPECT_THROW(ingest::echo(wrong, "SENDER"), Error);
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

}  // namespace
