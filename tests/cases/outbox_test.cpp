// The outbox: what a case's objects go through until a peer keeps them.
#include "vicon/cases/outbox.h"

#include <gmock/gmock.h>
#include <soci/soci.h>

#include <thread>

#include "case_fixture.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

using testing::HasSubstr;

class OutboxRows : public testing::Test {
protected:
    double now_ = 1000;
    test::StoreOfOneScan one_;
    CaseStore& store_ = one_.store;
    const OutboxOptions options_{.lease_s = 10, .first_backoff_s = 2, .longest_backoff_s = 8, .commitment_s = 20};
    Outbox outbox_{store_.database(), options_, [this] { return now_; }};

    /// An object with its file in the case's folder.
    OutboxObject object(const std::string& uid)
    {
        const auto file = store_.caseFolder("c1") / "report" / (uid + ".dcm");
        makePrivateFolder(file.parent_path());
        replaceFile(file, "object " + uid);
        return {file, "1.2.840.10008.5.1.4.1.1.104.1", uid};
    }
    std::vector<OutboxItem> queue(const std::vector<std::string>& uids, const std::string& peer = "main")
    {
        std::vector<OutboxObject> objects;
        for (const std::string& uid : uids)
            objects.push_back(object(uid));
        return queueObjects(store_, "c1", peer, objects);
    }
    OutboxItem item(int id) { return outbox_.find(id).value(); }
    static ErrorCode codeOf(const std::function<void()>& action)
    {
        try {
            action();
        } catch (const Error& e) {
            return e.code();
        }
        ADD_FAILURE() << "nothing was thrown";
        return ErrorCode::internal;
    }
    /// Claimed, stored, and the peer asked.
    std::vector<OutboxItem> ask(const std::string& transaction)
    {
        const auto claimed = outbox_.claim("a");
        for (const OutboxItem& one : claimed)
            if (!one.stored)
                outbox_.markStored(one);
        outbox_.awaitCommitment(outbox_.beginCommitment(claimed, transaction));
        return claimed;
    }
};

TEST_F(OutboxRows, TheSameObjectForTheSamePeerIsOneItem)
{
    const auto first = queue({"1.1", "1.2"});
    const auto again = queue({"1.2", "1.3"});
    EXPECT_EQ(again.at(0).id, first.at(1).id);
    EXPECT_EQ(queue({"1.1"}, "archive").at(0).peer, "archive");
    EXPECT_EQ(outbox_.items("c1").size(), 4u);
    EXPECT_TRUE(outbox_.items("c2").empty());
    EXPECT_EQ(deliveryInBrief(countDeliveries(store_, "c1")), "4 queued");
}

TEST_F(OutboxRows, WhatIsQueuedWithAnotherChangeStandsOrFallsWithIt)
{
    const OutboxObject made = object("1.1");
    EXPECT_THROW(store_.database().write([&](soci::session& sql) {
        queueObjects(store_, sql, "c1", "main", {made});
        throw Error(ErrorCode::internal, "the signature failed");
    }),
                 Error);
    EXPECT_TRUE(outbox_.items().empty());
}

TEST_F(OutboxRows, TakesNoOtherBytesUnderAUidThatIsThere)
{
    queue({"1.1"});
    const OutboxObject other = object("1.1");
    replaceFile(other.file, "other bytes");
    EXPECT_EQ(codeOf([&] { queueObjects(store_, "c1", "main", {other}); }), ErrorCode::bad_input);
}

TEST_F(OutboxRows, TakesNothingFromOutsideTheCase)
{
    OutboxObject outside = object("1.1");
    outside.file = store_.folder() / "outside.dcm";
    replaceFile(outside.file, "no object of the case");
    EXPECT_EQ(codeOf([&] { queueObjects(store_, "c1", "main", {outside}); }), ErrorCode::bad_input);
    outside.file = store_.caseFolder("c1") / "none.dcm";
    EXPECT_EQ(codeOf([&] { queueObjects(store_, "c1", "main", {outside}); }), ErrorCode::store);
}

TEST_F(OutboxRows, GivesWhatIsDueForOnePeerAtATime)
{
    queue({"1.1", "1.2"});
    queue({"1.1"}, "archive");
    EXPECT_EQ(outbox_.claim("a").size(), 2u);
    EXPECT_EQ(outbox_.claim("b").at(0).peer, "archive");
    EXPECT_TRUE(outbox_.claim("c").empty());
}

TEST_F(OutboxRows, GivesEachItemToOneOfManySendersOnly)
{
    std::vector<std::string> uids;
    for (int n = 0; n < 40; ++n)
        uids.push_back("1." + std::to_string(n));
    queue(uids);
    OutboxOptions few = options_;
    few.at_once = 3;
    std::array<std::vector<int>, 4> taken;
    std::vector<std::thread> threads;
    for (auto& mine : taken)
        threads.emplace_back([&] {
            Database database(store_.database().where());
            Outbox outbox(database, few);
            for (auto items = outbox.claim("elsewhere/x/1/1"); !items.empty(); items = outbox.claim("elsewhere/x/1/1"))
                for (const OutboxItem& one : items)
                    mine.push_back(one.id);
        });
    for (auto& thread : threads)
        thread.join();
    std::vector<int> all;
    for (const auto& mine : taken)
        all.insert(all.end(), mine.begin(), mine.end());
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all.size(), 40u);
    EXPECT_EQ(std::unique(all.begin(), all.end()), all.end());
}

TEST_F(OutboxRows, IsDeliveredOnlyWhenThePeerCommitted)
{
    queue({"1.1", "1.2", "1.3"});
    const auto asked = ask("2.25.1");
    EXPECT_EQ(deliveryInBrief(countDeliveries(store_, "c1")), "3 sent");
    EXPECT_EQ(outbox_.report("2.25.9", {"1.1"}, {}), 0) << "of another transaction";
    EXPECT_EQ(outbox_.report("2.25.1", {"1.1", "7.7"}, {{"1.2", "no such object", true}, {"1.3", "busy", false}}), 3);
    EXPECT_EQ(item(asked.at(0).id).state, DeliveryState::committed);
    EXPECT_EQ(item(asked.at(1).id).state, DeliveryState::queued) << "it is sent again";
    EXPECT_EQ(item(asked.at(2).id).state, DeliveryState::sent) << "it is only asked for again";
    EXPECT_EQ(outbox_.report("2.25.1", {}, {{"1.1", "late", true}}), 0) << "what is committed stays so";
}

TEST_F(OutboxRows, AnAnswerThatComesBeforeTheRequestEndedCounts)
{
    queue({"1.1"});
    const auto claimed = outbox_.claim("a");
    outbox_.markStored(claimed.at(0));
    const auto begun = outbox_.beginCommitment(claimed, "2.25.1");
    EXPECT_EQ(outbox_.report("2.25.1", {"1.1"}, {}), 1);
    outbox_.awaitCommitment(begun);
    EXPECT_EQ(item(claimed.at(0).id).state, DeliveryState::committed);
    EXPECT_EQ(codeOf([&] { outbox_.postpone(claimed.at(0), "broke"); }), ErrorCode::lease_lost);
}

TEST_F(OutboxRows, AnAnswerToAnEarlierQuestionCountsToo)
{
    queue({"1.1", "1.2"});
    for (int n = 1; n <= 12; ++n) {
        ASSERT_EQ(ask("2.25." + std::to_string(n)).size(), 2U) << n;
        now_ += 100;
    }
    EXPECT_EQ(outbox_.report("2.25.1", {"1.1"}, {}), 0) << "only the last eight are kept; nor is it 2.25.12";
    EXPECT_EQ(outbox_.report("%", {"1.1"}, {}), 0);
    EXPECT_EQ(outbox_.report("2.25.6", {"1.1"}, {}), 1);
    EXPECT_EQ(outbox_.report("2.25.12", {"1.1", "1.2"}, {}), 1);
}

TEST_F(OutboxRows, AsksAgainWhenNoAnswerComes)
{
    queue({"1.1"});
    ask("2.25.1");
    EXPECT_TRUE(outbox_.claim("a").empty());
    now_ += options_.commitment_s;
    const auto again = ask("2.25.2");
    ASSERT_EQ(again.size(), 1u);
    EXPECT_TRUE(again.at(0).stored) << "it need not be sent again";
    EXPECT_EQ(outbox_.report("2.25.2", {"1.1"}, {}), 1);
}

TEST_F(OutboxRows, TriesAsOftenAsItTakesWithLongerWaits)
{
    const int id = queue({"1.1"}).at(0).id;
    double waited = 0;
    for (int n = 0; n < 40; ++n) {
        const auto claimed = outbox_.claim("a");
        ASSERT_EQ(claimed.size(), 1u) << n;
        outbox_.postpone(claimed.at(0), "the peer is off");
        waited = *outbox_.nextDue() - now_;
        EXPECT_DOUBLE_EQ(waited, std::min(8.0, 2.0 * (1 << std::min(n, 10)))) << n;
        EXPECT_TRUE(outbox_.claim("a").empty());
        now_ += waited;
    }
    EXPECT_EQ(item(id).state, DeliveryState::queued);
    EXPECT_EQ(item(id).reason, "the peer is off");
}

TEST_F(OutboxRows, WhatIsRefusedSaysWhyAndStaysUntilAPersonDecides)
{
    const int id = queue({"1.1"}).at(0).id;
    outbox_.refuse(outbox_.claim("a").at(0), "the peer takes no PDF");
    EXPECT_TRUE(outbox_.claim("a").empty());
    EXPECT_FALSE(outbox_.nextDue());
    EXPECT_EQ(queue({"1.1"}).at(0).state, DeliveryState::refused) << "queueing it again changes nothing";
    EXPECT_EQ(item(id).reason, "the peer takes no PDF");
    outbox_.retry(id);
    EXPECT_EQ(outbox_.claim("a").size(), 1u);
    outbox_.drop(id);
    EXPECT_FALSE(outbox_.find(id));
    EXPECT_EQ(codeOf([&] { outbox_.retry(id); }), ErrorCode::not_found);
    EXPECT_EQ(codeOf([&] { outbox_.drop(id); }), ErrorCode::not_found);
    EXPECT_THAT(auditTrail(store_, "c1").back().event, HasSubstr("taken out of the outbox"));
}

TEST_F(OutboxRows, TakesOverFromASenderThatDiedAndRefusesItAfterwards)
{
    queue({"1.1", "1.2"});
    const auto lost = outbox_.claim("a");
    outbox_.markStored(lost.at(1));
    now_ += options_.lease_s + 1;
    const auto taken = outbox_.claim("b");
    ASSERT_EQ(taken.size(), 2u);
    EXPECT_FALSE(taken.at(0).stored);
    EXPECT_TRUE(taken.at(1).stored) << "what the peer took is not sent again";
    EXPECT_EQ(codeOf([&] { outbox_.markStored(lost.at(0)); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { outbox_.refuse(lost.at(0), "x"); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { outbox_.markUnconfirmed(lost.at(1)); }), ErrorCode::lease_lost);
    EXPECT_TRUE(outbox_.beginCommitment(lost, "2.25.1").empty());
}

TEST_F(OutboxRows, OfAllThatAPeerTookWhatIsStillTheSendersIsMarked)
{
    queue({"1.1", "1.2", "1.3"});
    const auto claimed = outbox_.claim("a");
    outbox_.drop(claimed.at(1).id);
    outbox_.markStored(claimed);
    EXPECT_TRUE(item(claimed.at(0).id).stored);
    EXPECT_TRUE(item(claimed.at(2).id).stored);
    now_ += options_.lease_s + 1;
    outbox_.claim("b");
    outbox_.postpone(outbox_.items().at(0), "the peer lost it");
    outbox_.markStored(claimed);
    EXPECT_EQ(item(claimed.at(0).id).attempts, 1) << "another sender's word stands";
}

TEST_F(OutboxRows, ARenewedLeaseLives)
{
    queue({"1.1"});
    const auto held = outbox_.claim("a");
    now_ += options_.lease_s - 1;
    outbox_.renew(held);
    now_ += options_.lease_s - 1;
    EXPECT_TRUE(outbox_.claim("b").empty());
    outbox_.markStored(held.at(0));
}

TEST_F(OutboxRows, ASenderWhoseClockIsAheadHidesNoItem)
{
    queue({"1.1", "1.2"});
    OutboxOptions single = options_;
    single.at_once = 1;
    Outbox ahead(store_.database(), single, [this] { return now_ + 3600; });
    ASSERT_EQ(ahead.claim("a").size(), 1u);
    ahead.postpone(ahead.claim("a").at(0), "busy");
    EXPECT_EQ(outbox_.claim("b").size(), 1u) << "a lease that ends in an hour is none";
    now_ += options_.commitment_s + 1;
    EXPECT_EQ(outbox_.claim("b").size(), 2u);
}

TEST_F(OutboxRows, LivesInAStoreThatAnEarlierViconMade)
{
    constexpr int kBeforeTheOutbox = 2;
    const support::TemporaryFolder folder;
    CaseStore migrated(support::storeOfVersion(kBeforeTheOutbox, folder / "store"));
    const auto file = migrated.caseFolder("c1") / "report" / "1.1.dcm";
    makePrivateFolder(file.parent_path());
    replaceFile(file, "object");
    EXPECT_EQ(queueObjects(migrated, "c1", "main", {{file, "1.2.840.10008.5.1.4.1.1.104.1", "1.1"}}).size(), 1u);
    EXPECT_EQ(Outbox(migrated.database(), options_).items("c1").size(), 1u);
}

}  // namespace
}  // namespace vicon
