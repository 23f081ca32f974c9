#include <arpa/inet.h>
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/scu.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <list>
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
                    std::function<void(const std::vector<fs::path>&)> also = {}, std::set<std::string> not_taken = {})
        : not_taken_(std::move(not_taken)),
          receiver_(with(options), incoming,
                    {.on_received =
                         [this, also](const std::vector<fs::path>& files) {
                             if (also)
                                 also(files);
                             return take(files);
                         },
                     .on_trouble = [this](const std::string& what) { note(troubles_, what); },
                     .on_note = [this](const std::string& what) { note(notes_, what); }}),
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
    /// Whether a trouble or a note with these words comes.
    bool tells(const std::string& words)
    {
        const auto said = [&](const std::string& line) { return line.find(words) != std::string::npos; };
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, kPatience, [&] {
            return std::any_of(troubles_.begin(), troubles_.end(), said) ||
                   std::any_of(notes_.begin(), notes_.end(), said);
        });
    }
    int calls()
    {
        const std::lock_guard lock(mutex_);
        return calls_;
    }

private:
    static ingest::ReceiverOptions with(ingest::ReceiverOptions options)
    {
        options.port = 0;
        if (options.quiet_s == ingest::ReceiverOptions{}.quiet_s)
            options.quiet_s = 0;
        return options;
    }
    std::vector<fs::path> take(const std::vector<fs::path>& files)
    {
        const std::lock_guard lock(mutex_);
        std::vector<fs::path> left;
        for (const fs::path& file : files) {
            contents_.push_back(readFile(file));
            if (not_taken_.contains(contents_.back()))
                left.push_back(file);
        }
        ++calls_;
        changed_.notify_all();
        return left;
    }
    void note(std::vector<std::string>& list, const std::string& what)
    {
        const std::lock_guard lock(mutex_);
        list.push_back(what);
        changed_.notify_all();
    }
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> contents_, troubles_, notes_;
    std::set<std::string> not_taken_;
    int calls_ = 0;
    std::atomic<bool> stop_ = false;
    ingest::Receiver receiver_;
    std::thread thread_;
};

ingest::Receiver::Files nothingLeft(const ingest::Receiver::Files&)
{
    return {};
}

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
    EXPECT_THROW(ingest::Receiver({}, incoming, {nothingLeft}), Error) << "one receiver a store";
    ingest::ReceiverOptions same_port;
    same_port.port = receiver.port();
    EXPECT_THROW(ingest::Receiver(same_port, folder / "other", {nothingLeft}), Error);
    ingest::ReceiverOptions long_title;
    long_title.port = 0;
    long_title.ae_title = "A TITLE OF MORE THAN 16";
    EXPECT_THROW(ingest::Receiver(long_title, folder / "third", {nothingLeft}), Error);
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

/// A bare connection to a receiver.
class Connection {
public:
    explicit Connection(int port, const std::string& address = "127.0.0.1") : socket_(::socket(AF_INET, SOCK_STREAM, 0))
    {
        sockaddr_in endpoint{};
        endpoint.sin_family = AF_INET;
        endpoint.sin_port = htons(std::uint16_t(port));
        ::inet_pton(AF_INET, address.c_str(), &endpoint.sin_addr);
        connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&endpoint), sizeof endpoint) == 0;
    }
    ~Connection() { ::close(socket_); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    bool connected() const { return connected_; }
    void send(const std::string& bytes) const
    {
        EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), ssize_t(bytes.size()));
    }
    /// Waits for the other side to end it.
    bool isEnded() const
    {
        const timeval patience{60, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        char byte = 0;
        return ::recv(socket_, &byte, 1, 0) <= 0 && errno != EAGAIN;
    }

private:
    int socket_;
    bool connected_ = false;
};

/// The head of an association request of 200 bytes.
const std::string kRequestHead{"\x01\x00\x00\x00\x00\xc8", 6};

/// An association that is open and says nothing.
struct IdleAssociation {
    DcmSCU scu;
    explicit IdleAssociation(int port)
    {
        scu.setPeerHostName("127.0.0.1");
        scu.setPeerPort(Uint16(port));
        OFList<OFString> syntaxes;
        syntaxes.push_back(UID_LittleEndianExplicitTransferSyntax);
        scu.addPresentationContext(UID_CTImageStorage, syntaxes);
        scu.addPresentationContext(UID_VerificationSOPClass, syntaxes);
        EXPECT_TRUE(scu.initNetwork().good());
        EXPECT_TRUE(scu.negotiateAssociation().good());
    }
};

/// Tries again as a peer does that is told to come later.
bool answersEcho(const RunningReceiver& receiver)
{
    for (int n = 0; n < 100; ++n) {
        try {
            ingest::echo(receiver.peer(), "SENDER");
            return true;
        } catch (const Error&) {
            std::this_thread::sleep_for(50ms);
        }
    }
    return false;
}

TEST_F(Network, SilentPartialAndTricklingRequestsKeepNobodyWaiting)
{
    ingest::ReceiverOptions options;
    options.max_half_open = 16;
    RunningReceiver receiver(incoming, options);
    std::list<Connection> others;
    for (int n = 0; n < 40; ++n) {
        const Connection& other = others.emplace_back(receiver.port());
        if (n % 2 == 1)
            other.send(kRequestHead + std::string(std::size_t(n), 'x'));
    }
    EXPECT_NO_THROW(ingest::echo(receiver.peer(), "SENDER"));
    EXPECT_TRUE(others.front().isEnded()) << "the oldest of too many goes";
}

TEST_F(Network, ARequestThatDoesNotComeInTimeIsEndedAndSaid)
{
    ingest::ReceiverOptions options;
    options.request_s = 1;
    RunningReceiver receiver(incoming, options);
    const Connection silent(receiver.port()), partial(receiver.port());
    partial.send(kRequestHead);
    EXPECT_TRUE(silent.isEnded());
    EXPECT_TRUE(partial.isEnded());
    EXPECT_TRUE(receiver.tells("127.0.0.1 made no association request in time"));
}

TEST_F(Network, IdleAssociationsGiveWayToAPeerThatSends)
{
    ingest::ReceiverOptions options;
    options.max_associations = 2;
    options.idle_s = 0.2;
    RunningReceiver receiver(incoming, options);
    const IdleAssociation first(receiver.port()), second(receiver.port());
    EXPECT_TRUE(answersEcho(receiver));
}

TEST_F(Network, TooManyAssociationsAreRefusedAndSaidWithTheSender)
{
    ingest::ReceiverOptions options;
    options.max_per_host = 1;
    options.idle_s = 3600;
    RunningReceiver receiver(incoming, options);
    const IdleAssociation first(receiver.port());
    EXPECT_THROW(ingest::echo(receiver.peer(), "LATECOMER"), Error);
    EXPECT_TRUE(receiver.tells("refused 'LATECOMER' at 127.0.0.1: too many associations"));
}

TEST_F(Network, AnAssociationThatSendsNextToNothingIsEnded)
{
    ingest::ReceiverOptions options;
    options.timeout_s = 1;
    RunningReceiver receiver(incoming, options);
    IdleAssociation trickling(receiver.port());
    bool alive = true;
    for (int n = 0; n < 600 && alive; ++n) {  // an echo now and then is less than any image
        alive = trickling.scu.sendECHORequest(0).good();
        std::this_thread::sleep_for(100ms);
    }
    EXPECT_FALSE(alive);
    EXPECT_TRUE(receiver.tells("next to nothing"));
}

TEST_F(Network, OnlyWhoIsAllowedMayCallAndTheRefusalNamesTheSender)
{
    ingest::ReceiverOptions options;
    options.allow = "SCANNER@localhost, @10.1.2.3, PACS@10.1.2.4";
    RunningReceiver receiver(incoming, options);
    EXPECT_NO_THROW(ingest::echo(receiver.peer(), "SCANNER"));
    for (const char* title : {"STRANGER", "PACS"}) {
        EXPECT_THROW(ingest::echo(receiver.peer(), title), Error);
        EXPECT_TRUE(receiver.tells("refused '" + std::string(title) + "' at 127.0.0.1: receive.allow"));
    }
    EXPECT_TRUE(receiver.tells("association of 'SCANNER' at 127.0.0.1"));
    options.allow = "SCANNER@nowhere.invalid";
    EXPECT_THROW(ingest::Receiver(options, folder / "other", {nothingLeft}), Error);
}

TEST_F(Network, ListensOnThisMachineAloneUnlessAnAddressIsConfigured)
{
    RunningReceiver receiver(incoming, {});
    EXPECT_TRUE(Connection(receiver.port()).connected());
    EXPECT_FALSE(Connection(receiver.port(), "127.0.0.2").connected());
    ingest::ReceiverOptions everywhere;
    everywhere.address = "0.0.0.0";
    RunningReceiver open(folder / "open", everywhere);
    EXPECT_TRUE(Connection(open.port(), "127.0.0.2").connected());
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
        const auto sent = support::runCommand("storescu -xi 127.0.0.1 " + std::to_string(receiver.port()) + " +sd " +
                                              (folder / "in").string());
        ASSERT_EQ(sent.exit_code, 0) << sent.output;
        receiver.waitFor(files.size());
    }
    EXPECT_EQ(again.refused, 0) << lines(again);
    EXPECT_EQ(again.scans_unchanged, 1) << lines(again);
    EXPECT_TRUE(again.not_stored.empty());
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
        ::waitpid(child, nullptr, 0);
    }
    EXPECT_LT(starts, 20);
    EXPECT_EQ(filesIn(store.folder() / "quarantine"), 1u);
}

}  // namespace
