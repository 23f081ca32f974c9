// A host that opens connections by the hundred, and says nothing or half of what it should, keeps no other out.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <deque>
#include <thread>

#include "dicom_writer.h"
#include "running_receiver.h"
#include "store_fixture.h"
#include "vicon/support/support.h"

namespace vicon::test {
namespace {

const std::size_t kHalfOpen = support::inFull() ? 5000 : 300;

/// A connection from an address of this machine; -1 where none can be had now.
int connectionFrom(const char* address, int port)
{
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in from{}, to{};
    from.sin_family = to.sin_family = AF_INET;
    ::inet_pton(AF_INET, address, &from.sin_addr);
    ::inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
    to.sin_port = htons(std::uint16_t(port));
    if (::bind(socket, reinterpret_cast<sockaddr*>(&from), sizeof from) == 0 &&
        ::connect(socket, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0)
        return socket;
    ::close(socket);
    return -1;
}

/// Opens connections without an end, and keeps so many of them open.
class Crowd {
public:
    Crowd(int port, std::size_t size) : size_(size), thread_([this, port] { press(port); }) {}
    ~Crowd()
    {
        stop_ = true;
        thread_.join();
        for (const int socket : sockets_)
            ::close(socket);
    }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;
    std::size_t opened() const { return opened_; }

private:
    void press(int port)
    {
        const std::string half_a_request("\x01\x00\x00\x00\x01\x00\x00\x01\x00\x00VICON", 15);
        while (!stop_) {
            const int socket = connectionFrom("127.0.0.2", port);
            if (socket < 0)
                continue;
            if (++opened_ % 2 == 0)
                (void)::send(socket, half_a_request.data(), half_a_request.size(), MSG_NOSIGNAL);
            sockets_.push_back(socket);
            if (sockets_.size() > size_) {
                ::close(sockets_.front());
                sockets_.pop_front();
            }
        }
    }
    const std::size_t size_;
    std::atomic<bool> stop_ = false;
    std::atomic<std::size_t> opened_ = 0;
    std::deque<int> sockets_;
    std::thread thread_;
};

class Crowded : public StoreFixture {
protected:
    void SetUp() override
    {
        rlimit open_files{};
        ::getrlimit(RLIMIT_NOFILE, &open_files);
        open_files.rlim_cur = open_files.rlim_max;
        ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &open_files), 0);
        ASSERT_GT(open_files.rlim_cur, rlim_t(2 * kHalfOpen));
    }
};

TEST_F(Crowded, AnHonestSenderGetsIn)
{
    RunningReceiver receiver(store.folder() / "incoming", {});
    const Crowd crowd(receiver.port(), kHalfOpen);
    ASSERT_TRUE(support::waitUntil([&] { return crowd.opened() > kHalfOpen; }));
    const auto files = writeSeries(folder / "in", {});
    for (std::size_t round = 1; round <= 5; ++round) {
        const auto begin = std::chrono::steady_clock::now();
        EXPECT_NO_THROW(ingest::echo(receiver.peer(), "SENDER"));
        const std::chrono::duration<double> in = std::chrono::steady_clock::now() - begin;
        std::printf("got in after %.2f s, beside %zu half-open connections so far\n", in.count(), crowd.opened());
        if (support::inFull()) {
            EXPECT_LT(in.count(), 5);
        }
        EXPECT_TRUE(ingest::storeFiles(receiver.peer(), files, "SENDER", quiet).complete());
        EXPECT_GE(receiver.waitFor(round * files.size()).size(), round * files.size());
    }
}

}  // namespace
}  // namespace vicon::test
