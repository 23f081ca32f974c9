#include "vicon/ingest/delivery.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "commitment_dataset.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/uid.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"
#include "vicon/ingest/sender.h"
#include "web_peer.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// What a peer took is written down so often: a transaction waits for the disk. After a kill it is sent once more.
constexpr std::chrono::milliseconds kBetweenNotes(300);

/// Peers that answer over the same association do so at once.
constexpr double kAnswerWait_s = 1;

/// What one claim gave: objects for one peer.
class Batch {
public:
    Batch(CaseStore& store, Outbox& outbox, const Delivery& delivery, std::vector<OutboxItem> items)
        : store_(store), outbox_(outbox), delivery_(delivery), items_(std::move(items))
    {
    }

    void deliver(Progress& progress)
    {
        try {
            const Peer peer = delivery_.peer(items_.front().peer);
            store(peer, progress);
            commit(peer, progress);
        } catch (const Error& e) {
            if (e.code() == ErrorCode::database || e.code() == ErrorCode::cancelled)
                throw;
            tell(e.what());
            postponeRest(e.what());
        }
    }

private:
    void tell(const std::string& what) const
    {
        if (delivery_.trouble)
            delivery_.trouble(what);
    }

    /// Another sender may have taken an item over, or a person has dropped it: then it is no longer ours to speak of.
    template <class Action>
    void ifMine(const Action& action) const
    {
        try {
            action();
        } catch (const Error& e) {
            if (e.code() != ErrorCode::lease_lost)
                throw;
        }
    }

    void renew()
    {
        constexpr double kPartOfLease = 0.25;
        const std::chrono::duration<double> since = SteadyClock::now() - renewed_;
        if (since.count() < kPartOfLease * delivery_.options.lease_s)
            return;
        outbox_.renew(items_);
        renewed_ = SteadyClock::now();
    }

    void refuse(const OutboxItem& item, const std::string& reason)
    {
        tell(item.peer + ", object " + item.object.sop_uid + ": " + reason);
        ifMine([&] { outbox_.refuse(item, reason); });
        settled_.push_back(item.id);
    }

    /// Why the file is not what was queued; empty where it is.
    std::string faultOf(const OutboxItem& item) const
    {
        try {
            if (sha256OfFile(store_.folder() / item.object.file) != item.sha256)
                return "its file is no longer what was queued";
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }

    void store(const Peer& peer, Progress& progress)
    {
        std::map<fs::path, const OutboxItem*> sent;
        std::vector<fs::path> files;
        for (const OutboxItem& item : items_) {
            if (item.stored)
                continue;
            if (const std::string fault = faultOf(item); !fault.empty()) {
                refuse(item, fault);
                continue;
            }
            files.push_back(store_.folder() / item.object.file);
            sent[files.back()] = &item;
        }
        if (files.empty())
            return;
        try {
            storeFiles(peer, files, delivery_.our_ae_title, progress, [&](const StoreOutcome& outcome) {
                renew();
                note(*sent.at(outcome.file), outcome);
            });
        } catch (...) {
            noteTaken();  // what was sent stands
            throw;
        }
        noteTaken();
    }

    void noteTaken()
    {
        if (!taken_.empty())
            outbox_.markStored(taken_);
        taken_.clear();
        noted_ = SteadyClock::now();
    }

    void note(const OutboxItem& item, const StoreOutcome& outcome)
    {
        if (outcome.taken) {
            taken_.push_back(item);
            if (SteadyClock::now() - noted_ >= kBetweenNotes)
                noteTaken();
        } else if (outcome.for_good) {
            refuse(item, outcome.reason);
        } else {
            ifMine([&] { outbox_.postpone(item, outcome.reason); });
            settled_.push_back(item.id);
        }
    }

    std::vector<OutboxItem> unsettled() const
    {
        std::vector<OutboxItem> rest;
        std::copy_if(items_.begin(), items_.end(), std::back_inserter(rest), [&](const OutboxItem& item) {
            return std::find(settled_.begin(), settled_.end(), item.id) == settled_.end();
        });
        return rest;
    }

    void commit(const Peer& peer, Progress& progress)
    {
        const std::string transaction = randomUid();
        const std::vector<OutboxItem> asked = outbox_.beginCommitment(unsettled(), transaction);
        if (asked.empty())
            return;
        if (peer.web)
            return commitByReading(peer, transaction, asked, progress);
        std::vector<ObjectName> names;
        for (const OutboxItem& item : asked)
            names.push_back({item.object.sop_class, item.object.sop_uid});
        std::optional<CommitmentReport> answer;
        const CommitmentRequest request =
            requestCommitment(peer, transaction, names, delivery_.our_ae_title, kAnswerWait_s, answer);
        if (request == CommitmentRequest::not_offered)
            for (const OutboxItem& item : asked)
                ifMine([&] { outbox_.markUnconfirmed(item); });
        else
            outbox_.awaitCommitment(asked);
        if (answer)
            noteCommitment(outbox_, *answer);
        for (const OutboxItem& item : asked)
            settled_.push_back(item.id);
    }

    /// By DICOMweb nobody commits to anything: what the peer gives back as it was sent counts as committed.
    void commitByReading(const Peer& peer, const std::string& transaction, const std::vector<OutboxItem>& asked,
                         Progress& progress)
    {
        for (const OutboxItem& item : asked) {
            renew();
            const web::Kept kept = web::readBack(peer, store_.folder() / item.object.file, progress);
            const ObjectName name{item.object.sop_class, item.object.sop_uid};
            if (kept == web::Kept::whole)
                noteCommitment(outbox_, {transaction, {name}, {}});
            else if (kept == web::Kept::missing)
                noteCommitment(outbox_, {transaction, {}, {{name, kNoSuchObject}}});
            else
                ifMine([&] {
                    outbox_.markUnconfirmed(item, kept == web::Kept::changed
                                                      ? "the peer took it, and gives it back changed"
                                                      : "the peer took it, and gives nothing back");
                });
            settled_.push_back(item.id);
        }
    }

    void postponeRest(const std::string& reason)
    {
        for (const OutboxItem& item : unsettled())
            ifMine([&] { outbox_.postpone(item, reason); });
    }

    CaseStore& store_;
    Outbox& outbox_;
    const Delivery& delivery_;
    std::vector<OutboxItem> items_;
    std::vector<int> settled_;       ///< whose outcome is written down
    std::vector<OutboxItem> taken_;  ///< by the peer, and not written down yet
    SteadyClock::time_point renewed_ = SteadyClock::now(), noted_ = renewed_;
};

}  // namespace

OutboxObject outboxObject(const fs::path& file)
{
    setUpDicom();
    DcmFileFormat format;
    const OFCondition loaded = loadFile(format, file, DCM_MaxReadLength, DCM_StudyDate);
    OFString sop_class, sop_uid;
    if (loaded.good()) {
        format.getDataset()->findAndGetOFString(DCM_SOPClassUID, sop_class);
        format.getDataset()->findAndGetOFString(DCM_SOPInstanceUID, sop_uid);
    }
    if (sop_class.empty() || sop_uid.empty())
        throw Error(ErrorCode::bad_input, "this is no DICOM object that could be sent", file.filename().string());
    return {file, sop_class.c_str(), sop_uid.c_str()};
}

int deliverDue(CaseStore& store, const Delivery& delivery, const OutboxFilter& wanted, Progress& progress)
{
    Outbox outbox(store.database(), delivery.options);
    const std::string owner = thisOwner();
    OutboxFilter due_now = wanted;
    due_now.due_by = std::min(wanted.due_by, outbox.now());
    int due = 0;
    for (;;) {
        progress.check();
        std::vector<OutboxItem> items = outbox.claim(owner, due_now);
        if (items.empty())
            return due;
        due += int(items.size());
        Batch(store, outbox, delivery, std::move(items)).deliver(progress);
    }
}

int noteCommitment(Outbox& outbox, const CommitmentReport& report)
{
    std::vector<std::string> committed;
    for (const ObjectName& object : report.committed)
        committed.push_back(object.sop_uid);
    std::vector<Outbox::Failed> failed;
    for (const auto& one : report.failed)
        failed.push_back({one.object.sop_uid, textOfFailureReason(one.reason), one.reason == kNoSuchObject});
    return outbox.report(report.transaction_uid, committed, failed);
}

}  // namespace vicon::ingest
