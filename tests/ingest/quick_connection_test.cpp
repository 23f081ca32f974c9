// What a peer sends in pieces is acknowledged piece by piece.
#include "quick_connection.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace vicon::ingest {
namespace {

/// Both ends of a connection to this machine.
struct Ends {
    int here = -1, there = -1;

    Ends()
    {
        const int listening = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t length = sizeof address;
        EXPECT_EQ(::bind(listening, reinterpret_cast<sockaddr*>(&address), length), 0);
        EXPECT_EQ(::listen(listening, 1), 0);
        EXPECT_EQ(::getsockname(listening, reinterpret_cast<sockaddr*>(&address), &length), 0);
        here = ::socket(AF_INET, SOCK_STREAM, 0);
        EXPECT_EQ(::connect(here, reinterpret_cast<sockaddr*>(&address), length), 0);
        there = ::accept(listening, nullptr, nullptr);
        ::close(listening);
    }
    ~Ends() { ::close(there); }
    Ends(const Ends&) = delete;
    Ends& operator=(const Ends&) = delete;

    /// Bytes that the other end sent and does not know to have arrived.
    int unacknowledged() const
    {
        int bytes = 0;
        ::ioctl(there, SIOCOUTQ, &bytes);
        return bytes;
    }
};

/// Requests and answers in turn make the system hold acknowledgements back, to send them with the next request.
TEST(QuickConnection, AcknowledgesTheFirstPieceOfAnAnswerWhenItIsRead)
{
    Ends ends;
    QuickConnection connection(ends.here);  // which closes it
    constexpr int kMessages = 50;
    int at_once = 0;
    char byte = 'x';
    for (int n = 0; n < kMessages; ++n) {
        ASSERT_EQ(connection.write(&byte, 1), 1);
        ASSERT_EQ(::read(ends.there, &byte, 1), 1);
        ASSERT_EQ(::write(ends.there, &byte, 1), 1);
        ASSERT_EQ(connection.read(&byte, 1), 1);
        at_once += ends.unacknowledged() == 0;
    }
    EXPECT_GT(at_once, kMessages / 2) << "a busy system may deliver some of them later";
}

}  // namespace
}  // namespace vicon::ingest
