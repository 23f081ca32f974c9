// The worklist by pages, and what is searched in it.
#include <gmock/gmock.h>
#include <soci/soci.h>

#include <map>

#include "case_fixture.h"
#include "search_words.h"
#include "vicon/cases/worklist.h"

namespace vicon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class WorklistPages : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    CaseStore store_{support::storePlace(folder_ / "store")};

    void add(const std::string& id, const Patient& patient, const std::string& accession = {})
    {
        CaseRecord a_case{.id = id, .patient = patient, .created = "2026-01-0" + id.substr(1) + "T00:00:00Z"};
        a_case.study.uid = "1.2." + id;
        a_case.study.date = "2026010" + id.substr(1);
        a_case.study.accession_number = accession;
        makePrivateFolder(store_.scanFolder(id, "s1"));
        store_.addScan(a_case, {.id = "s1", .case_id = id}, {}, true);
    }
    void setRole(const std::string& id, ScanRole role)
    {
        store_.database().write([&](soci::session& sql) {
            sql << "UPDATE scans SET role = :role WHERE case_id = :id", soci::use(nameOf(role)), soci::use(id);
        });
    }
    static std::vector<std::string> idsOf(const WorklistPage& page)
    {
        std::vector<std::string> ids;
        for (const WorklistCase& c : page.cases)
            ids.push_back(c.record.id);
        return ids;
    }
    std::vector<std::string> found(const std::string& words)
    {
        return idsOf(makeWorklistPage(store_, {}, {.words = words}));
    }
};

TEST_F(WorklistPages, AreSearchedByTheFirstHundredWordsOfAName)
{
    std::string name;
    for (int n = 0; n < 100'000; ++n)
        name += "w" + std::to_string(n) + " ";
    add("c1", {.id = "P1", .name = name});
    EXPECT_THAT(found("w99"), ElementsAre("c1"));
    EXPECT_THAT(found("w100"), IsEmpty());
    EXPECT_THAT(found("p1"), ElementsAre("c1"));
    int rows = 0;
    store_.database().session() << "SELECT COUNT(*) FROM case_words", soci::into(rows);
    EXPECT_LT(rows, 110);
}

TEST_F(WorklistPages, GiveEveryCaseOnceTheNewestFirst)
{
    for (const char* id : {"c2", "c1", "c5", "c3", "c4"})
        add(id, {});
    const WorklistPage first = makeWorklistPage(store_, {}, {.most = 2});
    EXPECT_THAT(idsOf(first), ElementsAre("c5", "c4"));
    EXPECT_TRUE(first.more);
    const WorklistPage second = makeWorklistPage(store_, {}, {.most = 2, .after = "c4"});
    EXPECT_THAT(idsOf(second), ElementsAre("c3", "c2"));
    EXPECT_TRUE(second.more);
    const WorklistPage last = makeWorklistPage(store_, {}, {.most = 2, .after = "c2"});
    EXPECT_THAT(idsOf(last), ElementsAre("c1"));
    EXPECT_FALSE(last.more);
    EXPECT_THAT(makeWorklistPage(store_, {}, {.most = 2, .after = "c1"}).cases, IsEmpty());
}

TEST_F(WorklistPages, SayOfACaseWhatItSaysAlone)
{
    add("c1", {"P1", "Doe^Jane", "19600101", "F"});
    add("c2", {"P2", "Roe^Ann", "19610101", "F"});
    JobQueue queue(store_.database(), {});
    const Job job = *queue.claim(thisOwner());
    queue.commitStep(job, {.step = "segment", .version = 1, .digest = "d", .result = {{"verdict", "colon"}}});
    queue.renew(job, "skeleton", 0.5);
    store_.saveMarker("c1", {.scan_id = "s1"});
    const auto alone = [&](const std::string& id) {
        return toJson(std::vector{makeWorklistCase(store_, {}, store_.requireCase(id))})["cases"][0];
    };
    const auto page = toJson(makeWorklistPage(store_, {}, {}).cases)["cases"];
    EXPECT_EQ(page[0], alone("c2"));
    EXPECT_EQ(page[1], alone("c1"));
    EXPECT_EQ(page[1]["markers"], 1);
    EXPECT_EQ(page[1]["scans"][0]["step"], "skeleton");
    EXPECT_EQ(page[1]["scans"][0]["progress"], 0.5);
}

TEST_F(WorklistPages, FindByTheBeginningOfAnythingThatOneKnowsOfACase)
{
    add("c1", {"P17", "M\xC3\xBCller^Anna Maria", "19600101", "F"}, "A-88");
    add("c2", {"P18", "Mueller^Anna", "19610101", "F"});
    EXPECT_THAT(found("m\xC3\x9CLL"), ElementsAre("c1")) << "also a letter that is not ASCII, small or large";
    EXPECT_THAT(found("anna"), UnorderedElementsAre("c1", "c2"));
    EXPECT_THAT(found("p1"), UnorderedElementsAre("c1", "c2"));
    EXPECT_THAT(found("p18"), ElementsAre("c2"));
    EXPECT_THAT(found("a-88"), ElementsAre("c1"));
    EXPECT_THAT(found("20260102"), ElementsAre("c2")) << "the study's date";
    EXPECT_THAT(found("c2"), ElementsAre("c2"));
    EXPECT_THAT(found("anna mue"), ElementsAre("c2")) << "all words";
    EXPECT_THAT(found("ari"), IsEmpty()) << "not from the middle of a word";
    EXPECT_THAT(found("nobody"), IsEmpty());
    EXPECT_EQ(found("  ").size(), 2u);
}

TEST(WorklistSearch, CountsNoFurtherThanTheRarestWordNeeds)
{
    int read = 0;
    const std::map<std::string, int> all{{"one", 1}, {"some", 70}, {"many", 100'000}, {"more", 200'000}};
    const auto count = [&](const std::string& word, int limit) {
        const int counted = std::min(all.at(word), limit);
        read += counted;
        return counted;
    };
    EXPECT_EQ(rarestOf({"many", "one"}, 2000, count), "one");
    EXPECT_LE(read, 100) << "rows, which an index may have to look for all over the table";
    EXPECT_EQ(rarestOf({"some", "many"}, 2000, count), "some");
    EXPECT_EQ(rarestOf({"many", "more"}, 2000, count), "many") << "either would do";
    read = 0;
    EXPECT_EQ(rarestOf({"more"}, 2000, count), "more");
    EXPECT_EQ(read, 0) << "there is no choice";
}

TEST_F(WorklistPages, FindNoMoreThanIsWantedAndEachOnce)
{
    for (const char* id : {"c1", "c2", "c3"})
        add(id, {"P", "Lee^Leeann^Lee", "19600101", "F"});
    const WorklistPage page = makeWorklistPage(store_, {}, {.most = 2, .words = "lee"});
    EXPECT_EQ(idsOf(page).size(), 2u);
    EXPECT_TRUE(page.more);
    EXPECT_THAT(found("lee"), UnorderedElementsAre("c1", "c2", "c3"));
}

TEST_F(WorklistPages, GiveOnlyCasesThatAreInTheWantedState)
{
    for (const char* id : {"c1", "c2", "c3", "c4", "c5"})
        add(id, {"P" + std::string(id), "Doe^Jane", "19600101", "F"});
    JobQueue queue(store_.database(), {});
    queue.complete(*queue.claim(thisOwner()));
    queue.fail(*queue.claim(thisOwner()), "broken", true);
    ASSERT_TRUE(queue.claim(thisOwner()));
    const auto in = [&](WorkState state, const std::string& words = {}) {
        return idsOf(makeWorklistPage(store_, {}, {.words = words, .state = state}));
    };
    EXPECT_THAT(in(WorkState::done), ElementsAre("c1"));
    EXPECT_THAT(in(WorkState::failed), ElementsAre("c2"));
    EXPECT_THAT(in(WorkState::running), ElementsAre("c3"));
    EXPECT_THAT(in(WorkState::queued), ElementsAre("c5", "c4"));
    EXPECT_THAT(in(WorkState::kept), IsEmpty());
    EXPECT_THAT(in(WorkState::queued, "jane"), UnorderedElementsAre("c4", "c5"));
    EXPECT_THAT(in(WorkState::queued, "pc1"), IsEmpty());
    const WorklistPage first = makeWorklistPage(store_, {}, {.most = 1, .state = WorkState::queued});
    EXPECT_THAT(idsOf(first), ElementsAre("c5"));
    EXPECT_TRUE(first.more);
    const WorklistPage last = makeWorklistPage(store_, {}, {.most = 1, .after = "c5", .state = WorkState::queued});
    EXPECT_THAT(idsOf(last), ElementsAre("c4"));
    EXPECT_FALSE(last.more);
}

TEST_F(WorklistPages, GiveCasesThatNoStepIsDoneOnWhateverWasDoneBefore)
{
    for (const char* id : {"c1", "c2", "c3", "c4"})
        add(id, {});
    JobQueue queue(store_.database(), {});
    queue.complete(*queue.claim(thisOwner()));
    setRole("c1", ScanRole::refused);  // late images spoilt it
    store_.database().write([&](soci::session& sql) { sql << "DELETE FROM jobs WHERE case_id IN ('c2', 'c4')"; });
    setRole("c2", ScanRole::kept);
    setRole("c4", ScanRole::kept);
    const auto in = [&](WorkState state) { return idsOf(makeWorklistPage(store_, {}, {.state = state})); };
    EXPECT_THAT(in(WorkState::refused), ElementsAre("c1"));
    EXPECT_THAT(in(WorkState::kept), ElementsAre("c4", "c2"));
    EXPECT_THAT(in(WorkState::queued), ElementsAre("c3"));
}

TEST(WorklistSearch, FindsCasesOfAStoreThatAnEarlierViconMade)
{
    constexpr int kBeforeTheSearch = 3;
    const support::TemporaryFolder folder;
    const StorePlace place = support::storeOfVersion(
        kBeforeTheSearch, folder / "store",
        {"INSERT INTO cases (id, study_uid, patient_id, patient_name, birth_date, sex, study, flags, created)"
         " VALUES ('c1', '1.2', 'P1', 'Doe^Jane', '', 'F', '{}', '[]', '2026-01-02T03:04:05Z')"});
    CaseStore store(place);
    EXPECT_EQ(makeWorklistPage(store, {}, {.words = "jane"}).cases.size(), 1u);
}

}  // namespace
}  // namespace vicon
