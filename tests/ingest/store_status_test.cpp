#include <gtest/gtest.h>

#include "import_reporter.h"
#include "outcomes.h"
#include "vicon/ingest/query.h"

namespace vicon::ingest {
namespace {

TEST(StoreStatus, WhatThePeerHadBeforeIsThere)
{
    for (const unsigned status : {0x0000U, 0xb000U, 0xb007U, 0x0111U}) {
        EXPECT_TRUE(isTaken(status)) << status;
        EXPECT_FALSE(isForGood(status)) << status;
    }
    for (const unsigned status : {0xa700U, 0xa900U, 0xc000U, 0x0122U, 0x0124U})
        EXPECT_FALSE(isTaken(status)) << status;
    EXPECT_FALSE(isForGood(0xa700)) << "its disk may have room tomorrow";
}

TEST(PeersDates, AreAskedForOnlyWhereTheyAreDays)
{
    EXPECT_TRUE(isDicomDate("20260228"));
    for (const char* none : {"", "20261200", "20261301", "2026", "2026-02-28", "20260228 ", "unknown1"})
        EXPECT_FALSE(isDicomDate(none)) << none;
}

TEST(Notes, OfManyObjectsAreCutAndSaySo)
{
    nlohmann::json notes = nlohmann::json::array();
    for (int n = 0; n < 1000; ++n)
        addNote(notes, noteOf(std::to_string(n), "truncated after " + std::to_string(n) + " bytes"));
    ASSERT_EQ(notes.size(), 201U);
    EXPECT_EQ(notes[0]["object"], "0");
    EXPECT_EQ(notes[200]["why"], "and more than these 200 objects");
    addNote(notes, notes[3]);
    EXPECT_EQ(notes.size(), 201U);
}

TEST(Reports, OfOneFateInASeriesAreOneLine)
{
    ImportReport report;
    Reporter reporter(report);
    for (int n = 0; n < 3; ++n) {
        reporter.object(ImportLine::Kind::refused, "a" + std::to_string(n), "1.2", "truncated");
        reporter.object(ImportLine::Kind::refused, "b" + std::to_string(n), "", "truncated");
    }
    reporter.object(ImportLine::Kind::set_aside, "c", "1.2", "truncated");
    reporter.finish();
    EXPECT_EQ(report.lines.size(), 5U);
    EXPECT_EQ(report.lines[0].text, "truncated (3 files)");
    EXPECT_EQ(report.refused, 6);
    EXPECT_EQ(report.set_aside, 1);
}

}  // namespace
}  // namespace vicon::ingest
