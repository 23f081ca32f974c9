#include "postgresql_proxy.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace vicon::test {
namespace {

constexpr const char* kSocket = ".s.PGSQL.5432";
constexpr int kLook_ms = 50;

sockaddr_un addressOf(const std::filesystem::path& folder)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = (folder / kSocket).string();
    if (name.size() >= sizeof address.sun_path)
        throw std::runtime_error("the socket's name is too long: " + name);
    std::memcpy(address.sun_path, name.data(), name.size());
    return address;
}

/// What is there to be read; empty when the line is closed.
std::string readFrom(int socket)
{
    std::array<char, 65536> bytes;
    const auto count = ::read(socket, bytes.data(), bytes.size());
    return count > 0 ? std::string(bytes.data(), std::size_t(count)) : "";
}

void writeTo(int socket, const std::string& bytes)
{
    for (std::size_t done = 0; done < bytes.size();) {
        const auto count = ::send(socket, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
        if (count <= 0)
            return;
        done += std::size_t(count);
    }
}

}  // namespace

PostgresqlProxy::PostgresqlProxy(const std::filesystem::path& folder, const std::filesystem::path& server)
    : server_(server), listener_(::socket(AF_UNIX, SOCK_STREAM, 0))
{
    const sockaddr_un address = addressOf(folder);
    if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listener_, 16) != 0)
        throw std::runtime_error("the proxy cannot listen");
    thread_ = std::thread([this] { accept(); });
}

PostgresqlProxy::~PostgresqlProxy()
{
    over_ = true;
    thread_.join();
    ::close(listener_);
}

void PostgresqlProxy::cutAfter(const std::string& words)
{
    const std::lock_guard lock(mutex_);
    words_ = words;
    after_ = true;
    left_ = 1;
}

void PostgresqlProxy::cutBefore(const std::string& words, int times)
{
    const std::lock_guard lock(mutex_);
    words_ = words;
    after_ = false;
    left_ = times;
}

void PostgresqlProxy::accept()
{
    std::vector<std::thread> lines;
    while (!over_) {
        pollfd waiting{.fd = listener_, .events = POLLIN, .revents = 0};
        if (::poll(&waiting, 1, kLook_ms) > 0)
            lines.emplace_back([this, client = ::accept(listener_, nullptr, nullptr)] { serve(client); });
    }
    for (std::thread& line : lines)
        line.join();
}

bool PostgresqlProxy::takeToServer(const std::string& message, int server)
{
    const std::lock_guard lock(mutex_);
    if (left_ == 0 || message.find(words_) == std::string::npos) {
        writeTo(server, message);
        return false;
    }
    --left_;
    if (after_) {
        writeTo(server, message);
        readFrom(server);
    }
    away_ = stays_away_.load();
    ++cuts_;
    return true;
}

void PostgresqlProxy::serve(int client)
{
    const int server = ::socket(AF_UNIX, SOCK_STREAM, 0);
    const sockaddr_un address = addressOf(server_);
    bool open = !away_ && ::connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    while (open && !over_ && !away_) {
        std::array<pollfd, 2> ends{
            {{.fd = client, .events = POLLIN, .revents = 0}, {.fd = server, .events = POLLIN, .revents = 0}}};
        if (::poll(ends.data(), ends.size(), kLook_ms) <= 0)
            continue;
        if (ends[0].revents) {
            const std::string message = readFrom(client);
            open = !message.empty() && !takeToServer(message, server);
        }
        if (open && ends[1].revents) {
            const std::string answer = readFrom(server);
            open = !answer.empty();
            writeTo(client, answer);
        }
    }
    ::close(server);
    ::close(client);
}

}  // namespace vicon::test
