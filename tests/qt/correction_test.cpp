#include <QProgressBar>
#include <QTableWidget>

#include "reading.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

TEST_F(Reading, CorrectionsGoToThePipelineAndTheNewResultIsTakenOver)
{
    openCase();
    showList(2);
    auto* bridges = the<QTableWidget>("bridges");
    ASSERT_TRUE(eventually([&] { return bridges->rowCount() == 1; }));
    clickRow(bridges, 0);
    EXPECT_TRUE(eventually([] { return std::abs(station() - 180) < 3; }));
    const auto judged = [&] { return bridges->item(0, 3)->text(); };
    press(window(), "rejectBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "rejected, anna"; })) << judged().toStdString();
    press(window(), "confirmBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "confirmed, anna"; }));
    for (const char* before : {"rejected, anna", "no"}) {
        key(Qt::Key_Z, Qt::ControlModifier);
        EXPECT_TRUE(eventually([&] { return judged() == before; })) << judged().toStdString();
    }
    key(Qt::Key_Y, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return judged() == "rejected, anna"; })) << judged().toStdString();
    key(Qt::Key_End);
    settle();
    press(window(), "correctCut");
    click("coronal", middle("coronal"));
    EXPECT_TRUE(eventually([] { return warning().starts_with("There is no lumen"); })) << "between the two limbs";
    click("overview", {the<QWidget>("overview")->width() / 2, the<QWidget>("overview")->height() / 5});
    ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); }));
    screenshot("corrected");
    ASSERT_TRUE(eventually([] { return !the<QProgressBar>("redo")->isVisible(); }));
    // What was seen is kept with the surface that it was seen on; the new one is another.
    const auto surface = [&] {
        for (const auto& entry : std::filesystem::directory_iterator(store_ / "cases" / test::kCase / "reading"))
            return readFile(entry.path()).substr(0, readFile(entry.path()).find('\n'));
        return std::string();
    };
    const std::filesystem::path reading = store_ / "cases" / test::kCase / "reading";
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(reading) && !surface().empty(); }));
    const std::string before = surface();
    waitForScan();
    EXPECT_LT(length() - station(), 10) << "the eye is where it was";
    closeCase();
    EXPECT_NE(surface(), before);
}

TEST_F(Reading, MarkersGetTheirStationsOnTheNewPathAndEarlierStepsCanStillBeUndone)
{
    openCase();
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    const double there = stored()[0].station_mm;
    {  // as if the path had begun elsewhere so far
        CaseStore other(store_);
        Marker marker = other.markers(test::kCase).front();
        marker.station_mm = there + 70;
        other.saveMarker(test::kCase, marker);
    }
    ASSERT_TRUE(eventually([&] { return std::abs(cell(0, 2).toDouble() - there - 70) < 1; }));
    EXPECT_EQ(warning(), "") << "nobody but the pipeline changed it";
    showList(2);
    press(window(), "correctCut");
    click("overview", {the<QWidget>("overview")->width() / 2, the<QWidget>("overview")->height() / 5});
    ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); })) << warning();
    ASSERT_TRUE(eventually([] { return !the<QProgressBar>("redo")->isVisible(); }));
    waitForScan();
    EXPECT_TRUE(eventually([&] { return std::abs(stored()[0].station_mm - there) < 3 && settled(); }))
        << stored()[0].station_mm << " for " << there;
    EXPECT_EQ(warning(), "");
    const auto corrections = [&] {
        CaseStore store(store_);
        return services_.corrections(store, store.requireScan(test::kCase, test::kSupine));
    };
    EXPECT_EQ(corrections().cut.size(), 1U);
    key(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); })) << warning();
    EXPECT_EQ(corrections(), ScanCorrections{});
    ASSERT_TRUE(eventually([] { return !the<QProgressBar>("redo")->isVisible(); }));
    waitForScan();
    showList(0);
    ASSERT_TRUE(eventually([] { return settled(); }));
    press(window(), "undo");
    EXPECT_TRUE(eventually([&] { return stored().empty() && settled(); })) << warning();
    press(window(), "redo");
    ASSERT_TRUE(eventually([&] { return stored().size() == 1 && settled(); })) << warning();
    EXPECT_NEAR(stored()[0].station_mm, there, 3);
    press(window(), "redo");
    EXPECT_TRUE(eventually([&] { return corrections().cut.size() == 1; })) << warning();
}

TEST_F(Reading, ACorrectionThatAnotherReaderChangedIsNotTakenBack)
{
    openCase();
    showList(2);
    press(window(), "correctCut");
    click("overview", {the<QWidget>("overview")->width() / 2, the<QWidget>("overview")->height() / 5});
    ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); })) << warning();
    ASSERT_TRUE(eventually([] { return !the<QProgressBar>("redo")->isVisible(); }));
    waitForScan();
    const auto corrections = [&](const ScanCorrections* set) {
        CaseStore other(store_);
        const ScanRecord scan = other.requireScan(test::kCase, test::kSupine);
        if (set)
            services_.correct(other, scan, *set);
        return services_.corrections(other, scan);
    };
    ScanCorrections his = corrections(nullptr);
    ASSERT_EQ(his.cut.size(), 1U);
    his.drop.push_back({0, 0, 0});
    corrections(&his);
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(eventually([] { return warning().find("changed by another reader") != std::string::npos; }));
    EXPECT_EQ(corrections(nullptr), his);
    EXPECT_FALSE(the<QProgressBar>("redo")->isVisible()) << "nothing is done again";
    screenshot("correction_conflict");
    // A bridge's verdict likewise.
    auto* bridges = the<QTableWidget>("bridges");
    ASSERT_TRUE(eventually([&] { return bridges->rowCount() == 1; }));
    clickRow(bridges, 0);
    press(window(), "rejectBridge");
    const auto judged = [&] { return bridges->item(0, 3)->text(); };
    ASSERT_TRUE(eventually([&] { return judged() == "rejected, anna"; }));
    {
        CaseStore other(store_);
        const ScanRecord scan = other.requireScan(test::kCase, test::kSupine);
        BridgeRow bridge = services_.bridges(other, scan).front();
        bridge.verdict = "confirmed";
        bridge.by = "bert";
        services_.review_bridge(other, scan, bridge);
    }
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(eventually([] { return warning().find("this bridge's verdict was changed") != std::string::npos; }))
        << warning();
    EXPECT_TRUE(eventually([&] { return judged() == "confirmed, bert"; })) << "the list shows it as it is now";
}

}  // namespace
}  // namespace vicon::viewer
