// Two scans as one: the same place beside, its interval in every view of the other scan, pairs that are proposed.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QTableWidget>
#include <map>

#include "reading.h"
#include "test_colon.h"
#include "vicon/viewer/model/prior_place.h"
#include "widgets/picture_view.h"

namespace vicon::viewer {
namespace {

using test::Reading;

constexpr int kPairList = 4;

class TwoScans : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        openCase();
    }
    /// Pixels of about the colour that marks the same place: its band is thin, its name smoothed.
    static int green(const char* view)
    {
        constexpr int kAbout = 40;
        const QImage picture = pictureOf(view);
        int count = 0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x) {
                const QColor color = picture.pixelColor(x, y);
                count += std::abs(color.red() - kSamePlaceColor.red) < kAbout &&
                         std::abs(color.green() - kSamePlaceColor.green) < kAbout &&
                         std::abs(color.blue() - kSamePlaceColor.blue) < kAbout;
            }
        return count;
    }
    /// The polyp of this colon, marked in a scan.
    std::string mark(const char* scan) const
    {
        const test::TestColon colon;
        CaseStore store(store_);
        Marker marker{.scan_id = scan, .position_mm = colon.polyp_mm};
        marker.station_mm = colon.polyp_station_mm;
        return store.saveMarker(test::kCase, marker).id;
    }
    /// On the path, by another reader. @param off_mm the second of a pair lies that far from the same place
    std::string markAt(const char* scan, double station_mm, double off_mm) const
    {
        Marker marker{.scan_id = scan};
        marker.station_mm = station_mm + off_mm;
        marker.position_mm = test::TestColon().skeleton.at(marker.station_mm).position_mm;
        return CaseStore(store_).saveMarker(test::kCase, marker).id;
    }
    /// Red in the middle of a picture: the circle of a marker stands there in what looks at it.
    static int circleIn(const char* view)
    {
        const QImage picture = pictureOf(view);
        const int width = picture.width() / 2, height = picture.height() / 2;
        int count = 0;
        for (int y = height - height / 2; y < height + height / 2; ++y)
            for (int x = width - width / 2; x < width + width / 2; ++x) {
                const QColor color = picture.pixelColor(x, y);
                count += color.red() > 200 && color.green() < 90 && color.blue() < 90;
            }
        return count;
    }
};

TEST_F(TwoScans, TheSamePlaceIsABandInTheOtherScansViewsAndMovesWithTheEye)
{
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideOverview"); }));
    screenshot("same_place");
    ASSERT_TRUE(eventually([] { return green("besideOverview") > 20; })) << "in its projection";
    ASSERT_TRUE(eventually([] { return green("besideAxial") > 5; })) << "in its slice";
    const QString before = the<QLabel>("besidePlace")->text();
    EXPECT_THAT(before.toStdString(), testing::HasSubstr("(80 %)"));
    const QImage first = pictureOf("besideOverview");
    key(Qt::Key_Period);
    EXPECT_TRUE(eventually([&] { return the<QLabel>("besidePlace")->text() != before; }));
    EXPECT_TRUE(eventually([&] { return pictureOf("besideOverview") != first; }));
}

TEST_F(TwoScans, TheSamePlaceStaysInTheProjectionThatTurnsInTheBandAndInTheCube)
{
    for (int n = 0; n < 6; ++n)
        key(Qt::Key_Period);
    waitUntilQuiet();
    constexpr int kShown = 60;
    const int without = green("overview");  // some of the way's line is about as green
    openOther();
    waitForScan();
    ASSERT_TRUE(eventually([&] { return green("overview") > without + kShown; })) << without;
    waitUntilQuiet();
    auto* overview = the<QWidget>("overview");
    const QImage front = pictureOf("overview");
    const QPoint from = overview->rect().center();
    QTest::mousePress(overview, Qt::LeftButton, {}, from);
    for (int n = 1; n <= 4; ++n) {
        QMouseEvent move(QEvent::MouseMove, from + QPoint(20, 5) * n, Qt::LeftButton, Qt::LeftButton, {});
        QApplication::sendEvent(overview, &move);
    }
    QTest::mouseRelease(overview, Qt::LeftButton, {}, from + QPoint(80, 20));
    ASSERT_TRUE(eventually([&] { return pictureOf("overview") != front; }));
    waitUntilQuiet();
    screenshot("same_place_turned");
    const int turned = green("overview");
    EXPECT_GT(turned, kShown) << "turned";
    key(Qt::Key_B, Qt::ShiftModifier);
    key(Qt::Key_U);
    for (const char* view : {"band", "cube"})
        EXPECT_TRUE(eventually([&] { return green(view) > 20; })) << view;
    waitUntilQuiet();
    screenshot("same_place_all_views");
    key(Qt::Key_U);
    key(Qt::Key_Period);
    waitUntilQuiet();
    EXPECT_LT(green("band"), 5) << "of the place that was come to alone";
    EXPECT_LT(green("overview"), turned - kShown) << turned;
}

TEST_F(TwoScans, ThePictureBesideSaysWhileItIsOfAnotherPlace)
{
    const auto note = [] { return the<PictureView>("besideEndoscopic")->note(); };
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
    waitUntilQuiet();
    ASSERT_TRUE(note().isEmpty());
    key(Qt::Key_End);
    EXPECT_EQ(note(), PictureView::notThisPlaceYet());
    EXPECT_TRUE(eventually([&] { return note().isEmpty(); }));
}

TEST_F(TwoScans, ACaseLeftInTheLayoutOfBothScansOpensWithBoth)
{
    key(Qt::Key_F7);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
    window()->close();
    ASSERT_TRUE(eventually([] { return !window(); }));
    openCase();
    EXPECT_TRUE(eventually([] { return drawn("besideEndoscopic") && drawn("besideAxial"); }));
    key(Qt::Key_F5);
    EXPECT_TRUE(eventually([] { return !the<QWidget>("beside")->isVisible(); })) << "it came with the layout";
}

TEST_F(TwoScans, AClickInTheOthersProjectionGoesToTheSamePlace)
{
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideOverview"); }));
    const double before = station();
    click("besideOverview", middle("besideOverview"));
    EXPECT_TRUE(eventually([&] { return std::abs(station() - before) > 20; }));
}

TEST_F(TwoScans, MarkersOfOneFindingAreProposedAndPairedByTheReaderAlone)
{
    const std::string first = mark(test::kSupine), second = mark(test::kProne);
    room_.reset();
    openRoom(services_);
    openCase();
    showList(kPairList);
    auto* table = the<QTableWidget>("pairs");
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 1; }));
    EXPECT_EQ(table->item(0, 1)->text(), "1");
    EXPECT_THAT(table->item(0, 2)->text().toStdString(), testing::HasSubstr("from the same place, within"));
    for (const Marker& marker : stored())
        EXPECT_EQ(partnerNames(marker), "") << "nothing is paired by itself";
    EXPECT_FALSE(the<QPushButton>("pairConfirm")->isEnabled());
    clickRow(table, 0);
    ASSERT_TRUE(eventually([] { return the<QPushButton>("pairConfirm")->isEnabled(); }));
    screenshot("pairs");
    press(window(), "pairConfirm");
    const auto pairOf = [&](const std::string& id) {
        for (const Marker& marker : stored())
            if (marker.id == id)
                return partnerNames(marker);
        return std::string("no such marker");
    };
    ASSERT_TRUE(eventually([&] { return pairOf(first) == second && pairOf(second) == first; }));
    EXPECT_TRUE(eventually([&] { return table->rowCount() == 0; })) << "what is confirmed is proposed no longer";
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return pairOf(first).empty() && pairOf(second).empty(); }));
    EXPECT_TRUE(eventually([&] { return table->rowCount() == 1; }));
}

TEST_F(TwoScans, BothMarkersOfAProposedPairAreSeenSideBySide)
{
    mark(test::kSupine);
    mark(test::kProne);
    room_.reset();
    openRoom(services_);
    openCase();
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
    showList(kPairList);
    auto* table = the<QTableWidget>("pairs");
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 1; }));
    ASSERT_LT(circleIn("besideEndoscopic"), 20);
    clickRow(table, 0);
    EXPECT_TRUE(eventually([&] { return circleIn("endoscopic") > 100; }));
    EXPECT_TRUE(eventually([&] { return circleIn("besideEndoscopic") > 100; }));
    screenshot("pair_beside");
    // Paired: also where the marker that is chosen lies in the other scan, and the two change places.
    press(window(), "pairConfirm");
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 0; }));
    const QString read = the<QComboBox>("scan")->currentText();
    key(Qt::Key_Home);
    ASSERT_TRUE(eventually([&] { return circleIn("endoscopic") < 20 && circleIn("besideEndoscopic") < 20; }));
    showList(0);  // of the markers
    clickRow(markers(), 1);
    ASSERT_TRUE(eventually([&] { return the<QComboBox>("scan")->currentText() != read; })) << "the other scan is read";
    EXPECT_TRUE(eventually([&] { return circleIn("endoscopic") > 100; }));
    EXPECT_TRUE(eventually([&] { return circleIn("besideEndoscopic") > 100; }));
}

TEST_F(TwoScans, TheChosenPairStaysChosenWhileTheListIsFilledAnewAndNoOtherIsChosenForIt)
{
    const std::string removed = markAt(test::kSupine, 20, 0);
    markAt(test::kProne, 20, 0);
    const std::string first = markAt(test::kSupine, 120, 0), second = markAt(test::kProne, 120, 1);
    const std::string later = markAt(test::kSupine, 220, 0), last = markAt(test::kProne, 220, 2);
    showList(kPairList);
    auto* table = the<QTableWidget>("pairs");
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 3; })) << table->rowCount();
    const auto named = [&](int row) { return table->item(row, 0)->text().toStdString(); };
    ASSERT_EQ(named(1), first + " and " + second);
    clickRow(table, 1);
    ASSERT_TRUE(eventually([] { return the<QPushButton>("pairConfirm")->isEnabled(); }));
    CaseStore(store_).removeMarker(test::kCase, removed);  // by another reader
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 2; })) << table->rowCount();
    ASSERT_EQ(named(0), first + " and " + second) << "one row farther up";
    press(window(), "pairConfirm");
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 1 && settled(); })) << table->rowCount();
    screenshot("pair_of_three_confirmed");
    std::map<std::string, std::string> partners;
    for (const Marker& marker : stored())
        partners[marker.id] = partnerNames(marker);
    EXPECT_EQ(partners[first], second);
    EXPECT_EQ(partners[later] + partners[last], "") << "not looked at";
    EXPECT_FALSE(the<QPushButton>("pairConfirm")->isEnabled()) << "the next one is still to be looked at";
}

/// With the patient on the side as well.
class ThreeScans : public TwoScans {
protected:
    static constexpr const char* kDecubitus = "s4";

    void SetUp() override
    {
        Reading::SetUp();
        CaseStore store(store_);
        ScanRecord scan{.id = kDecubitus, .case_id = test::kCase};
        scan.series.uid = "1.2.3.3";
        scan.series.number = 3;
        scan.series.patient_position = "HFDL";
        std::filesystem::create_directories(store.scanFolder(test::kCase, kDecubitus));
        store.addScan(store.requireCase(test::kCase), scan, {}, false);
        test::TestColon().write(store.scanFolder(test::kCase, kDecubitus));
        store.writeScanFile(test::kCase, kDecubitus);
    }
};

TEST_F(ThreeScans, APairIsProposedWithTheThirdSightAndConfirmedToOneFinding)
{
    const std::string ids[] = {mark(test::kSupine), mark(test::kProne), mark(kDecubitus)};
    openCase();
    showList(kPairList);
    auto* table = the<QTableWidget>("pairs");
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 3; })) << table->rowCount();
    const auto confirm = [&] {
        clickRow(table, 0);
        ASSERT_TRUE(eventually([] { return the<QPushButton>("pairConfirm")->isEnabled(); }));
        press(window(), "pairConfirm");
    };
    ASSERT_NO_FATAL_FAILURE(confirm());
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 2 && settled(); })) << table->rowCount();
    screenshot("third_sight");
    EXPECT_THAT(table->item(0, 2)->text().toStdString(), testing::HasSubstr("is paired with"));
    ASSERT_NO_FATAL_FAILURE(confirm());
    ASSERT_TRUE(eventually([&] { return table->rowCount() == 0 && settled(); })) << table->rowCount();
    const auto partners = [&](std::size_t n) { return partnerNames(stored()[n]); };
    EXPECT_EQ(partners(0), ids[1] + ", " + ids[2]);
    EXPECT_EQ(partners(1), ids[0] + ", " + ids[2]);
    EXPECT_EQ(partners(2), ids[0] + ", " + ids[1]);
    showList(0);
    EXPECT_EQ(cell(0, 4).toStdString(), ids[1] + ", " + ids[2]);
    screenshot("group_of_three");
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return settled() && partners(0) == ids[1] && partners(2).empty(); }))
        << partners(0) << "; " << partners(2);
}

/// Each of another tissue, by which a slice tells which scan it shows.
class KeysOfThreeScans : public ThreeScans {
protected:
    void SetUp() override
    {
        ThreeScans::SetUp();
        int lighter_hu = 0;
        for (const char* scan : {test::kProne, kDecubitus}) {
            lighter_hu += 150;
            test::TestColon body;
            for (std::int16_t& hu : body.volume.voxels)
                hu = std::int16_t(hu > -500 ? hu + lighter_hu : hu);
            body.write(store_ / "cases" / test::kCase / scan);
        }
        openCase();
        window()->resize(1900, 1050);
        grey_of_[0] = greyOf("axial");
        for (std::size_t n = 1; n < 3; ++n) {
            ASSERT_NO_FATAL_FAILURE(openNext());
            grey_of_[n] = greyOf("axial");
            ASSERT_NE(grey_of_[n], grey_of_[n - 1]);
        }
        ASSERT_NO_FATAL_FAILURE(openNext());
    }
    static void openNext()
    {
        the<QLabel>("where")->clear();
        key(Qt::Key_X);
        ASSERT_NO_FATAL_FAILURE(waitForScan());
    }
    /// That most of a slice has; lines and words aside.
    static int greyOf(const char* slice)
    {
        const QImage picture = pictureOf(slice);
        std::array<int, 256> count{};
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                ++count[std::size_t(qGray(picture.pixel(x, y)))];
        count[0] = 0;
        return int(std::max_element(count.begin(), count.end()) - count.begin());
    }
    /// The position of the scan that a slice shows.
    std::string shownIn(const char* slice) const
    {
        const std::array<const char*, 3> names{"supine", "prone", "decubitus"};
        const int grey = greyOf(slice);
        for (std::size_t n = 0; n < names.size(); ++n)
            if (grey_of_[n] == grey)
                return names[n];
        return "none";
    }
    /// What is read and what is beside it: when nothing changes any more.
    std::string shown() const
    {
        waitUntilQuiet();
        return shownIn("axial") + ", " + (the<QWidget>("beside")->isVisible() ? shownIn("besideAxial") : "alone");
    }

    std::array<int, 3> grey_of_{};
};

TEST_F(KeysOfThreeScans, XGoesRoundAllOfThemAndStaysAtTheSamePlace)
{
    for (int n = 0; n < 8; ++n)
        key(Qt::Key_Period);
    waitUntilQuiet();
    const double there_mm = station();
    ASSERT_GT(there_mm, 50);
    for (const char* read : {"prone", "decubitus", "supine", "prone"}) {
        ASSERT_NO_FATAL_FAILURE(openNext());
        EXPECT_EQ(shown(), std::string(read) + ", alone");
        EXPECT_THAT(the<QComboBox>("scan")->currentText().toStdString(), testing::HasSubstr(read));
        EXPECT_NEAR(station(), there_mm, 10) << "of the same body";
    }
    // As fast as the keys come, it is as many scans on.
    key(Qt::Key_X);
    key(Qt::Key_X);
    EXPECT_EQ(shown(), "supine, alone");
}

TEST_F(KeysOfThreeScans, CGoesRoundTheOthersAndThenTakesThemAway)
{
    for (const char* beside : {"prone", "decubitus", "alone", "prone"}) {
        key(Qt::Key_C);
        EXPECT_EQ(shown(), std::string("supine, ") + beside);
    }
    key(Qt::Key_X);
    EXPECT_EQ(shown(), "prone, supine") << "they change places";
    key(Qt::Key_X);
    EXPECT_EQ(shown(), "decubitus, supine");
    screenshot("third_beside_first");
    key(Qt::Key_C);
    EXPECT_EQ(shown(), "decubitus, prone");
    key(Qt::Key_C);
    EXPECT_EQ(shown(), "decubitus, alone");
}

TEST_F(KeysOfThreeScans, KeysThatDoNotWaitForThePicturesShowNoScanTwiceAndSkipNone)
{
    const auto press = [](std::initializer_list<int> keys) {
        for (const int which : keys)
            key(which);
    };
    press({Qt::Key_C, Qt::Key_C});
    EXPECT_EQ(shown(), "supine, decubitus") << "the second of the others";
    press({Qt::Key_C, Qt::Key_C});
    EXPECT_EQ(shown(), "supine, prone") << "none, and the first";
    press({Qt::Key_C, Qt::Key_C});
    ASSERT_EQ(shown(), "supine, alone");
    press({Qt::Key_X, Qt::Key_C});
    EXPECT_EQ(shown(), "prone, supine") << "what was to be beside is read: they change places";
    press({Qt::Key_C, Qt::Key_X});
    EXPECT_EQ(shown(), "decubitus, prone") << "likewise";
}

TEST_F(KeysOfThreeScans, TheLayoutOfBothScansShowsAnyTwoOfThem)
{
    key(Qt::Key_F7);
    EXPECT_EQ(shown(), "supine, prone");
    key(Qt::Key_C);
    EXPECT_EQ(shown(), "supine, decubitus");
    screenshot("layout_of_both_third");
    key(Qt::Key_X);
    EXPECT_EQ(shown(), "prone, decubitus");
    key(Qt::Key_X);
    EXPECT_EQ(shown(), "decubitus, prone");
    key(Qt::Key_C);
    EXPECT_EQ(shown(), "decubitus, alone");
    key(Qt::Key_F7);
    EXPECT_EQ(shown(), "decubitus, supine") << "asked for again";
    key(Qt::Key_F5);
    EXPECT_EQ(shown(), "decubitus, alone") << "it came with the layout";
}

}  // namespace
}  // namespace vicon::viewer
