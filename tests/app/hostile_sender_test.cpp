// What hostile senders do on the wire to 'vicon receive', each once and by hand; the fuzzer does the rest.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <set>

#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"
#include "wire.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

namespace wire = test::wire;
using wire::bigEndian, wire::element, wire::fragment, wire::littleEndian, wire::pdu;

const std::string kCt = "1.2.840.10008.5.1.4.1.1.2";

std::string storeCommand(const std::string& sop_uid)
{
    const std::string fields = element(0, 2, kCt) + element(0, 0x100, littleEndian(1, 2)) +
                               element(0, 0x110, littleEndian(1, 2)) + element(0, 0x700, littleEndian(0, 2)) +
                               element(0, 0x800, littleEndian(1, 2)) + element(0, 0x1000, sop_uid);
    return fragment(true, wire::command(fields));
}

std::string image(const std::string& sop_uid, const std::string& study_uid, const std::string& name)
{
    return element(8, 0x16, kCt) + element(8, 0x18, sop_uid) + element(8, 0x60, "CT") + element(0x10, 0x10, name) +
           element(0x10, 0x20, "H1") + element(0x20, 0xd, study_uid) +
           element(0x20, 0xe, "1.2.826.0.1.3680043.10.9.2") + element(0x28, 0x10, littleEndian(8, 2)) +
           element(0x28, 0x11, littleEndian(8, 2)) + element(0x7fe0, 0x10, std::string(128, '\0'));
}

/// A connection on which anything is said.
class Wire {
public:
    explicit Wire(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
    {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(std::uint16_t(port));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
        const timeval patience{60, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    }
    ~Wire() { ::close(socket_); }
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;

    void say(const std::string& bytes) const { (void)::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
    /// The kind of the PDU that comes next; 0: the connection was ended.
    int hear() const
    {
        const std::string head = take(6);
        if (head.size() < 6)
            return 0;
        std::size_t length = 0;
        for (const char byte : head.substr(2))
            length = length << 8U | std::uint8_t(byte);
        take(length);
        return std::uint8_t(head[0]);
    }
    void associate(const std::string& sop_class = kCt, const std::string& syntax = wire::kImplicit) const
    {
        say(wire::request(sop_class, syntax));
        EXPECT_EQ(hear(), 2) << "no association";
    }
    bool isEnded() const
    {
        while (const int kind = hear())
            if (kind != 7)  // an abort is followed by the end
                return false;
        return true;
    }

private:
    std::string take(std::size_t count) const
    {
        std::string bytes(count, '\0');
        const ssize_t came = ::recv(socket_, bytes.data(), count, MSG_WAITALL);
        bytes.resize(std::size_t(std::max<ssize_t>(came, 0)));
        return bytes;
    }
    int socket_;
};

class HostileSender : public testing::Test {
protected:
    TemporaryFolder folder_;
    const fs::path store_ = folder_ / "store";
    const RunningListener listener_{store_,
                                    "--set receive.quiet_s=0 --set receive.idle_s=0.5 --set receive.timeout_s=5"};
    const std::vector<fs::path> files_ = test::writeSeries(folder_ / "in", {});

    void SetUp() override { ASSERT_TRUE(listener_.answers()); }
    int port() const { return listener_.peer().port; }
    /// Beside whatever is still open.
    void expectThatAnHonestSenderGetsIn() const
    {
        NoProgress quiet;
        const auto begin = std::chrono::steady_clock::now();
        EXPECT_TRUE(ingest::storeFiles(listener_.peer(), files_, "HONEST", quiet).complete());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        std::printf("an honest sender's %zu objects were taken in %.2f s\n", files_.size(), took.count());
        if (inFull()) {
            EXPECT_LT(took.count(), 5);
        }
    }
    /// What lies beside the store, where a path with ../ would lead.
    std::set<std::string> outside() const
    {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path()))
            names.insert(entry.path().filename().string());
        return names;
    }
    bool logSays(const std::string& words) const
    {
        return waitUntil([&] { return listener_.log().find(words) != std::string::npos; });
    }
    /// Whether nothing is left of what came, half or whole; while a folder goes away, not yet.
    bool allIsTaken() const
    {
        std::error_code gone;
        for (fs::recursive_directory_iterator at(store_ / "incoming", gone), end; !gone && at != end;
             at.increment(gone)) {
            const fs::path name = at->path().filename();
            if (name.extension() == ".dcm" || name.string().starts_with("."))
                return false;
        }
        return !gone;
    }
};

TEST_F(HostileSender, APduOf4GiBIsNeitherAwaitedNorHeld)
{
    const Wire first(port()), second(port()), third(port());
    first.say("\1\0\xff\xff\xff\xff\0\1\0\0"s);
    EXPECT_TRUE(first.isEnded());
    second.associate();
    second.say("\4\0\xff\xff\xff\xff"s + "\xff\xff\xff\xfa\1\3"s + std::string(1000, 'x'));
    third.associate();
    third.say(pdu(4, "\xff\xff\xff\xff\1\3"s + std::string(1000, 'x')));
    expectThatAnHonestSenderGetsIn();
    EXPECT_TRUE(second.isEnded());
    EXPECT_TRUE(third.isEnded());
    const auto peak = runCommand("grep VmHWM /proc/" + std::to_string(listener_.process()) + "/status");
    EXPECT_LT(std::stol(peak.output.substr(peak.output.find(':') + 1)), 500'000) << "kB: " << peak.output;
}

TEST_F(HostileSender, AUidThatIsAPathLeadsNowhere)
{
    const auto before = outside();
    for (const std::string& uid : {"../../../evil"s, "../../evil"s, "/tmp/vicon-evil"s, "1.2\0/../../../evil"s, "\0"s,
                                   "1.2.3\\../../../evil"s, "."s, ".."s}) {
        for (const std::string& study : {uid, "1.2.826.0.1.3680043.10.9"s}) {
            const Wire wire(port());
            wire.associate();
            wire.say(storeCommand(uid) + fragment(false, image(uid, study, "Doe^Jane")));
            wire.hear();  // taken or refused
        }
    }
    expectThatAnHonestSenderGetsIn();
    EXPECT_TRUE(waitUntil([&] { return allIsTaken(); }));
    EXPECT_EQ(outside(), before);
    EXPECT_FALSE(fs::exists("/tmp/vicon-evil"));
    for (const auto& entry : fs::directory_iterator(store_))
        EXPECT_THAT(entry.path().filename().string(), testing::Not(HasSubstr("evil")));
}

TEST_F(HostileSender, NamesOf300CharactersAreTakenOrRefused)
{
    const Wire of_patient(port()), of_object(port());
    of_patient.associate();
    const std::string uid = "1.2.826.0.1.3680043.10.9.4.1", study = "1.2.826.0.1.3680043.10.9.4";
    of_patient.say(storeCommand(uid) + fragment(false, image(uid, study, std::string(300, 'x'))));
    EXPECT_EQ(of_patient.hear(), 4) << "answered";
    of_object.associate();
    const std::string long_uid(300, '1');
    of_object.say(storeCommand(long_uid) + fragment(false, image(long_uid, study, "Doe^Jane")));
    of_object.hear();
    expectThatAnHonestSenderGetsIn();
    EXPECT_TRUE(waitUntil([&] { return viconJson(store_, "cases")["cases"].size() >= 1; }));
    EXPECT_TRUE(waitUntil([&] { return allIsTaken(); }));
}

TEST_F(HostileSender, WhatIsAbortedHalfWayLeavesNothingHalf)
{
    const std::string uid = "1.2.826.0.1.3680043.10.9.5.1";
    const std::string whole = image(uid, "1.2.826.0.1.3680043.10.9.5", "Doe^Jane");
    {
        const Wire aborts(port()), leaves(port()), silent(port());
        for (const Wire* one : {&aborts, &leaves, &silent}) {
            one->associate();
            one->say(storeCommand(uid) + fragment(false, whole.substr(0, whole.size() / 2), false));
        }
        aborts.say(pdu(7, "\0\0\0\0"s));
        EXPECT_TRUE(aborts.isEnded());
        EXPECT_TRUE(logSays("an object of 'HOSTILE' at 127.0.0.1 was not received completely"));
        expectThatAnHonestSenderGetsIn();
    }
    EXPECT_TRUE(waitUntil([&] { return allIsTaken(); }));
    EXPECT_EQ(viconJson(store_, "cases")["cases"].size(), 1u) << "the honest sender's";
}

/// Read element by element into memory: with one call of a function for each level, and a walk for each element that is
/// out of order.
TEST_F(HostileSender, WhatIsNestedOrEndlessInAMessageCostsItsAssociationAlone)
{
    constexpr int kDeep = 200'000;
    std::string out_of_order;
    for (int n = 100'000; n > 0; --n)
        out_of_order += element(0x11 + 2 * (n / 0x7fff), 2 * (n % 0x7fff), "");
    const std::string asked = fragment(true, wire::commitmentCommand());
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& [syntax, message] :
         {std::pair(wire::kExplicit, asked + wire::fragments(false, wire::nested(kDeep, true))),
          std::pair(wire::kImplicit, asked + wire::fragments(false, wire::nested(kDeep, false))),
          std::pair(wire::kImplicit, asked + wire::fragments(false, out_of_order)),
          std::pair(wire::kImplicit, wire::fragments(true, wire::command("") + wire::nested(kDeep, false))),
          std::pair(wire::kImplicit, fragment(true, wire::command("") + wire::nested(6000, false)))}) {
        const Wire wire(port());
        wire.associate(wire::kCommitment, syntax);
        wire.say(message);
        EXPECT_TRUE(wire.isEnded());
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), 60) << "s; the longest of them alone would take minutes";
    expectThatAnHonestSenderGetsIn();
    EXPECT_TRUE(
        logSays("an association from 'HOSTILE' at 127.0.0.1 was ended: the data set of a message cannot be "
                "read: its sequences are nested deeper than 64"));
    EXPECT_TRUE(logSays("a command has more than 4096 bytes"));
}

}  // namespace
}  // namespace vicon::support
