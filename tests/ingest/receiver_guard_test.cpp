// Who may call the receiver, and what it bears of those that call.
#include <arpa/inet.h>
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/scu.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <list>

#include "network_fixture.h"
#include "vicon/core/error.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"
#include "vicon/support/small_disk.h"

using namespace vicon;
using namespace vicon::test;
using testing::HasSubstr;

namespace {

ingest::Receiver::Files nothingLeft(const ingest::Receiver::Files&)
{
    return {};
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
        scu.setPeerAETitle("VICON");
        scu.setPeerPort(Uint16(port));
        OFList<OFString> syntaxes;
        syntaxes.push_back(UID_LittleEndianExplicitTransferSyntax);
        scu.addPresentationContext(UID_CTImageStorage, syntaxes);
        scu.addPresentationContext(UID_VerificationSOPClass, syntaxes);
        EXPECT_TRUE(scu.initNetwork().good());
        EXPECT_TRUE(scu.negotiateAssociation().good());
    }
};

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

TEST_F(Network, ATitleThatIsNotOursIsRefusedUnlessAllAreTaken)
{
    RunningReceiver receiver(incoming, {});
    EXPECT_NO_THROW(ingest::echo(receiver.peer(), "SENDER"));
    ingest::Peer wrong = receiver.peer();
    wrong.ae_title = "SOMEBODY";
    EXPECT_THROW(ingest::echo(wrong, "SENDER"), Error);
    EXPECT_TRUE(receiver.tells("refused 'SENDER' at 127.0.0.1: it calls 'SOMEBODY', not us"));
    ingest::ReceiverOptions any;
    any.any_called_title = true;
    RunningReceiver open(folder / "open", any);
    wrong.port = open.port();
    EXPECT_NO_THROW(ingest::echo(wrong, "SENDER"));
}

TEST_F(Network, APeerWhoseRolesDoNotLetItStoreIsRefusedByItsTitleAndTheLogSaysWhy)
{
    const auto files = writeSeries(folder / "in", {});
    ingest::Peer archive{"archive", "127.0.0.1", "ARCHIVE"};
    archive.stores = false;
    RunningReceiver receiver(incoming, {}, {}, {}, {.peers = {archive}});
    const auto send = [&](const std::string& title) {
        return support::runCommand("storescu -v -aec VICON -aet " + title + " 127.0.0.1 " +
                                   std::to_string(receiver.port()) + " " + files.at(0).string() + " 2>&1");
    };
    const auto refused = send("ARCHIVE");
    EXPECT_NE(refused.exit_code, 0);
    EXPECT_NE(refused.output.find("Calling AE Title Not Recognized"), std::string::npos) << refused.output;
    EXPECT_TRUE(receiver.tells("refused 'ARCHIVE' at 127.0.0.1: the roles of peer archive do not let it store"));
    EXPECT_NO_THROW(ingest::echo(receiver.peer(), "ARCHIVE"));
    EXPECT_EQ(send("CT1").exit_code, 0) << "others may";
    const auto counts = receiver.counts();
    EXPECT_TRUE(support::waitUntil([&] { return counts->associations == 2; }));
    EXPECT_EQ(counts->refused_associations, 1);
    EXPECT_EQ(counts->objects, 1);
    EXPECT_GT(counts->last_object_s, 0);
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
    EXPECT_TRUE(comesToAnswer(receiver.peer()));
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
    // An echo now and then is less than any image.
    EXPECT_TRUE(support::waitUntil([&] { return !trickling.scu.sendECHORequest(0).good(); }));
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
    options.allow = "SCANNER@";
    EXPECT_THROW(ingest::Receiver(options, folder / "other", {nothingLeft}), Error);
}

TEST_F(Network, WhoAsksForWhatIsNotServedIsToldSoAndLogged)
{
    ingest::ReceiverOptions options;
    options.allow = "FINDSCU@localhost, MOVESCU@localhost, GETSCU@localhost";
    RunningReceiver receiver(incoming, options);
    const auto ask = [&](const std::string& tool) {
        const auto asked =
            support::runCommand(tool + " -v -S -k QueryRetrieveLevel=STUDY -k StudyInstanceUID=1.2 127.0.0.1 " +
                                std::to_string(receiver.port()) + " 2>&1");
        EXPECT_NE(asked.exit_code, 0) << asked.output;
        return asked.output;
    };
    EXPECT_THAT(ask("findscu -aec VICON"), HasSubstr("No Acceptable Presentation Contexts"));
    EXPECT_TRUE(
        receiver.tells("refused 'FINDSCU' at 127.0.0.1: it asks for nothing that it may have here: "
                       "FINDStudyRootQueryRetrieveInformationModel"));
    EXPECT_THAT(ask("movescu -aec VICON"), HasSubstr("No Acceptable Presentation Contexts"));
    EXPECT_TRUE(receiver.tells("MOVEStudyRootQueryRetrieveInformationModel"));
    ask("getscu -aec VICON");  // it offers to take images, in the role that VICON has not
    EXPECT_TRUE(receiver.tells("GETStudyRootQueryRetrieveInformationModel"));
    EXPECT_THAT(ask("findscu -aec SOMEBODY"), HasSubstr("Called AE Title Not Recognized"));
    EXPECT_TRUE(receiver.tells("refused 'FINDSCU' at 127.0.0.1: it calls 'SOMEBODY', not us"));
    EXPECT_THAT(ask("findscu -aet STRANGER -aec VICON"), HasSubstr("Calling AE Title Not Recognized"));
    EXPECT_TRUE(receiver.tells("refused 'STRANGER' at 127.0.0.1: receive.allow does not name it"));
    EXPECT_NO_THROW(ingest::echo(receiver.peer(), "FINDSCU"));
}

/// As when the name server is off while the machine starts.
TEST_F(Network, AHostThatHasNoAddressYetMayCallOnceItHasOne)
{
    const support::SmallDisk mounts(folder / "disk", 1);
    VICON_NEEDS_DISK(mounts);
    const fs::path hosts = folder / "hosts";
    std::ofstream(hosts) << "127.0.0.1 localhost\n";
    ASSERT_EQ(::mount(hosts.c_str(), "/etc/hosts", nullptr, MS_BIND, nullptr), 0);
    ingest::ReceiverOptions options;
    options.allow = "SCANNER@scanner.invalid, PACS@localhost";
    {
        RunningReceiver receiver(incoming, options);
        EXPECT_TRUE(receiver.tells("'scanner.invalid' has no address"));
        EXPECT_THROW(ingest::echo(receiver.peer(), "SCANNER"), Error);
        EXPECT_NO_THROW(ingest::echo(receiver.peer(), "PACS")) << "nobody else waits for it";
        std::ofstream(hosts) << "127.0.0.1 localhost scanner.invalid\n";
        EXPECT_TRUE(receiver.tells("'scanner.invalid' has an address now"));
        EXPECT_NO_THROW(ingest::echo(receiver.peer(), "SCANNER"));
    }
    ::umount2("/etc/hosts", MNT_DETACH);
}

TEST_F(Network, ListensOnThisMachineAloneUnlessAnAddressIsConfigured)
{
    RunningReceiver receiver(incoming, {});
    EXPECT_TRUE(Connection(receiver.port()).connected());
    EXPECT_FALSE(Connection(receiver.port(), "127.0.0.2").connected());
    ingest::ReceiverOptions everywhere;
    everywhere.address = "0.0.0.0";
    everywhere.allow = "anybody";
    RunningReceiver open(folder / "open", everywhere);
    EXPECT_TRUE(Connection(open.port(), "127.0.0.2").connected());
}

}  // namespace
