// The outbox against archives that are not ours.
#include "vicon/ingest/delivery.h"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <random>

#include "dicom_writer.h"
#include "orthanc.h"
#include "store_fixture.h"
#include "vicon/ingest/receiver.h"
#include "vicon/support/support.h"

namespace vicon::test {
namespace {

const int kKills = support::inFull() ? 1000 : 10;

using testing::HasSubstr;
using testing::Not;

class DeliverToOrthanc : public StoreFixture {
protected:
    const int port_ = freePort();
    Orthanc orthanc_{folder / "orthanc", port_};
    const OutboxOptions outbox_options_{
        .lease_s = 10, .first_backoff_s = 0.1, .longest_backoff_s = 0.5, .commitment_s = 3, .at_once = 5};
    Outbox outbox_{store.database(), outbox_options_};
    std::vector<OutboxObject> images_;
    std::string case_id_;
    std::atomic<bool> stop_ = false;
    std::unique_ptr<ingest::Receiver> receiver_;
    std::thread listening_;

    void SetUp() override
    {
        import(writeSeries(folder / "in", {}));
        const ScanRecord scan = onlyScan();
        case_id_ = scan.case_id;
        for (const InstanceRecord& instance : store.instances(scan.case_id, scan.id))
            images_.push_back(ingest::outboxObject(store.scanFolder(scan.case_id, scan.id) / "dicom" / instance.file));
        ASSERT_EQ(images_.size(), 12u);
        ASSERT_TRUE(orthanc_.answers()) << readFile(folder / "orthanc/log");
        ingest::ReceiverOptions listener;
        listener.port = port_;
        receiver_ = std::make_unique<ingest::Receiver>(
            listener, store.folder() / "incoming",
            ingest::Receiver::Handlers{.on_received = [](const auto&) { return ingest::Receiver::Files{}; },
                                       .on_commitment =
                                           [this](const ingest::CommitmentReport& report) {
                                               CaseStore own(store.folder());
                                               Outbox outbox(own.database(), {});
                                               ingest::noteCommitment(outbox, report);
                                           }});
        listening_ = std::thread([this] { receiver_->run(stop_); });
    }
    void TearDown() override
    {
        stop_ = true;
        if (listening_.joinable())
            listening_.join();
    }
    ingest::Delivery delivery() const
    {
        return {.options = outbox_options_,
                .peer =
                    [this](const std::string& name) {
                        if (name != "orthanc")
                            throw Error(ErrorCode::wrong_use, "no peer of that name", name);
                        return orthanc_.peer();
                    },
                .our_ae_title = "VICON"};
    }
    int deliver() { return ingest::deliverDue(store, delivery(), {}, quiet); }
    std::string brief() { return deliveryInBrief(countDeliveries(store, case_id_)); }
    /// Delivers as the listener does in the background, until the outbox says this.
    bool deliverUntil(const std::string& said)
    {
        return support::waitUntil([&] {
            deliver();
            return brief() == said;
        });
    }
};

TEST_F(DeliverToOrthanc, WhatItCommitsToIsDelivered)
{
    const auto items = queueObjects(store, case_id_, "orthanc", images_);
    EXPECT_EQ(deliver(), 12);
    EXPECT_TRUE(deliverUntil("12 committed")) << brief();
    EXPECT_EQ(orthanc_.objects(), 12u);
    for (const OutboxItem& item : items)
        EXPECT_LE(outbox_.find(item.id)->attempts, 1) << "it was asked once";
    EXPECT_THAT(readFile(folder / "orthanc/log"), Not(HasSubstr("N-EVENT-REPORT"))) << "it takes our answer";
    EXPECT_EQ(deliver(), 0) << "nothing is sent twice";
}

TEST_F(DeliverToOrthanc, WhatItDoesNotHaveIsSentAgain)
{
    queueObjects(store, case_id_, "orthanc", {images_.at(0)});
    const OutboxItem never_sent = outbox_.claim(thisOwner()).at(0);
    outbox_.markStored(never_sent);
    outbox_.postpone(never_sent, "");
    EXPECT_TRUE(support::waitUntil([&] { return deliver() == 1; })) << "as soon as it is due";
    EXPECT_EQ(orthanc_.objects(), 0u);
    EXPECT_TRUE(deliverUntil("1 committed")) << brief();
    EXPECT_EQ(orthanc_.objects(), 1u);
}

TEST_F(DeliverToOrthanc, WhileItIsOffEverythingWaits)
{
    orthanc_.end(SIGKILL);
    queueObjects(store, case_id_, "orthanc", images_);
    deliver();
    EXPECT_EQ(brief(), "12 queued");
    EXPECT_THAT(outbox_.items().at(0).reason, HasSubstr("no association with the peer"));
    orthanc_.start();
    EXPECT_TRUE(deliverUntil("12 committed")) << brief();
    EXPECT_EQ(orthanc_.objects(), 12u);
}

TEST_F(DeliverToOrthanc, AKindThatItDoesNotTakeStaysWithTheReason)
{
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(images_.at(0).file.c_str()).good());
    format.getDataset()->putAndInsertString(DCM_SOPClassUID, "1.2.3.4");
    const fs::path file = store.caseFolder(case_id_) / "report" / "odd.dcm";
    makePrivateFolder(file.parent_path());
    ASSERT_TRUE(format.saveFile(file.c_str()).good());
    queueObjects(store, case_id_, "orthanc", {ingest::outboxObject(file), images_.at(1)});
    EXPECT_TRUE(deliverUntil("1 committed, 1 refused")) << brief();
    EXPECT_THAT(outbox_.items().at(0).reason, HasSubstr("neither this kind of object nor its encoding"));
}

TEST_F(DeliverToOrthanc, OnlyWhatWasQueuedIsSent)
{
    const fs::path file = store.caseFolder(case_id_) / "report" / "copy.dcm";
    makePrivateFolder(file.parent_path());
    fs::copy_file(images_.at(0).file, file);
    queueObjects(store, case_id_, "orthanc", {ingest::outboxObject(file)});
    std::ofstream(file, std::ios::app) << "more";
    EXPECT_EQ(deliver(), 1);
    EXPECT_EQ(brief(), "1 refused");
    EXPECT_THAT(outbox_.items().at(0).reason, HasSubstr("no longer what was queued"));
    EXPECT_EQ(orthanc_.objects(), 0u);
}

TEST_F(DeliverToOrthanc, APeerThatIsNoLongerConfiguredGetsNothingAndNobodyElseDoes)
{
    queueObjects(store, case_id_, "renamed", {images_.at(0)});
    EXPECT_EQ(deliver(), 1);
    EXPECT_EQ(brief(), "1 queued");
    EXPECT_THAT(outbox_.items().at(0).reason, HasSubstr("no peer of that name"));
    EXPECT_EQ(orthanc_.objects(), 0u);
}

TEST_F(DeliverToOrthanc, AnArchiveThatOffersNoCommitmentLeavesItSaid)
{
    const int port = freePort();
    fs::create_directories(folder / "storescp");
    const pid_t storescp = ::fork();
    if (storescp == 0) {
        ::execlp("storescp", "storescp", "-od", (folder / "storescp").c_str(), std::to_string(port).c_str(), nullptr);
        std::_Exit(127);
    }
    const ingest::Peer peer{"plain", "127.0.0.1", "ANY", port};
    ASSERT_TRUE(comesToAnswer(peer));
    ingest::Delivery plain = delivery();
    plain.peer = [&](const std::string&) { return peer; };
    queueObjects(store, case_id_, "plain", images_);
    EXPECT_EQ(ingest::deliverDue(store, plain, {}, quiet), 12);
    EXPECT_EQ(brief(), "12 unconfirmed");
    ::kill(storescp, SIGTERM);
    ::waitpid(storescp, nullptr, 0);
}

/// Senders and archive are killed at any moment, so many times; in the end all is there.
TEST_F(DeliverToOrthanc, KilledAtAnyMomentEverythingArrivesAndIsCommitted)
{
    queueObjects(store, case_id_, "orthanc", images_);
    std::mt19937 random(1);
    for (int round = 0; round < kKills; ++round) {
        if (round % 5 == 4) {
            orthanc_.end(SIGKILL);
            orthanc_.start();
        }
        const pid_t sender = ::fork();
        if (sender == 0) {  // a connection to the database of its own, as another process has it
            try {
                CaseStore own(store.folder());
                for (;;) {
                    ingest::deliverDue(own, delivery(), {}, quiet);
                    ::usleep(10'000);  // as the listener rests between its looks
                }
            } catch (...) {
            }
            std::_Exit(1);
        }
        // The moment of the kill is what is tried.
        ::usleep(std::uniform_int_distribution<unsigned>(1'000, 200'000)(random));
        ::kill(sender, SIGKILL);
        ::waitpid(sender, nullptr, 0);
        if (brief() == "12 committed") {  // once more, from the start
            for (const OutboxItem& item : outbox_.items())
                outbox_.drop(item.id);
            queueObjects(store, case_id_, "orthanc", images_);
        }
    }
    ASSERT_TRUE(orthanc_.answers());
    EXPECT_TRUE(deliverUntil("12 committed")) << brief();
    EXPECT_EQ(orthanc_.objects(), 12u);
}

}  // namespace
}  // namespace vicon::test
