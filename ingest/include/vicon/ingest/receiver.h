#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vicon/core/options.h"
#include "vicon/ingest/commitment.h"

namespace vicon::ingest {

struct ReceiverOptions {
    int port = 11112;
    /// Nobody else reaches the listener until a site says from where it shall be reached.
    std::string address = "127.0.0.1";
    std::string ae_title = "VICON";
    bool any_called_title = false;
    std::string allow;
    TlsUse tls = TlsUse::off;
    /// Between two associations of one study a scanner pauses for a second or two.
    double quiet_s = 5;
    /// A sender that keeps its association open between images pauses for less than a second.
    double idle_s = 10;
    std::string count_at;
    double incomplete_s = 900;
    int max_associations = 64;
    int max_per_host = 32;
    int max_half_open = 256;
    double request_s = 10;
    double timeout_s = 60;
    double mb_per_s = 0;
    int max_waiting = 100000;
    int report_days = 7;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("receive.port", port, "", "TCP port of the DICOM listener; 0 takes any free one.", {0, 65535});
        v("receive.address", address, "",
          "IPv4 address of this machine that is listened on; 0.0.0.0: all of them, 127.0.0.1: this machine alone.");
        v("receive.ae_title", ae_title, "", "Application entity title of the listener, up to 16 characters.");
        v("receive.any_called_title", any_called_title, "",
          "Accept associations that call another title than receive.ae_title.");
        v("receive.allow", allow, "",
          "Who may call: TITLE, TITLE@HOST, @HOST, peers for all of [peers], or anybody; separated by commas. Empty: "
          "anybody where receive.address is this machine alone, else peers.");
        v("receive.tls", tls, "", "Whether callers speak TLS, with the files of [tls].", choicesOf(tls));
        v("receive.quiet_s", quiet_s, "s",
          "A study is handed over when its associations are over and no more of it came for so long.", {0, 3600});
        v("receive.idle_s", idle_s, "s", "A study is handed over when its open association was silent for so long.",
          {0.1, 3600});
        v("receive.count_at", count_at, "",
          "Peer that is asked which objects a study has before it is handed over; empty: nobody.");
        v("receive.incomplete_s", incomplete_s, "s",
          "A study whose objects receive.count_at has, and that have not come, waits for them so long.", {0, 86400});
        v("receive.max_associations", max_associations, "", "Associations served at the same time.", {1, 1000});
        v("receive.max_per_host", max_per_host, "", "Associations of one host served at the same time.", {1, 1000});
        v("receive.max_half_open", max_half_open, "",
          "Connections that have not yet asked for an association; the oldest of the busiest host goes first.",
          {8, 10000});
        v("receive.request_s", request_s, "s", "An association request that is not complete after this time is ended.",
          {1, 3600});
        v("receive.timeout_s", timeout_s, "s", "A peer that sends next to nothing for so long is dropped.", {1, 3600});
        v("receive.mb_per_s", mb_per_s, "MB/s", "Taken of all peers together; 0: as many as come.", {0, 100000});
        v("receive.max_waiting", max_waiting, "",
          "Objects of one peer that may wait for the import; further ones are refused as out of resources.",
          {1, 10000000});
        v("receive.report_days", report_days, "days",
          "A commitment that its peer does not take the report of is tried again for so long.", {1, 365});
    }
};

/// What a receiver has done since it began; written by its threads, to be read by any.
struct ReceiverCounts {
    std::atomic<long long> associations = 0;          ///< that were served
    std::atomic<long long> refused_associations = 0;  ///< for who calls, what it asks for, or how many there are
    std::atomic<long long> objects = 0;               ///< answered with success
    std::atomic<long long> refused_objects = 0;       ///< answered with a failure, or not received completely
    std::atomic<double> last_object_s = 0;            ///< when the last was answered with success, Unix time; 0: none
};

/// A storage SCP: C-ECHO, C-STORE of every storage class and transfer syntax as it comes, storage commitment to what it
/// keeps, and other archives' reports on theirs.
/// An image lies durably in the incoming folder before its C-STORE is answered with success, and stays in the store,
/// with a case or in quarantine. No peer keeps others waiting: requests are read beside the accepting thread, every
/// phase has a limit.
class Receiver {
public:
    using Files = std::vector<std::filesystem::path>;
    /// Takes what was received of a study; runs on a thread of the receiver, one call at a time. When it returns, the
    /// files have been taken and are removed, but for those that it returns: they are in no case, and are kept in the
    /// store's quarantine. When it throws Error{store}, {database} or {no_memory}, they are handed over again later;
    /// Error{cancelled}: when a Receiver starts next; anything else: in parts, to part the bad object from the others.
    using OnReceived = std::function<Files(const Files&)>;
    /// Told of what went wrong with one object, association or hand-over, without a patient's name. May be empty.
    using OnTrouble = std::function<void(const std::string&)>;
    /// Told of each association and its sender. May be empty.
    using OnNote = std::function<void(const std::string&)>;

    /// Told what an archive says of objects that it was asked to keep. When it throws, the archive is told that its
    /// report was not taken. May be empty: then no report is taken.
    using OnCommitment = std::function<void(const CommitmentReport&)>;
    /// Says what the store commits to, on the threads of associations and on another; when it throws, it is asked again
    /// later. May be empty: then no commitments are given.
    using OnDemand = std::function<CommitmentReport(const CommitmentDemand&)>;
    /// Says how many objects of a quiet study are known to be missing, on the thread that hands it over. Then it waits,
    /// and is asked again. When it throws, the study is handed over. May be empty.
    using OnQuiet = std::function<int(const Files&)>;
    /// Told of each caller that was refused for who it is, what it asks for or how it speaks TLS, and whence it called;
    /// on any thread. May be empty.
    using OnRefused = std::function<void(const std::string& host, const std::string& line)>;
    struct Handlers {
        OnReceived on_received;
        OnTrouble on_trouble = {};
        OnNote on_note = {};
        OnCommitment on_commitment = {};
        OnDemand on_demand = {};
        OnQuiet on_quiet = {};
        OnRefused on_refused = {};
    };

    struct Network {
        std::vector<Peer> peers = {};  ///< what they may do here, and where their commitments are reported
        TlsOptions tls = {};           ///< unless receive.tls is off
    };

    /// Starts to listen on the port. Throws Error{peer} when the port cannot be had, Error{wrong_use} for a bad title,
    /// rule or TLS file.
    Receiver(const ReceiverOptions& options, const std::filesystem::path& incoming_folder, Handlers handlers,
             const Network& network);
    /// Without peers.
    Receiver(const ReceiverOptions& options, const std::filesystem::path& incoming_folder, Handlers handlers);
    ~Receiver();
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

    /// Serves until `stop` becomes true, then ends the open associations and hands over what has arrived.
    /// What an earlier run left in the incoming folder is handed over first.
    void run(const std::atomic<bool>& stop);

    /// The port that is listened on.
    int port() const;
    std::shared_ptr<const ReceiverCounts> counts() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace vicon::ingest
