// Which studies of an archive are fetched unasked.
#include "vicon/ingest/watch.h"

#include <gtest/gtest.h>

#include <fstream>

#include "vicon/core/error.h"
#include "vicon/ingest/watched_studies.h"
#include "vicon/support/support.h"

namespace vicon::test {
namespace {

TEST(WatchRule, AStudyFitsByOneSeriesThatFitsAllOfIt)
{
    const ingest::FoundStudy study{.study_uid = "1.2", .description = "CT Colonography"};
    const std::vector<ingest::FoundSeries> series{
        {"1", "CT", "supine 1.0", "COLON", 430}, {"2", "CT", "topogram", "", 2}, {"3", "SR", "dose", "ABDOMEN", 500}};
    ingest::WatchOptions rule;
    EXPECT_TRUE(ingest::fits(rule, study, series));
    rule.descriptions = {"*virtual*", "*COLONOGRAPHY"};
    EXPECT_TRUE(ingest::fits(rule, study, series)) << "the study's, in any case";
    rule.descriptions = {"supine*"};
    EXPECT_TRUE(ingest::fits(rule, study, series)) << "the series'";
    rule.descriptions = {"colon"};
    EXPECT_FALSE(ingest::fits(rule, study, series)) << "a pattern means the whole text";
    rule.descriptions = {};
    rule.body_parts = {"ABDOMEN"};
    EXPECT_FALSE(ingest::fits(rule, study, series)) << "that is another modality's series";
    rule.body_parts = {"ABDOMEN", "COLON"};
    EXPECT_TRUE(ingest::fits(rule, study, series));
    rule.least_slices = 431;
    EXPECT_FALSE(ingest::fits(rule, study, series));
    EXPECT_TRUE(ingest::fits(rule, study, {{"1", "CT", "", "COLON", -1}})) << "the archive does not say how many";
    rule = {.modality = ingest::WatchModality::any};
    EXPECT_TRUE(ingest::fits(rule, study, {{"1", "MR", "", "", 100}}));
    EXPECT_FALSE(ingest::fits(rule, study, {{"1", "US", "", "", 100}})) << "that VICON does not read";
    using Uids = std::vector<std::string>;
    EXPECT_EQ(ingest::imageSeries({}, series), (Uids{"1", "2"}));
    EXPECT_EQ(ingest::reportSeries(series), Uids{"3"});
}

TEST(WatchRule, SeriesOfTheOtherModalityAreNotFetched)
{
    using ingest::WatchModality;
    const std::vector<ingest::FoundSeries> both{{"1", "CT", "", "", 200}, {"2", "MR", "", "", 200}};
    const auto uids = [&](WatchModality modality) { return ingest::imageSeries({.modality = modality}, both); };
    using Uids = std::vector<std::string>;
    EXPECT_EQ(uids(WatchModality::ct), Uids{"1"});
    EXPECT_EQ(uids(WatchModality::mr), Uids{"2"});
    EXPECT_EQ(uids(WatchModality::any), (Uids{"1", "2"}));
    EXPECT_FALSE(ingest::fits({.modality = WatchModality::mr}, {}, {both[0]}));
    EXPECT_FALSE(ingest::fits({.modality = WatchModality::ct}, {}, {both[1]}));
    EXPECT_EQ(ingest::modalityAsked({.modality = WatchModality::ct}), "CT");
    EXPECT_EQ(ingest::modalityAsked({.modality = WatchModality::mr}), "MR");
    EXPECT_EQ(ingest::modalityAsked({.modality = WatchModality::any}), "") << "asked for all, chosen afterwards";
}

TEST(WatchRule, LooksBackFromTheNewestStudyOrTodayWhicheverIsEarlier)
{
    ingest::WatchOptions rule;
    rule.days = 3;
    EXPECT_EQ(ingest::watchedSince(rule, "20260302", ""), "20260227");
    EXPECT_EQ(ingest::watchedSince(rule, "20260302", "20260110"), "20260107") << "after a pause";
    EXPECT_EQ(ingest::watchedSince(rule, "20300101", "20260302"), "20260227") << "the clock is ahead";
    EXPECT_EQ(ingest::watchedSince(rule, "20260302", "20990101"), "20260227") << "a study of the future";
}

TEST(WatchedStudies, AreDueOnceAndAgainWhenTheyHaveGrown)
{
    const support::TemporaryFolder store;
    {
        ingest::WatchedStudies watched(store.path(), "a/peer");
        EXPECT_FALSE(watched.note("1.2", "20260102", 5)) << "it may still grow";
        EXPECT_FALSE(watched.note("1.2", "20260102", 12)) << "it did";
        EXPECT_TRUE(watched.note("1.2", "20260102", 12));
        EXPECT_TRUE(watched.note("1.2", "20260102", 12)) << "it was not fetched";
        EXPECT_TRUE(watched.awaitsFetch("1.2"));
        EXPECT_FALSE(watched.awaitsPriors("1.2")) << "the study comes first";
        watched.markFetched("1.2", 12);
        EXPECT_FALSE(watched.awaitsFetch("1.2"));
        EXPECT_THROW(ingest::WatchedStudies(store.path(), "a/peer"), Error) << "one at a time";
        EXPECT_EQ(ingest::WatchedStudies(store.path(), "another").newestDate(), "");
    }
    EXPECT_EQ(support::schemaFaults("watched", support::jsonFilesIn(store.path() / "watch")), "");
    ingest::WatchedStudies watched(store.path(), "a/peer");
    EXPECT_EQ(watched.newestDate(), "20260102");
    EXPECT_FALSE(watched.note("1.2", "20260102", 12)) << "also after a restart";
    EXPECT_TRUE(watched.awaitsPriors("1.2")) << "what ended before them has them still to fetch";
    watched.markPriorsFetched("1.2");
    EXPECT_FALSE(watched.awaitsPriors("1.2"));
    EXPECT_FALSE(watched.note("1.2", "20260102", 13));
    EXPECT_TRUE(watched.note("1.2", "20260102", 13));
}

TEST(WatchedStudies, ADamagedListIsSaid)
{
    const support::TemporaryFolder store;
    {
        ingest::WatchedStudies(store.path(), "peer").note("1.2", "20260102", 5);
    }
    for (const auto& entry : std::filesystem::directory_iterator(store.path() / "watch"))
        if (entry.path().extension() == ".json")
            std::ofstream(entry.path()) << "{";
    EXPECT_THROW(ingest::WatchedStudies(store.path(), "peer"), Error);
}

}  // namespace
}  // namespace vicon::test
