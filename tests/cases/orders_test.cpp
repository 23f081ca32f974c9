#include "vicon/cases/orders.h"

#include <gmock/gmock.h>

#include "case_fixture.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

class Orders : public testing::Test {
protected:
    test::StoreOfOneScan made_;
    CaseStore& store_ = made_.store;
    CaseRecord with_ = store_.requireCase("c1");
    const Order order_{"ris", "A1", "Weiss^Anna", "RP1", "CT colonography", "blood", {}};

    Orders() { with_.study.accession_number = "A1"; }
    std::vector<CaseRecord> waiting(const std::string& created) { return casesWithoutOrder(store_, "", created); }
};

TEST_F(Orders, AreKeptWithWhatTheCaseHasOfThem)
{
    EXPECT_FALSE(orderOf(store_, "c1"));
    keepOrder(store_, with_, order_, [] {});
    const Order kept = orderOf(store_, "c1").value();
    EXPECT_EQ(kept.referring_physician + kept.procedure + kept.reason, "Weiss^AnnaCT colonographyblood");
    EXPECT_FALSE(kept.taken.empty());
    EXPECT_EQ(store_.requireCase("c1").study.accession_number, "A1");
    EXPECT_EQ(auditTrail(store_, "c1").back().event, "order taken");
    Order again = order_;
    again.reason = "anaemia";
    keepOrder(store_, with_, again, [] {});
    EXPECT_EQ(orderOf(store_, "c1")->reason, "anaemia") << "the last one counts";
}

TEST_F(Orders, BringNoFlagBackThatAPersonTookAwayMeanwhile)
{
    store_.flag("c1", "look");
    with_.flags = store_.requireCase("c1").flags;
    store_.settleFlag("c1", "look");
    store_.flag("c1", "another");
    keepOrder(store_, with_, order_, [] {});
    EXPECT_THAT(store_.requireCase("c1").flags, testing::ElementsAre("another"));
}

TEST_F(Orders, AreNotKeptWhenTheCaseIsNoLongerWhatItWas)
{
    EXPECT_THROW(keepOrder(store_, with_, order_, [] { throw Error(ErrorCode::bad_input, "signed"); }), Error);
    EXPECT_FALSE(orderOf(store_, "c1"));
    EXPECT_EQ(store_.requireCase("c1").study.accession_number, "");
}

TEST_F(Orders, CasesWaitForThemWhileTheyAreYoung)
{
    EXPECT_EQ(waiting("2026-01-02").size(), 1u);
    EXPECT_EQ(waiting("2026-01-03").size(), 0u);
    EXPECT_EQ(casesWithoutOrder(store_, "20260101", "2026-01-02").size(), 0u) << "its study is not dated";
    keepOrder(store_, with_, order_, [] {});
    EXPECT_EQ(waiting("2026-01-02").size(), 0u);
}

}  // namespace
}  // namespace vicon
