#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vicon/core/options.h"

namespace vicon::ingest {

struct ReceiverOptions {
    int port = 11112;
    std::string ae_title = "VICON";
    bool any_called_title = true;
    /// A sender that keeps its association open between images pauses for less than a second.
    double idle_s = 10;
    int max_associations = 8;
    double timeout_s = 60;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("receive.port", port, "", "TCP port of the DICOM listener; 0 takes any free one.", {0, 65535});
        v("receive.ae_title", ae_title, "", "Application entity title of the listener, up to 16 characters.");
        v("receive.any_called_title", any_called_title, "",
          "Accept associations that call another title than receive.ae_title.");
        v("receive.idle_s", idle_s, "s", "Images are handed over when an open association was silent for so long.",
          {0.1, 3600});
        v("receive.max_associations", max_associations, "", "Associations served at the same time.", {1, 1000});
        v("receive.timeout_s", timeout_s, "s", "A peer that stops within a message is dropped after this time.",
          {1, 3600});
    }
};

/// A storage SCP: C-ECHO and C-STORE, every storage class, every transfer syntax as it comes. An image lies durably in
/// the incoming folder before its C-STORE is answered with success.
class Receiver {
public:
    /// Takes what was received; runs on a thread of the receiver, one call at a time. When it returns, the files have
    /// been taken and are removed; when it throws, they stay and are handed over again when a Receiver starts next.
    using OnReceived = std::function<void(std::vector<std::filesystem::path>)>;
    /// Told of what went wrong with one object or one hand-over, without a patient's name. May be empty.
    using OnTrouble = std::function<void(const std::string&)>;

    /// Starts to listen on the port. Throws Error{peer} when the port cannot be had, Error{wrong_use} for a bad title.
    Receiver(const ReceiverOptions& options, const std::filesystem::path& incoming_folder, OnReceived on_received,
             OnTrouble on_trouble = {});
    ~Receiver();
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

    /// Serves until `stop` becomes true, then ends the open associations and hands over what has arrived.
    /// What an earlier run left in the incoming folder is handed over first.
    void run(const std::atomic<bool>& stop);

    /// The port that is listened on.
    int port() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace vicon::ingest
