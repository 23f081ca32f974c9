// What VICON asks of a peer may be answered by anything.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "vicon/core/error.h"
#include "vicon/ingest/commitment.h"
#include "vicon/ingest/query.h"
#include "wire.h"

namespace vicon::ingest {
namespace {

using namespace test::wire;
using testing::HasSubstr;

/// A peer that accepts context 1 and answers whatever comes next with the same.
class Answering {
public:
    explicit Answering(std::string answer)
        : answer_(std::move(answer)), socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0))
    {
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&at), sizeof at), 0);
        EXPECT_EQ(::listen(socket_, 1), 0);
        socklen_t size = sizeof at;
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size);
        port_ = ntohs(at.sin_port);
        thread_ = std::thread([this] { serve(); });
    }
    ~Answering()
    {
        ::shutdown(socket_, SHUT_RDWR);
        thread_.join();
        ::close(socket_);
    }
    Answering(const Answering&) = delete;
    Answering& operator=(const Answering&) = delete;

    Peer peer() const { return {"hostile", "127.0.0.1", "HOSTILE", port_}; }

private:
    void serve() const
    {
        const int caller = ::accept(socket_, nullptr, nullptr);
        if (caller < 0)
            return;
        const auto say = [&](const std::string& bytes) {
            (void)::send(caller, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        };
        std::string heard(1 << 16, '\0');
        (void)::recv(caller, heard.data(), heard.size(), 0);
        say(acceptance(kImplicit));
        (void)::recv(caller, heard.data(), heard.size(), 0);
        say(answer_);
        while (::recv(caller, heard.data(), heard.size(), 0) > 0)
            ;
        ::close(caller);
    }

    std::string answer_;
    int socket_, port_ = 0;
    std::thread thread_;
};

std::string answer(int field, int status)
{
    return command(element(0, 2, "1.2.840.10008.5.1.4.1.2.2.1") + element(0, 0x100, littleEndian(field, 2)) +
                   element(0, 0x120, littleEndian(1, 2)) + element(0, 0x800, littleEndian(1, 2)) +
                   element(0, 0x900, littleEndian(status, 2)));
}

constexpr int kFindAnswer = 0x8020, kPending = 0xff00, kDeep = 200'000;

TEST(HostilePeer, ThatAnswersAQueryWithNestedDataIsSaid)
{
    const Answering hostile(fragment(true, answer(kFindAnswer, kPending)) + fragments(false, nested(kDeep, false)));
    NoProgress quiet;
    try {
        findStudies(hostile.peer(), {}, "VICON", quiet);
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("its sequences are nested deeper than 64"));
    }
}

TEST(HostilePeer, WhoseMatchesDoNotEndIsLeft)
{
    const std::string match =
        fragment(true, answer(kFindAnswer, kPending)) + fragment(false, element(0x20, 0xd, "1.2"));
    std::string matches;
    for (int n = 0; n < 100'100; ++n)
        matches += match;
    const Answering hostile(matches);
    NoProgress quiet;
    try {
        findStudies(hostile.peer(), {}, "VICON", quiet);
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("more than 100000 match"));
    }
}

TEST(HostilePeer, ThatAnswersAQueryWithANestedCommandIsSaid)
{
    const Answering hostile(fragments(true, answer(kFindAnswer, kPending) + nested(kDeep, false)));
    NoProgress quiet;
    try {
        findStudies(hostile.peer(), {}, "VICON", quiet);
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("a command "));
    }
}

TEST(HostilePeer, ThatAnswersARequestForCommitmentWithANestedReportIsSaid)
{
    constexpr int kActionAnswer = 0x8130, kNoDataset = 0x0101;
    const std::string taken =
        command(element(0, 2, kCommitment) + element(0, 0x100, littleEndian(kActionAnswer, 2)) +
                element(0, 0x120, littleEndian(1, 2)) + element(0, 0x800, littleEndian(kNoDataset, 2)) +
                element(0, 0x900, littleEndian(0, 2)) + element(0, 0x1000, "1.2.840.10008.1.20.1.1"));
    const std::string report =
        command(element(0, 2, kCommitment) + element(0, 0x100, littleEndian(0x100, 2)) +
                element(0, 0x110, littleEndian(7, 2)) + element(0, 0x800, littleEndian(1, 2)) +
                element(0, 0x1000, "1.2.840.10008.1.20.1.1") + element(0, 0x1002, littleEndian(1, 2)));
    const Answering hostile(fragment(true, taken) + fragment(true, report) + fragments(false, nested(kDeep, false)));
    std::optional<CommitmentReport> answer;
    try {
        requestCommitment(hostile.peer(), "1.2.3", {{"1.2.840.10008.5.1.4.1.1.2", "1.2.4"}}, "VICON", 5, answer);
    } catch (const Error&) {  // it may be that the answer is taken for one that comes later
    }
    EXPECT_FALSE(answer);
}

}  // namespace
}  // namespace vicon::ingest
