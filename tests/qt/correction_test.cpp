#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QProgressBar>
#include <QStatusBar>
#include <QTableWidget>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <thread>

#include "correcting.h"
#include "test_colon.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using test::Correcting;

TEST_F(Correcting, CorrectionsGoToThePipelineAndTheNewResultIsTakenOver)
{
    // What was seen is kept with the surface that it was seen on, and is written when the case is closed.
    const auto surfaceSeen = [&] {
        for (const auto& entry : std::filesystem::directory_iterator(store_ / "cases" / test::kCase / "reading"))
            return readFile(entry.path()).substr(0, readFile(entry.path()).find('\n'));
        return std::string();
    };
    openCase();
    closeCase();
    const std::string before = surfaceSeen();
    ASSERT_FALSE(before.empty());
    openCase();
    showList(2);
    auto* bridges = the<QTableWidget>("bridges");
    ASSERT_TRUE(eventually([&] { return bridges->rowCount() == 1; }));
    key(Qt::Key_End);
    clickRow(bridges, 0);
    // Off the bridge, which begins at 180 mm, so that it is looked at.
    const auto off_mm = [] { return std::abs(station() - 180); };
    EXPECT_TRUE(eventually([&] { return off_mm() > 5 && off_mm() < 45; })) << station();
    const auto judged = [&] { return bridges->item(0, 3)->text(); };
    press(window(), "rejectBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "rejected, anna"; })) << judged().toStdString();
    press(window(), "confirmBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "confirmed, anna"; }));
    for (const char* before : {"rejected, anna", "not reviewed"}) {
        key(Qt::Key_Z, Qt::ControlModifier);
        EXPECT_TRUE(eventually([&] { return judged() == before; })) << judged().toStdString();
    }
    key(Qt::Key_Y, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return judged() == "rejected, anna"; })) << judged().toStdString();
    key(Qt::Key_End);
    waitUntilQuiet();
    press(window(), "correctCut");
    click("coronal", middle("coronal"));
    EXPECT_TRUE(eventually([] { return warning().starts_with("There is no lumen"); })) << "between the two limbs";
    correctAlongThePath("correctCut");
    screenshot("corrected");
    waitForNewScan();
    EXPECT_LT(length() - station(), 10) << "the eye is where it was";
    closeCase();
    EXPECT_NE(surfaceSeen(), before) << "the new one is another";
}

TEST_F(Correcting, TheFieldOfTheDistanceFollowsAPathThatBecameShorterAndKeepsWhatWasTyped)
{
    openCase();
    auto* field = the<QDoubleSpinBox>("station");
    const double whole = length();
    const auto cut = [] {
        showList(2);
        correctAlongThePath("correctCut");
    };
    const auto undo = [] {
        key(Qt::Key_Z, Qt::ControlModifier);
        ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); })) << warning();
        waitForNewScan();
    };
    for (const bool has_keyboard : {false, true}) {
        SCOPED_TRACE(has_keyboard);
        key(Qt::Key_End);
        ASSERT_TRUE(eventually([&] { return whole - station() < 2 && pictureIsThere(); }));
        cut();
        if (has_keyboard)
            key(Qt::Key_J);
        waitForNewScan();
        ASSERT_LT(length(), whole - 30);
        the<QWidget>("endoscopic")->setFocus();
        EXPECT_NEAR(field->value(), length(), 1) << "the path's new length is no distance typed";
        key(Qt::Key_Home);
        EXPECT_TRUE(eventually([&] { return station() < 2 && field->value() < 2; })) << field->value();
        undo();
    }
    key(Qt::Key_J);
    QTest::keyClicks(field, "50");
    cut();
    waitForNewScan();
    EXPECT_NEAR(field->value(), 50, 0.1) << "typed, and not used yet";
}

TEST_F(Correcting, MarkersGetTheirStationsOnTheNewPathAndEarlierStepsCanStillBeUndone)
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
    correctAlongThePath("correctCut");
    waitForNewScan();
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
    EXPECT_EQ(corrections(), Corrections{});
    waitForNewScan();
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

TEST_F(Correcting, AScanThatIsDoneAgainForAnotherReaderIsShownAnewWhereOneWas)
{
    openCase();
    key(Qt::Key_End);
    CaseStore other(store_);
    const ScanRecord scan = other.requireScan(test::kCase, test::kSupine);
    services_.correct(other, scan, {}, {{}, {{0, 0, 0}}, {}});
    const auto progress = [&] { return cases()->item(0, 5)->text() + cases()->item(1, 5)->text(); };
    ASSERT_TRUE(eventually([&] { return progress().contains(","); })) << "the worklist shows that it is being done";
    EXPECT_EQ(warning(), "");
    services_.work(other, false);
    ASSERT_TRUE(eventually([] { return warning().find("done again meanwhile") != std::string::npos; }));
    waitForScan();
    EXPECT_LT(length() - station(), 10) << "the eye is where it was";
}

TEST_F(Correcting, WhatWasNotCorrectedIsNotForgottenAndWhatAddsNothingIsSaidSo)
{
    openCase();
    showList(2);
    press(window(), "forgetCorrections");
    EXPECT_TRUE(eventually([] { return warning() == "this scan has no corrections"; })) << warning();
    EXPECT_FALSE(the<QProgressBar>("redo")->isVisible()) << "nothing is done again";
    key(Qt::Key_End);
    waitUntilQuiet();
    press(window(), "correctAdd");
    click("coronal", middle("coronal"));  // between the two limbs
    EXPECT_TRUE(eventually([] { return warning().starts_with("There is neither gas nor tagged fluid"); })) << warning();
    EXPECT_FALSE(the<QProgressBar>("redo")->isVisible()) << "nothing is done again";
    closeCase();
    test::TestColon with_gas;
    for (std::size_t n = 0; n < with_gas.volume.voxels.size(); ++n) {
        const Point3 p = with_gas.volume.grid.pointAt(with_gas.volume.grid.indexOf(n));
        const bool within = std::abs(p.x) < 25 && std::abs(p.y) < 45 && std::abs(p.z) < 25;  // the body, not its edge
        if (within && !with_gas.inside.voxels[n])
            with_gas.volume.voxels[n] = -1000;
    }
    with_gas.write(store_ / "cases" / test::kCase / test::kSupine);
    openCase();
    press(window(), "correctAdd");
    click("coronal", middle("coronal"));
    ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); })) << warning();
    EXPECT_TRUE(eventually([] { return warning().starts_with("Nothing was added"); })) << warning();
}

TEST_F(Correcting, AddRefusesAirOutsideTheBodyAtOnce)
{
    // The colon's test scan has no air around its body: here it gets some, down the patient's left side.
    test::TestColon in_air;
    for (std::size_t n = 0; n < in_air.volume.voxels.size(); ++n)
        if (in_air.volume.grid.pointAt(in_air.volume.grid.indexOf(n)).x > 74)
            in_air.volume.voxels[n] = -1000;
    in_air.write(store_ / "cases" / test::kCase / test::kSupine);
    openCase();
    showList(2);
    press(window(), "correctAdd");
    const QSize view = the<QWidget>("coronal")->size();
    const double mm_per_pixel = std::max(160.0 / view.width(), 192.0 / view.height());  // all of the scan is shown
    click("coronal", {view.width() / 2 + int(77 / mm_per_pixel), view.height() / 2});
    EXPECT_TRUE(eventually([] { return warning().starts_with("This is air outside the body"); })) << warning();
    EXPECT_FALSE(the<QProgressBar>("redo")->isVisible()) << "nothing is done again";
}

TEST_F(Correcting, WhatIsDoneAgainWhileTheOtherScanIsReadIsNotReportedAsTheOneThatIsRead)
{
    std::atomic<bool> go = false;
    ReadingServices services = test::servicesFor(store_);
    services.work = [&go, work = services.work](CaseStore& store, const std::atomic<bool>& stop) {
        while (!go && !stop)
            std::this_thread::yield();
        work(store, stop);
    };
    room_.reset();
    openRoom(services);
    openCase();
    showList(2);
    correctAlongThePath("correctCut");
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForPictures();
    go = true;
    ASSERT_TRUE(eventually([] { return !the<QProgressBar>("redo")->isVisible(); }));
    const auto said = [] { return window()->statusBar()->currentMessage().toStdString(); };
    EXPECT_TRUE(eventually([&] { return said().starts_with("The other scan (supine) is corrected"); })) << said();
    EXPECT_TRUE(the<QComboBox>("scan")->currentText().startsWith("prone")) << "the reader stays where he is";
    closeCase();
    room_.reset();  // before what its services refer to
}

TEST_F(Correcting, NoTwoViewsShowDifferentScansWithoutSayingSo)
{
    // The other scan is another body of another wall: what a view shows tells which scan it is of.
    test::TestColon other(test::storages()[0], 2.5);
    for (std::int16_t& hu : other.volume.voxels)
        hu = std::int16_t(hu > -500 ? hu + 300 : hu);
    other.write(store_ / "cases" / test::kCase / test::kProne);
    openCase();
    window()->resize(1900, 1050);
    key(Qt::Key_U);
    key(Qt::Key_B, Qt::ShiftModifier);
    std::vector<const char*> views{"axial", "coronal", "sagittal", "overview", "endoscopic", "cube", "band"};
    const auto change = [&](const char* to) {
        std::map<std::string, QImage> before;
        for (const char* view : views) {
            ASSERT_TRUE(eventually([&] { return the<QWidget>(view)->isVisible() && drawn(view); })) << view;
            before[view] = pictureOf(view);
        }
        const auto expectNoneOfBefore = [&] {
            for (const char* view : views)
                EXPECT_FALSE(pictureOf(view) == before[view]) << view << " when it is " << to;
        };
        key(Qt::Key_X);
        // From the moment at which the scan is named no view shows the other one's picture.
        ASSERT_TRUE(eventually([] { return !the<QWidget>("opening")->isVisible(); }));
        ASSERT_TRUE(the<QComboBox>("scan")->currentText().startsWith(to));
        expectNoneOfBefore();
        screenshotNow((std::string("arrived_") + to).c_str());
        waitForScan();
        expectNoneOfBefore();
    };
    waitUntilQuiet();
    ASSERT_NO_FATAL_FAILURE(change("prone"));
    // The slice across the lumen has the room of the sagittal one, and the other scan is beside.
    key(Qt::Key_F6);
    for (int n = 0; n < 3; ++n)
        key(Qt::Key_H);
    key(Qt::Key_C);
    views[2] = "across";
    views.insert(views.end(), {"besideEndoscopic", "besideAxial", "besideOverview"});
    waitUntilQuiet();
    ASSERT_NO_FATAL_FAILURE(change("supine"));
    ASSERT_NO_FATAL_FAILURE(change("prone"));
}

TEST_F(Correcting, WorkThatIsStoppedLeavesTheWindowAsItWas)
{
    std::atomic<bool> stopped = false;
    ReadingServices services = test::servicesFor(store_);
    services.work = [&stopped](CaseStore&, const std::atomic<bool>& stop) {
        while (!stop)
            std::this_thread::yield();
        stopped = true;
    };
    services.worklist = [&stopped, before = services.worklist](CaseStore& store, const WorklistPageWanted& wanted) {
        WorklistPage page = before(store, wanted);
        for (WorklistCase& row : page.cases)
            for (WorklistScan& scan : row.scans)
                if (scan.state == WorkState::running && stopped)
                    scan.state = WorkState::queued;
        return page;
    };
    room_.reset();
    openRoom(services);
    openCase();
    showList(2);
    const int width = the<QWidget>("endoscopic")->width();
    correctAlongThePath("correctCut");
    press(window(), "stopRedo");
    EXPECT_TRUE(eventually([] { return the<QLabel>("redoState")->text().startsWith("stopped"); }));
    waitUntilQuiet();
    EXPECT_EQ(the<QWidget>("endoscopic")->width(), width);
    closeCase();
    room_.reset();  // before what its services refer to
}

TEST_F(Correcting, ACorrectionThatAnotherReaderChangedIsNotTakenBack)
{
    openCase();
    showList(2);
    correctAlongThePath("correctCut");
    waitForNewScan();
    const auto corrections = [&](const Corrections* set) {
        CaseStore other(store_);
        const ScanRecord scan = other.requireScan(test::kCase, test::kSupine);
        if (set)
            services_.correct(other, scan, services_.corrections(other, scan), *set);
        return services_.corrections(other, scan);
    };
    Corrections his = corrections(nullptr);
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
        ReviewedBridge bridge = services_.bridges(other, scan).front();
        bridge.review = {BridgeVerdict::confirmed, "bert", "2026-01-04"};
        services_.review_bridge(other, scan, bridge);
    }
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(eventually([] { return warning().find("this bridge's verdict was changed") != std::string::npos; }))
        << warning();
    EXPECT_TRUE(eventually([&] { return judged() == "confirmed, bert"; })) << "the list shows it as it is now";
}

}  // namespace
}  // namespace vicon::viewer
