#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

namespace vicon::test {

/// Stands between programs and a server on a socket, so that a test can cut the line at a moment of its choice.
class PostgresqlProxy {
public:
    /// @param folder of the proxy's own socket
    /// @param server folder of the server's
    PostgresqlProxy(const std::filesystem::path& folder, const std::filesystem::path& server);
    ~PostgresqlProxy();
    PostgresqlProxy(const PostgresqlProxy&) = delete;
    PostgresqlProxy& operator=(const PostgresqlProxy&) = delete;

    /// Hands the next message that holds these words on, and cuts the line when the server has answered, before the
    /// answer is passed back.
    void cutAfter(const std::string& words);
    /// Cuts the line before the server gets the message, at each of the next `times` messages that hold the words.
    void cutBefore(const std::string& words, int times = 1);
    int cuts() const { return cuts_; }
    /// From the next cut on nobody gets through.
    void stayAwayAfterCut() { stays_away_ = true; }
    void comeBack() { away_ = stays_away_ = false; }

private:
    void accept();
    void serve(int client);
    /// Whether the line is cut now.
    bool takeToServer(const std::string& message, int server);

    std::filesystem::path server_;
    int listener_ = -1;
    std::atomic<bool> over_ = false;
    std::atomic<int> cuts_ = 0;
    std::atomic<bool> stays_away_ = false, away_ = false;
    std::mutex mutex_;
    std::string words_;
    bool after_ = false;
    int left_ = 0;        ///< cuts that are still to be made
    std::thread thread_;  // last: it uses everything above
};

}  // namespace vicon::test
