#include "vicon/cases/corrections.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "case_fixture.h"
#include "vicon/cases/organs.h"
#include "vicon/core/error.h"
#include "vicon/core/volume.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon {
namespace {

namespace fs = std::filesystem;

class CorrectionsOfAScan : public testing::Test {
protected:
    test::StoreOfOneScan one_;

    Corrections kept() const { return readCorrections(one_.scanFolder()); }
    JobState state() { return JobQueue(one_.store.database(), {}).find("c1", "s1")->state; }
};

TEST_F(CorrectionsOfAScan, AreKeptAddedAndForgotten)
{
    EXPECT_TRUE(kept().empty());
    addCorrections(one_.store, {}, one_.scan, {.add = {{1, 2, 3}}});
    addCorrections(one_.store, {}, one_.scan, {.cut = {{4, 5, 6.25}}, .drop = {{7, 8, 9}}});
    EXPECT_EQ(kept(), (Corrections{{{1, 2, 3}}, {{4, 5, 6.25}}, {{7, 8, 9}}}));
    replaceCorrections(one_.store, {}, one_.scan, {.drop = {{7, 8, 9}}});
    EXPECT_EQ(kept(), (Corrections{.drop = {{7, 8, 9}}}));
    replaceCorrections(one_.store, {}, one_.scan, {});
    EXPECT_FALSE(fs::exists(one_.scanFolder() / "corrections.json"));
}

TEST_F(CorrectionsOfAScan, OfTwoReadersAtOnceAreAllKept)
{
    constexpr int kOfEach = 20;
    const auto correct = [&](double x) {
        CaseStore own(one_.store.place());
        for (int n = 0; n < kOfEach; ++n)
            addCorrections(own, {}, one_.scan, {.cut = {{x, double(n), 0}}});
    };
    std::thread other([&] { correct(1); });
    correct(2);
    other.join();
    EXPECT_EQ(kept().cut.size(), 2u * kOfEach);
}

TEST_F(CorrectionsOfAScan, AreReplacedOnlyWhereNobodyChangedThemMeanwhile)
{
    const Corrections seen{.cut = {{1, 2, 3}}}, after{.cut = {{1, 2, 3}}, .drop = {{7, 8, 9}}};
    addCorrections(one_.store, {}, one_.scan, seen);
    replaceCorrections(one_.store, {}, one_.scan, after, seen);
    EXPECT_EQ(kept(), after);
    addCorrections(one_.store, {}, one_.scan, {.add = {{4, 5, 6}}});  // another reader's
    const Corrections both = kept();
    EXPECT_THROW(replaceCorrections(one_.store, {}, one_.scan, seen, after), Error);
    EXPECT_EQ(kept(), both);
}

TEST_F(CorrectionsOfAScan, OutsideTheScanAreRefusedAndChangeNothing)
{
    Grid grid;
    grid.size = {10, 10, 10};
    scan_files::writeVolume(one_.scanFolder() / "volume.mha", HuVolume(grid), scan_files::Packing::raw);
    addCorrections(one_.store, {}, one_.scan, {.cut = {{9, 9, 9}}});
    try {
        addCorrections(one_.store, {}, one_.scan, {.drop = {{0, 0, 11}}});
        FAIL() << "it was taken";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::wrong_use);
        EXPECT_EQ(e.subject(), "--drop");
        EXPECT_NE(std::string(e.what()).find("the point 0.0,0.0,11.0 lies outside the scan"), std::string::npos)
            << e.what();
    }
    EXPECT_EQ(kept(), (Corrections{.cut = {{9, 9, 9}}}));
}

TEST_F(CorrectionsOfAScan, OfAnotherOrganAreRefused)
{
    one_.record("segment", {{"verdict", "aorta"}, {"organ", "aorta"}});
    EXPECT_EQ(organOf(one_.store, one_.scan), Organ("aorta"));
    EXPECT_THROW(addCorrections(one_.store, {}, one_.scan, {.cut = {{1, 2, 3}}}), Error);
}

TEST_F(CorrectionsOfAScan, PutAFailedJobBackIntoTheQueue)
{
    one_.fail();
    ASSERT_EQ(state(), JobState::failed);
    addCorrections(one_.store, {}, one_.scan, {.cut = {{1, 2, 3}}});
    EXPECT_EQ(state(), JobState::queued);
}

TEST_F(CorrectionsOfAScan, ThatCannotBeUnderstoodAreSaidToBe)
{
    for (const char* text : {"{", "[1]", R"({"cut": [[1, 2]]})", R"({"cut": [[1, 2, "3"]]})"}) {
        std::ofstream(one_.scanFolder() / "corrections.json") << text;
        EXPECT_THROW(kept(), Error) << text;
    }
}

}  // namespace
}  // namespace vicon
