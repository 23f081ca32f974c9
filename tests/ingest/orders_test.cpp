// The orders of cases, by two worklist servers that are not ours.
#include "vicon/ingest/orders.h"

#include <gmock/gmock.h>

#include "dicom_writer.h"
#include "store_fixture.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/worklist.h"
#include "vicon/scan_files/description_file.h"
#include "worklist_server.h"

namespace vicon::test {
namespace {

using ingest::ScheduledStep;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

CaseRecord caseOf(const std::string& accession_number = "")
{
    CaseRecord c;
    c.patient = {"P1", "Doe^Jane", "19600101", "F"};
    c.study.uid = "1.2.3";
    c.study.date = "20260102";
    c.study.accession_number = accession_number;
    return c;
}

ScheduledStep stepOf(const std::string& accession_number)
{
    ScheduledStep step;
    step.patient = {"P1", "DOE^JANE", "19600101", "F"};
    step.study_uid = "1.2.9";
    step.accession_number = accession_number;
    step.modality = "CT";
    step.date = "20260102";
    return step;
}

TEST(OrderChoice, IsByStudyThenByAccessionNumberThenByTheDay)
{
    ScheduledStep of_study = stepOf("A1"), of_number = stepOf("A2"), of_day = stepOf("A3");
    of_study.study_uid = "1.2.3";
    of_study.date = of_number.date = "20250101";
    const auto chosen = [](const CaseRecord& c, const std::vector<ScheduledStep>& steps) {
        const auto choice = ingest::chooseOrder(c, steps, {});
        EXPECT_THAT(choice.doubts, IsEmpty());
        return choice.step ? choice.step->accession_number : "none";
    };
    EXPECT_EQ(chosen(caseOf("A2"), {of_day, of_number, of_study}), "A1");
    EXPECT_EQ(chosen(caseOf("A2"), {of_day, of_number}), "A2");
    EXPECT_EQ(chosen(caseOf(), {of_day, of_number}), "A3");
    EXPECT_EQ(chosen(caseOf(), {of_number}), "none") << "a year before";
    of_day.modality = "MR";
    EXPECT_EQ(chosen(caseOf(), {of_day}), "none");
    ScheduledStep night = stepOf("A4");
    night.date = "20260101";
    EXPECT_EQ(chosen(caseOf(), {night}), "A4");
    night.date = "20251231";
    EXPECT_EQ(chosen(caseOf(), {night}), "none");
}

TEST(OrderChoice, IsNoneAmongSeveralAndNeverAnotherPatients)
{
    ScheduledStep second_step = stepOf("A1");
    second_step.time = "11";
    EXPECT_TRUE(ingest::chooseOrder(caseOf(), {stepOf("A1"), second_step}, {}).step) << "two steps of one order";
    const auto several = ingest::chooseOrder(caseOf(), {stepOf("A1"), stepOf("A2")}, {});
    EXPECT_FALSE(several.step);
    EXPECT_THAT(several.doubts, ElementsAre(HasSubstr("2 orders")));
    ScheduledStep other = stepOf("A1");
    other.patient.birth_date = "19700101";
    const auto same_id = ingest::chooseOrder(caseOf(), {other}, {});
    EXPECT_FALSE(same_id.step);
    EXPECT_THAT(same_id.doubts, ElementsAre(HasSubstr("another patient under this patient ID")));
    other.patient = {"P2", "Roe^Richard", "", ""};
    const auto same_number = ingest::chooseOrder(caseOf("A1"), {other}, {});
    EXPECT_FALSE(same_number.step);
    EXPECT_THAT(same_number.doubts, ElementsAre(HasSubstr("this study for another patient")));
}

/// A case of 2 January 2026 and servers that know what was scheduled.
class Orders : public StoreFixture {
protected:
    WorklistServer ris{folder / "ris"};
    Orthanc orthanc{folder / "orthanc", 0, {}, [this] {
                        return nlohmann::json{
                            {"DicomAlwaysAllowFindWorklist", true},
                            {"Plugins", {"/usr/share/orthanc/plugins/libModalityWorklists.so"}},
                            {"Worklists", {{"Enable", true}, {"Database", ris.scheduled().string()}}}};
                    }()};
    ingest::OrderOptions rule;

    void SetUp() override
    {
        ASSERT_TRUE(ris.answers()) << readFile(folder / "ris/log");
        ASSERT_TRUE(orthanc.answers()) << readFile(folder / "orthanc/log");
    }
    void schedule(const std::string& name, const Scheduled& about)
    {
        writeScheduled(ris.scheduled() / (name + ".wl"), about);
    }
    std::string importCase(const SeriesSpec& spec = {})
    {
        EXPECT_EQ(import(writeSeries(folder / ("in" + spec.study_uid), spec)).scans_stored, 1);
        return CaseStore::caseIdFor(spec.study_uid);
    }
    std::string onlyScanOf(const std::string& case_id) { return store.scans(case_id).at(0).id; }
    ingest::OrderOutcome take(const std::string& case_id, const ingest::Peer& peer)
    {
        return ingest::takeOrder(store, case_id, peer, rule, "VICON", quiet);
    }
};

TEST_F(Orders, ServersTellWhatIsScheduled)
{
    schedule("1", {});
    schedule("2", {.patient_id = "P2", .patient_name = "Müller^Åsa", .accession_number = "A78", .date = "20260105"});
    for (const ingest::Peer& peer : {ris.peer(), orthanc.peer()}) {
        const auto found = [&](const ingest::StudyQuery& query) {
            std::vector<std::string> numbers;
            for (const ScheduledStep& step : ingest::findScheduledSteps(peer, query, "VICON", quiet))
                numbers.push_back(step.accession_number);
            return numbers;
        };
        EXPECT_THAT(found({}), ElementsAre("A77", "A78")) << peer.name;
        EXPECT_THAT(found({.patient_id = "P2"}), ElementsAre("A78"));
        EXPECT_THAT(found({.dates = "2026-01-03-"}), ElementsAre("A78"));
        EXPECT_THAT(found({.accession_number = "A77"}), ElementsAre("A77"));
        EXPECT_THAT(found({.modality = "MR"}), IsEmpty());
        const auto one = ingest::findScheduledSteps(peer, {.patient_id = "P2"}, "VICON", quiet).at(0);
        EXPECT_EQ(one.patient.name, "Müller^Åsa");
        EXPECT_EQ(one.referring_physician, "Weiss^Anna");
        EXPECT_EQ(one.procedure, "CT colonography");
        EXPECT_EQ(one.procedure_id, "RP1");
        EXPECT_EQ(one.date, "20260105");
        EXPECT_EQ(one.station, "CT1");
    }
    EXPECT_THROW(ingest::findScheduledSteps({"nobody", "127.0.0.1", "X", freePort()}, {}, "VICON", quiet), Error);
}

TEST_F(Orders, ACaseTakesWhatItsImagesDoNotSay)
{
    schedule("1", {});
    int number = 0;
    for (const ingest::Peer& peer : {ris.peer(), orthanc.peer()}) {
        SeriesSpec spec;
        spec.study_uid += "." + std::to_string(++number);
        spec.series_uid += "." + std::to_string(number);
        const std::string id = importCase(spec);
        const auto outcome = take(id, peer);
        EXPECT_THAT(outcome.taken, ElementsAre("accession number", "referring physician")) << peer.name;
        EXPECT_THAT(outcome.flagged, IsEmpty());
        const CaseRecord c = store.requireCase(id);
        EXPECT_EQ(c.study.accession_number, "A77");
        EXPECT_EQ(c.study.referring_physician, "Weiss^Anna");
        EXPECT_EQ(orderOf(store, id)->procedure, "CT colonography");
        EXPECT_EQ(auditTrail(store, id).back().event, "order taken");
        EXPECT_TRUE(
            scan_files::isDescribedBy(store.scanFolder(id, onlyScanOf(id)), store.describeScan(id, onlyScanOf(id))));
        EXPECT_EQ(store.describeScan(id, onlyScanOf(id)).study.accession_number, "A77");
    }
    EXPECT_EQ(makeWorklistPage(store, {}, {.words = "a77"}).cases.size(), 2U) << "it is found by it";
}

TEST_F(Orders, WhatTheImagesSayStaysAndIsCompared)
{
    schedule("1", {});
    const std::string id = importCase({.accession_number = "B1", .referring_physician = "WEISS^ANNA^^DR"});
    const auto outcome = take(id, ris.peer());
    EXPECT_THAT(outcome.taken, IsEmpty());
    EXPECT_THAT(outcome.flagged, ElementsAre("the modality worklist has accession number 'A77', the images have 'B1'",
                                             HasSubstr("the modality worklist has referring physician 'Weiss^Anna'")));
    EXPECT_EQ(store.requireCase(id).study.accession_number, "B1");
    EXPECT_EQ(store.requireCase(id).flags, outcome.flagged);
    take(id, ris.peer());
    EXPECT_EQ(store.requireCase(id).flags.size(), 2U) << "said once";
}

TEST_F(Orders, ASignedReportIsNeverAltered)
{
    schedule("1", {});
    const std::string id = importCase();
    store.database().session() << "INSERT INTO report_versions (case_id, version, state, replaces, reason, person, at,"
                                  " software, digest, content, file, file_sha256)"
                                  " VALUES (:c, 1, 'signed', 0, '', 'a', '', '', '', '{}', '', '')",
        soci::use(id);
    EXPECT_THAT(take(id, ris.peer()).flagged, testing::Each(HasSubstr("came after the report was signed")));
    EXPECT_EQ(store.requireCase(id).study.accession_number, "");
}

TEST_F(Orders, YoungCasesWithoutOneAreAskedFor)
{
    const std::string id = importCase();
    rule.ask_days = 365;
    const auto ids = [&] {
        std::vector<std::string> all;
        for (const CaseRecord& c : ingest::casesToAskFor(store, rule))
            all.push_back(c.id);
        return all;
    };
    std::string today = nowUtc().substr(0, 10);
    std::erase(today, '-');
    SeriesSpec new_one;
    new_one.study_uid += ".2";
    new_one.series_uid += ".2";
    new_one.study_date = today;
    const std::string young = importCase(new_one);
    rule.ask_days = 3;
    EXPECT_THAT(ids(), ElementsAre(young));
    EXPECT_FALSE(take(young, ris.peer()).order);
    EXPECT_THAT(ids(), ElementsAre(young)) << "it may still be ordered";
    schedule("1", {.date = today});
    EXPECT_TRUE(take(young, ris.peer()).order);
    EXPECT_THAT(ids(), IsEmpty());
}

}  // namespace
}  // namespace vicon::test
