#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QStatusBar>

#include "film_reader.h"
#include "reading.h"
#include "test_colon.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

TEST_F(Reading, FliesToTheCaecumAndBackAndIsWhereItWasAfterReopening)
{
    openCase();
    screenshot("opened");
    EXPECT_NEAR(station(), 0, 2);
    for (int n = 0; n < 30; ++n)
        key(Qt::Key_Plus);
    press(window(), "forward");
    ASSERT_TRUE(eventually([] { return station() > 60; }));
    screenshotNow("flying");
    press(window(), "stop");
    const double stopped = station();
    waitUntilQuiet();
    EXPECT_NEAR(station(), stopped, 1);
    key(Qt::Key_B);
    key(Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2; }));
    screenshot("caecum");
    EXPECT_EQ(the<QPushButton>("about")->text(), "Antegrade") << "it looks into the colon, ready for the way back";
    EXPECT_FALSE(the<QPushButton>("lookBack")->isChecked());
    key(Qt::Key_Space);
    ASSERT_TRUE(eventually([] { return length() - station() > 60; }));
    auto* spin = the<QDoubleSpinBox>("station");
    spin->setFocus();
    spin->selectAll();
    QTest::keyClicks(spin, "150");
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 150) < 2; }));
    closeCase();
    openCase();
    EXPECT_NEAR(station(), 150, 2);
    EXPECT_EQ(the<QPushButton>("about")->text(), "Antegrade");
}

TEST_F(Reading, GuidedFlightIsSteeredByKeysAndComesBackWhenReleased)
{
    openCase();
    key(Qt::Key_G);
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
    QTest::keyPress(window(), Qt::Key_W);
    ASSERT_TRUE(eventually([] { return station() > 40; }));
    QTest::keyRelease(window(), Qt::Key_W);
    const double released = station();
    waitUntilAtRest();
    screenshotNow("guided");
    EXPECT_LT(std::abs(station() - released), 40) << "nothing pulls it any more";
}

/// Let go of, it would come back to the path for two seconds.
TEST_F(Reading, AGuidedEyeHoldsWhileALengthIsMeasured)
{
    openCase();
    key(Qt::Key_G);
    QTest::keyPress(window(), Qt::Key_W);
    ASSERT_TRUE(eventually([] { return station() > 40; }));
    QTest::keyRelease(window(), Qt::Key_W);
    key(Qt::Key_M);
    const double here = station();
    waitUntilAtRest();
    EXPECT_EQ(station(), here);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    waitUntilAtRest();
    EXPECT_EQ(station(), here);
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return station() != here; })) << "then it drifts on";
}

/// Space lets go of it: the distance from the exit leads it on, and no key.
TEST_F(Reading, GuidedFlightIsPulledAlongByTheDistanceFromTheExit)
{
    constexpr double kBegin_mm = 150;
    test::TestColon colon;
    FieldVolume other_way = colon.exit_distance;
    for (std::size_t n = 0; n < other_way.voxels.size(); ++n)
        if (colon.inside.voxels[n] != kOutside)
            other_way.voxels[n] = 1000 - other_way.voxels[n];
    const auto file = CaseStore(store_).scanFolder(test::kCase, test::kSupine) / "exit_distance.mha";
    for (const bool as_made : {true, false}) {
        if (!as_made)
            scan_files::writeVolume(file, other_way, scan_files::Packing::raw);
        openCase();
        key(Qt::Key_Home);
        key(Qt::Key_G);
        QTest::keyPress(window(), Qt::Key_W);
        ASSERT_TRUE(eventually([] { return station() > kBegin_mm; }));
        QTest::keyRelease(window(), Qt::Key_W);
        waitUntilAtRest();
        const double begin_mm = station();
        key(Qt::Key_Space);
        EXPECT_TRUE(eventually([&] { return as_made ? station() > begin_mm + 30 : station() < begin_mm - 5; }))
            << "from " << begin_mm << " to " << station();
        key(Qt::Key_Space);
        waitUntilAtRest();
        closeCase();
    }
}

TEST_F(Reading, AGuidedFlightThatCannotReachAPlaceSaysSo)
{
    const auto file = store_ / "cases" / test::kCase / test::kSupine / "skeleton.vtp";
    Skeleton path = scan_files::readSkeleton(file);
    auto& points = path.pieces.back().points;
    for (int n = 1; n <= 40; ++n)  // beyond the lumen: no room there
        points.push_back({points.back().position_mm - Vector3{0, 0, 1}, points.back().station_mm + 1, 1});
    scan_files::writeSkeleton(file, path);
    openCase();
    key(Qt::Key_G);
    key(Qt::Key_Home);
    EXPECT_FALSE(window()->statusBar()->currentMessage().contains("too narrow"));
    key(Qt::Key_End);
    EXPECT_TRUE(window()->statusBar()->currentMessage().contains("too narrow"))
        << window()->statusBar()->currentMessage().toStdString();
    EXPECT_LT(station(), length() - 20);
}

TEST_F(Reading, TheRoomOfThePlaceInWordsIsTheSameAllAlongTheWay)
{
    openCase();
    auto* where = the<QLabel>("where");
    const int room = where->minimumWidth();
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        the<QDoubleSpinBox>("station")->setValue(share * length());
        press(window(), "jump");
        EXPECT_GE(room, where->minimumSizeHint().width()) << where->text().toStdString();
        EXPECT_EQ(where->minimumWidth(), room);
    }
}

TEST_F(Reading, AFilmIsMadeOrCancelledAndThePictureShowsHowItIsMade)
{
    openCase();
    const QImage plain = pictureOf("endoscopic");
    key(Qt::Key_O);
    ASSERT_TRUE(eventually([&] { return pictureOf("endoscopic") != plain; }));
    QTest::keyClick(the<QSlider>("angle"), Qt::Key_End);
    screenshot("structure");
    key(Qt::Key_O);
    const auto folder = store_ / "cases" / test::kCase / "pictures";
    const auto files = [&] {
        std::error_code none;
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none))
            names.push_back(entry.path().filename().string());
        return names;
    };
    for (int n = 0; n < 30; ++n)
        key(Qt::Key_Plus);
    auto* bar = the<QProgressBar>("filmBar");
    key(Qt::Key_M, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return bar->isVisible() && bar->value() > 5; }));
    press(window(), "filmCancel");
    EXPECT_TRUE(eventually([&] { return files().empty(); })) << "nothing is left of it";
    key(Qt::Key_End);
    the<QDoubleSpinBox>("station")->setValue(60);
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 60) < 2; }));
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
    waitUntilQuiet();
    const QImage first = pictureOf("endoscopic").convertToFormat(QImage::Format_Grayscale8);
    key(Qt::Key_M, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return bar->isVisible(); }));
    ASSERT_TRUE(eventually([&] { return !bar->isVisible(); }));
    ASSERT_EQ(files(), std::vector<std::string>{"2.ogv"});
    EXPECT_EQ(readFile(folder / "2.ogv").substr(0, 4), "OggS");
    // As a player that is not ours shows it: the whole way at the speed that was set, begun with what the reader saw.
    const test::PlayedFilm film = test::playFilm(folder / "2.ogv");
    ASSERT_GT(film.pictures_per_s, 0);
    EXPECT_NEAR(double(film.pictures.size()) / film.pictures_per_s, 60.0 / 100, 2 / film.pictures_per_s);
    film.pictures.front().save(VICON_SCREENSHOTS "/film_first.png");
    film.pictures.back().save(VICON_SCREENSHOTS "/film_last.png");
    const auto apart = [](const QImage& a, const QImage& b) {
        double sum = 0;
        const int width = std::min(a.width(), b.width()), height = std::min(a.height(), b.height());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sum += std::abs(qGray(a.pixel(x, y)) - qGray(b.pixel(x, y)));
        return sum / (double(width) * height);
    };
    constexpr double kSame = 16;  // grey levels on average: smoothing, and the reduced range of a film's brightness
    EXPECT_LT(apart(film.pictures.front().scaled(first.size()), first), kSame);
    EXPECT_GT(apart(film.pictures.back().scaled(first.size()), first), kSame);
}

}  // namespace
}  // namespace vicon::viewer
