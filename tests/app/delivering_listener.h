#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "orthanc.h"
#include "vicon/support/support.h"

namespace vicon::support {

/// A configuration by which whoever runs this may sign, and what is signed goes to an Orthanc.
/// @param port on which VICON listens
/// @param orthanc_port on which the archive listens
inline std::string deliveringConfig(int port, int orthanc_port)
{
    std::string account = runCommand("id -un").output;
    account.erase(account.find_last_not_of('\n') + 1);
    return "[receive]\nport = " + std::to_string(port) + "\n[roles]\nsign = [\"" + account +
           "\"]\n[report]\nsend_to = [\"pacs\"]\n[outbox]\nfirst_backoff_s = 0.2\ncommitment_s = 5\n" +
           "[peers]\npacs = { host = \"127.0.0.1\", port = " + std::to_string(orthanc_port) +
           ", ae_title = \"ORTHANC\" }\n";
}

/// 'vicon receive', which delivers the outbox and takes the archive's answers.
class DeliveringListener {
public:
    DeliveringListener(const std::filesystem::path& store, const std::filesystem::path& config)
    {
        process_ = ::fork();
        if (process_ == 0) {
            if (!::freopen((store.parent_path() / "listener.log").c_str(), "w", stderr) ||
                !::freopen("/dev/null", "w", stdout))
                ::_exit(126);
            ::execl(viconBinary().c_str(), "vicon", "receive", "--no-work", "--store", store.c_str(), "--config",
                    config.c_str(), nullptr);
            ::_exit(127);
        }
    }
    ~DeliveringListener()
    {
        ::kill(process_, SIGTERM);
        ::waitpid(process_, nullptr, 0);
    }
    DeliveringListener(const DeliveringListener&) = delete;
    DeliveringListener& operator=(const DeliveringListener&) = delete;

private:
    pid_t process_ = -1;
};

}  // namespace vicon::support
