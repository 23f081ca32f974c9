// A film is of the scan and the place at which it was asked for; it is one; and what else fails does not end it.
#include <QDoubleSpinBox>
#include <QProgressBar>
#include <QStatusBar>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "film/film_maker.h"
#include "film_reader.h"
#include "reading.h"

namespace vicon::viewer {
namespace {

class Filming : public test::Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        openCase();
        for (int n = 0; n < 30; ++n)
            key(Qt::Key_Plus);
        waitUntilQuiet();
    }
    std::vector<std::string> films() const
    {
        std::error_code none;
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder(), none))
            names.push_back(entry.path().filename().string());
        return names;
    }
    /// The eye goes there, to fly back to the rectum.
    static void backFrom(double station_mm)
    {
        key(Qt::Key_End);
        the<QDoubleSpinBox>("station")->setValue(station_mm);
        press(window(), "jump");
        ASSERT_TRUE(eventually([&] { return std::abs(station() - station_mm) < 2; }));
        waitUntilQuiet();
    }
    /// No number is given meanwhile: this program writes to the database.
    template <class Keys>
    void whileItWaitsForItsName(const Keys& keys) const
    {
        CaseStore store(store_);
        store.database().write([&](const auto&) { keys(); });
    }
    std::filesystem::path folder() const { return store_ / "cases" / test::kCase / "pictures"; }
    static QString said() { return window()->statusBar()->currentMessage(); }
    static bool filming() { return the<QProgressBar>("filmBar")->isVisible(); }
};

TEST_F(Filming, BeginsWhereItWasAskedForHoweverFastTheReaderGoesOn)
{
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
    waitUntilQuiet();
    const double whole_mm = length();
    whileItWaitsForItsName([=] {  // at the rectum
        key(Qt::Key_M, Qt::ControlModifier);
        key(Qt::Key_X);
        the<QDoubleSpinBox>("station")->setValue(0.7 * whole_mm);
        press(window(), "jump");
    });
    ASSERT_TRUE(eventually([] { return said().contains("Film saved"); })) << warning();
    const test::PlayedFilm film = test::playFilm(folder() / "1.ogv");
    constexpr double kFastest_mm_s = 100;
    EXPECT_NEAR(double(film.pictures.size()) / film.pictures_per_s, whole_mm / kFastest_mm_s, 0.2);
}

TEST_F(Filming, IsTakenBackByTheSameKeyBeforeItHasANameAsWell)
{
    whileItWaitsForItsName([] {
        key(Qt::Key_M, Qt::ControlModifier);
        key(Qt::Key_M, Qt::ControlModifier);
    });
    EXPECT_TRUE(said().contains("cancelled")) << said().toStdString();
    waitUntilQuiet();
    EXPECT_FALSE(filming());
    EXPECT_TRUE(films().empty());
}

TEST_F(Filming, SaysWhenItCannotBeWrittenAndCanBeginAgain)
{
    ASSERT_NO_FATAL_FAILURE(backFrom(60));
    key(Qt::Key_M, Qt::ControlModifier);
    ASSERT_TRUE(eventually([] { return filming(); }));
    std::filesystem::remove_all(folder());
    ASSERT_TRUE(eventually([] { return !filming(); }));
    EXPECT_NE(warning().find("film cannot be written"), std::string::npos) << warning();
    key(Qt::Key_M, Qt::ControlModifier);
    EXPECT_TRUE(eventually([] { return filming(); }));
    // Where even a name for it cannot be had.
    key(Qt::Key_M, Qt::ControlModifier);
    waitUntilQuiet();
    std::filesystem::remove_all(folder());
    std::ofstream(folder()) << "no folder";
    for (int n = 0; n < 2; ++n) {
        key(Qt::Key_Escape);
        ASSERT_EQ(warning(), "");
        key(Qt::Key_M, Qt::ControlModifier);
        EXPECT_TRUE(eventually([] { return !warning().empty(); })) << n;
        EXPECT_FALSE(filming());
    }
}

TEST_F(Filming, GoesOnWhereAnotherPictureFails)
{
    QObject owner;
    DrawingThread drawing(&owner);
    FilmMaker maker(drawing);
    CaseStore store(store_);
    const auto scan =
        std::make_shared<OpenScan>(PreparedScan::open(store.scanFolder(test::kCase, test::kSupine)),
                                   store.requireScan(test::kCase, test::kSupine), store.requireCase(test::kCase));
    EndoscopicRequest request;
    request.snapshot.width = request.snapshot.height = 64;
    const auto file = store_ / "film.ogv";
    QString finished;
    QObject::connect(&maker, &FilmMaker::finished, &owner, [&](const QString& name) { finished = name; });
    maker.start(scan, request, 20, Heading::rectum, 4, file);
    ASSERT_TRUE(maker.running());
    emit drawing.failed("of another view");
    EXPECT_TRUE(maker.running());
    EXPECT_TRUE(eventually([&] { return !finished.isEmpty(); }));
    EXPECT_TRUE(std::filesystem::exists(file));
    drawing.end();
}

}  // namespace
}  // namespace vicon::viewer
