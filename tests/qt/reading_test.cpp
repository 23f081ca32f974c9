#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QStatusBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QtTest/QTest>

#include "reading_store.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"
#include "vicon/viewer/scene/display.h"

namespace vicon::viewer {
namespace {

constexpr int kPatience_ms = 60000;  // a still peeled picture takes 20 s under the sanitizers, on a busy machine

/// One reader at the screen: looks for controls by name, presses, waits until what must follow is there.
class Reading : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        display_ = std::make_unique<Display>();
        folder_ = std::make_unique<support::TemporaryFolder>();
        qputenv("XDG_CONFIG_HOME", (*folder_ / "config").c_str());
        static int argc = 1;
        static char name[] = "reading_test";
        static char* argv[] = {name, nullptr};
        application_ = std::make_unique<QApplication>(argc, argv);
        QCoreApplication::setOrganizationName("vicon");
        std::filesystem::create_directories(VICON_SCREENSHOTS);
    }
    static void TearDownTestSuite()
    {
        application_.reset();
        folder_.reset();
        display_.reset();
    }
    void SetUp() override
    {
        store_ = *folder_ / testing::UnitTest::GetInstance()->current_test_info()->name();
        QSettings().clear();
        test::makeStore(store_);
        openRoom();
    }
    void TearDown() override { room_.reset(); }

    void openRoom(const std::string& case_id = {})
    {
        room_ = makeReadingRoom(test::servicesFor(store_), case_id);
        room_->show();
        ASSERT_TRUE(eventually([&] { return cases()->rowCount() == 2; }));
    }

    template <class Condition>
    static bool eventually(Condition condition)
    {
        return QTest::qWaitFor(condition, kPatience_ms);
    }

    QTableWidget* cases() const { return room_->findChild<QTableWidget*>("cases"); }
    static QMainWindow* window()
    {
        for (QWidget* widget : QApplication::topLevelWidgets())
            if (widget->objectName() == "reading")
                return qobject_cast<QMainWindow*>(widget);
        return nullptr;
    }
    template <class T>
    static T* the(const char* name)
    {
        T* found = window()->findChild<T*>(name);
        EXPECT_NE(found, nullptr) << name;
        return found;
    }
    static void press(QWidget* in, const char* name)
    {
        auto* button = in->findChild<QPushButton*>(name);
        ASSERT_NE(button, nullptr) << name;
        ASSERT_TRUE(button->isEnabled()) << name;
        QTest::mouseClick(button, Qt::LeftButton);
    }
    static void click(const char* view, QPoint at, Qt::KeyboardModifiers modifiers = {})
    {
        QTest::mouseClick(the<QWidget>(view), Qt::LeftButton, modifiers, at);
    }
    static QPoint middle(const char* view) { return the<QWidget>(view)->rect().center(); }
    static QTableWidget* markers() { return the<QTableWidget>("markers"); }
    /// Nothing is on its way to the database.
    static bool settled() { return the<QWidget>("markerTable")->isEnabled(); }
    static QString cell(int row, int column) { return markers()->item(row, column)->text(); }

    void openCase()
    {
        for (int row = 0; row < cases()->rowCount(); ++row)
            if (cases()->item(row, 1)->text() == "PH-1")
                QTest::mouseClick(cases()->viewport(), Qt::LeftButton, {},
                                  cases()->visualItemRect(cases()->item(row, 0)).center());
        press(room_.get(), "open");
        ASSERT_NE(window(), nullptr);
        waitForScan();
    }
    static void waitForScan()
    {
        ASSERT_TRUE(eventually([] { return !the<QLabel>("where")->text().isEmpty(); }));
        ASSERT_TRUE(eventually([] { return drawn("endoscopic") && drawn("overview") && drawn("coronal"); }));
        window()->activateWindow();
        settle();
    }
    /// More than text: the colours of its middle differ.
    static bool drawn(const char* view)
    {
        const QImage image = the<QWidget>(view)->grab().toImage();
        const int x = image.width() / 2, y = image.height() / 2;
        for (int n = 1; n < std::min(x, y) / 2; ++n)
            if (image.pixel(x + n, y) != image.pixel(x, y))
                return true;
        return false;
    }
    static void settle()
    {
        QTest::qWait(400);
    }  // for the screenshots: the smooth picture comes after the last movement
    static double station() { return the<QLabel>("where")->text().section(' ', 0, 0).toDouble(); }
    static double length()
    {
        const QString text = the<QLabel>("where")->text();
        return station() + text.section(", ", 1).section(' ', 0, 0).toDouble();
    }
    void screenshot(const char* name) const
    {
        settle();
        QWidget* of = window() ? static_cast<QWidget*>(window()) : room_.get();
        of->grab().save(QString(VICON_SCREENSHOTS "/%1.png").arg(name));
    }
    std::vector<Marker> stored() const
    {
        CaseStore store(store_);
        return store.markers(test::kCase);
    }

    static std::unique_ptr<Display> display_;
    static std::unique_ptr<support::TemporaryFolder> folder_;
    static std::unique_ptr<QApplication> application_;
    std::filesystem::path store_;
    std::unique_ptr<QWidget> room_;
};
std::unique_ptr<Display> Reading::display_;
std::unique_ptr<support::TemporaryFolder> Reading::folder_;
std::unique_ptr<QApplication> Reading::application_;

TEST_F(Reading, WorklistSearchesFiltersAndRetriesAFailedCase)
{
    const auto shown = [&] {
        int count = 0;
        for (int row = 0; row < cases()->rowCount(); ++row)
            count += cases()->isRowHidden(row) ? 0 : 1;
        return count;
    };
    QTest::keyClicks(room_->findChild<QLineEdit*>("search"), "bert");
    EXPECT_EQ(shown(), 1);
    room_->findChild<QLineEdit*>("search")->clear();
    auto* state = room_->findChild<QComboBox*>("state");
    state->setCurrentIndex(state->findData("failed"));
    ASSERT_EQ(shown(), 1);
    const int failed = cases()->isRowHidden(0) ? 1 : 0;
    QTest::mouseClick(cases()->viewport(), Qt::LeftButton, {},
                      cases()->visualItemRect(cases()->item(failed, 0)).center());
    EXPECT_EQ(room_->findChild<QLabel*>("reason")->text(), "the series has a gap of 40 mm");
    EXPECT_FALSE(room_->findChild<QPushButton*>("open")->isEnabled());
    screenshot("worklist");
    EXPECT_EQ(cases()->item(1 - failed, 6)->text(), "poor: prone");
    EXPECT_TRUE(cases()->item(1 - failed, 6)->toolTip().contains("collapsed over 38 mm"));
    press(room_.get(), "retry");
    EXPECT_TRUE(eventually([&] { return cases()->item(failed, 4)->text() == "queued"; }));
    EXPECT_EQ(shown(), 0) << "it is no longer failed";
}

TEST_F(Reading, FliesToTheCaecumAndBackAndIsWhereItWasAfterReopening)
{
    openCase();
    screenshot("opened");
    EXPECT_NEAR(station(), 0, 2);
    for (int n = 0; n < 30; ++n)
        QTest::keyClick(window(), Qt::Key_Plus);
    press(window(), "forward");
    ASSERT_TRUE(eventually([] { return station() > 60; }));
    screenshot("flying");
    press(window(), "stop");
    const double stopped = station();
    settle();
    EXPECT_NEAR(station(), stopped, 1);
    QTest::keyClick(window(), Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2; }));
    screenshot("caecum");
    EXPECT_EQ(the<QPushButton>("about")->text(), "To rectum") << "it looks into the colon, ready for the way back";
    QTest::keyClick(window(), Qt::Key_Space);
    ASSERT_TRUE(eventually([] { return length() - station() > 60; }));
    auto* spin = the<QDoubleSpinBox>("station");
    spin->setFocus();
    spin->selectAll();
    QTest::keyClicks(spin, "150");
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 150) < 2; }));
    window()->close();
    ASSERT_TRUE(eventually([] { return window() == nullptr; }));
    openCase();
    EXPECT_NEAR(station(), 150, 2);
    EXPECT_EQ(the<QPushButton>("about")->text(), "To rectum");
}

TEST_F(Reading, GuidedFlightIsSteeredByKeysAndComesBackWhenLetGo)
{
    openCase();
    QTest::keyClick(window(), Qt::Key_G);
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
    QTest::keyPress(window(), Qt::Key_W);
    ASSERT_TRUE(eventually([] { return station() > 40; }));
    QTest::keyRelease(window(), Qt::Key_W);
    screenshot("guided");
    const double let_go = station();
    settle();
    EXPECT_LT(std::abs(station() - let_go), 40) << "nothing pulls it any more";
}

TEST_F(Reading, MarkersArePlacedEditedUndonePairedDeletedAndKept)
{
    openCase();
    QTest::keyClick(window(), Qt::Key_2);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1; }));
    ASSERT_EQ(stored().size(), 1U);
    EXPECT_EQ(stored()[0].color, MarkerColor::yellow);
    EXPECT_TRUE(stored()[0].extra.contains("view"));
    EXPECT_EQ(stored()[0].scan_id, test::kSupine);
    screenshot("marker");

    // From the other end back to the view that was saved with it.
    const double seen_from = station();
    QTest::keyClick(window(), Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2; }));
    QTest::mouseClick(markers()->viewport(), Qt::LeftButton, {},
                      markers()->visualItemRect(markers()->item(0, 0)).center());
    ASSERT_TRUE(eventually([&] { return std::abs(station() - seen_from) < 2; })) << "at " << station();
    QTest::keyClick(window(), Qt::Key_R);  // on towards the caecum

    // A note, written in its cell.
    const auto* note = markers()->item(0, 6);
    QTest::mouseClick(markers()->viewport(), Qt::LeftButton, {}, markers()->visualItemRect(note).center());
    QTest::mouseDClick(markers()->viewport(), Qt::LeftButton, {}, markers()->visualItemRect(note).center());
    auto* editor = markers()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    QTest::keyClicks(editor, "6 mm, sessile");
    QTest::keyClick(editor, Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return stored()[0].note == "6 mm, sessile" && settled(); }));

    // Its colour, by the keyboard of the list of colours.
    auto* color = the<QComboBox>("markerColor");
    color->setFocus();
    QTest::keyClick(color, Qt::Key_Up);
    ASSERT_TRUE(eventually([&] { return stored()[0].color == MarkerColor::red && settled(); }));

    ASSERT_TRUE(eventually([] { return the<QPushButton>("undo")->isEnabled(); }));
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return stored()[0].color == MarkerColor::yellow && settled(); }));
    ASSERT_TRUE(eventually([] { return the<QPushButton>("redo")->isEnabled(); }));
    press(window(), "redo");
    ASSERT_TRUE(eventually([&] { return stored()[0].color == MarkerColor::red && settled(); }));

    // The same finding in the other scan, and the pair.
    auto* scan = the<QComboBox>("scan");
    the<QLabel>("where")->clear();
    scan->setFocus();
    QTest::keyClick(scan, Qt::Key_Down);
    waitForScan();
    click("endoscopic", middle("endoscopic") + QPoint(90, 60), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2; }));
    EXPECT_EQ(cell(1, 1), "prone");
    const auto choose = [](int row) {
        QTest::mouseClick(markers()->viewport(), Qt::LeftButton, {},
                          markers()->visualItemRect(markers()->item(row, 0)).center());
    };
    choose(1);
    press(window(), "markerPair");
    choose(0);
    ASSERT_TRUE(eventually([&] { return stored()[0].extra.value("pair", "") == stored()[1].id; }));
    EXPECT_TRUE(eventually([&] { return stored()[1].extra.value("pair", "") == stored()[0].id && settled(); }));
    // Both at once: what is chosen in one is shown in both, and they move together.
    QTest::keyClick(window(), Qt::Key_C);
    const bool both = eventually([] { return drawn("besideEndoscopic") && drawn("besideTransverse"); });
    screenshot("beside");
    ASSERT_TRUE(both);
    const auto beside = [] { return the<QWidget>("besideEndoscopic")->grab().toImage(); };
    settle();
    const QImage first_shown = beside();
    press(window(), "stepOn");
    ASSERT_TRUE(eventually([&] { return beside() != first_shown; })) << "it moves with the other";
    settle();
    const QImage along_the_path = beside();
    choose(1);
    ASSERT_TRUE(eventually([&] { return beside() != along_the_path; }));
    screenshot("paired");
    // A click reads on in the other scan, at the same place: the two are the same colon.
    const double place = station();
    click("besideEndoscopic", middle("besideEndoscopic"));
    ASSERT_TRUE(eventually([] { return the<QComboBox>("scan")->currentText().startsWith("supine"); }));
    EXPECT_NEAR(station(), place, 1);

    window()->close();
    ASSERT_TRUE(eventually([] { return window() == nullptr; }));
    openCase();
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2; }));
    EXPECT_EQ(cell(0, 6), "6 mm, sessile");
    EXPECT_EQ(cell(0, 4), cell(1, 0));
    EXPECT_TRUE(the<QWidget>("besideEndoscopic")->isVisible()) << "side by side as it was left";
    // A marker of the other scan takes the reader there.
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
    choose(1);
    EXPECT_TRUE(eventually([] { return the<QComboBox>("scan")->currentText().startsWith("prone"); }));
    press(window(), "markerRemove");
    ASSERT_TRUE(eventually([&] { return stored().size() == 1; }));
}

TEST_F(Reading, ASizeIsMeasuredBetweenTwoClicksAndKeptWithTheMarkerBesideIt)
{
    openCase();
    const QPoint first = middle("endoscopic") + QPoint(90, 60), second = first + QPoint(30, 30);
    click("endoscopic", first, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    QTest::keyClick(window(), Qt::Key_M);
    click("endoscopic", first);
    click("endoscopic", second);
    ASSERT_TRUE(eventually([&] { return stored()[0].extra.contains("size") && settled(); }));
    const auto size = stored()[0].extra["size"];
    EXPECT_GT(size["straight_mm"].get<double>(), 1);
    EXPECT_GE(size["along_mm"].get<double>(), size["straight_mm"].get<double>() - 1e-9);
    EXPECT_EQ(cell(0, 5), QString::number(size["straight_mm"].get<double>(), 'f', 1));
    if (size.contains("plane")) {
        EXPECT_GE(size["plane"]["diameter_mm"].get<double>(), size["straight_mm"].get<double>() - 0.5);
    }
    screenshot("measured");
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return !stored()[0].extra.contains("size"); }));
}

TEST_F(Reading, AnAreaThatIsCircledIsPeeledAloneAndItsDensityKeptWithTheMarkerUntilUndone)
{
    openCase();
    const QPoint at = middle("endoscopic") + QPoint(80, 50);
    click("endoscopic", at, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    settle();
    auto* view = the<QWidget>("endoscopic");
    const QImage plain = view->grab().toImage();
    QTest::keyClick(window(), Qt::Key_T);
    QTest::mousePress(view, Qt::LeftButton, {}, at);
    for (int n = 1; n <= 5; ++n)
        QTest::mouseMove(view, at + QPoint(22 * n, 0));
    screenshot("circling");
    QTest::mouseRelease(view, Qt::LeftButton, {}, at + QPoint(110, 0));
    ASSERT_TRUE(eventually([&] { return stored()[0].extra.contains("density") && settled(); }))
        << the<QLabel>("warning")->text().toStdString();
    const auto density = stored()[0].extra["density"];
    EXPECT_GE(density["voxels"].get<int>(), 20);
    EXPECT_GT(density["mean_hu"].get<double>(), -90) << "a wall of 40 HU before fat of -90";
    EXPECT_LT(density["mean_hu"].get<double>(), 45);
    EXPECT_TRUE(the<QLabel>("histogram")->isVisible());
    settle();
    screenshot("biopsy");
    // Far from the circle the wall is drawn as it was; in its middle something else is.
    ASSERT_TRUE(
        eventually([&] { return view->grab().toImage().pixel(at + QPoint(6, 6)) != plain.pixel(at + QPoint(6, 6)); }));
    const QImage peeled = view->grab().toImage();
    const QPoint far = middle("endoscopic") + QPoint(-80, -60);
    constexpr int kSmoothing = 12;  // grey levels: one picture may have been drawn while the eye moved
    EXPECT_NEAR(qRed(peeled.pixel(far)), qRed(plain.pixel(far)), kSmoothing);
    EXPECT_NEAR(qGreen(peeled.pixel(far)), qGreen(plain.pixel(far)), kSmoothing);
    EXPECT_NEAR(qBlue(peeled.pixel(far)), qBlue(plain.pixel(far)), kSmoothing);
    QTest::mouseClick(markers()->viewport(), Qt::LeftButton, {},
                      markers()->visualItemRect(markers()->item(0, 0)).center());
    QTest::keyClick(window(), Qt::Key_I);
    auto* box = the<QMessageBox>("markerInformation");
    EXPECT_TRUE(box->text().contains("HU, of "));
    EXPECT_TRUE(eventually([&] { return box->findChild<QLabel*>("measures") != nullptr; }));
    settle();
    box->grab().save(VICON_SCREENSHOTS "/biopsy_information.png");
    box->close();
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return !stored()[0].extra.contains("density") && settled(); }));
    press(window(), "redo");
    ASSERT_TRUE(eventually([&] { return stored()[0].extra.contains("density") && settled(); }));
    window()->activateWindow();
    ASSERT_TRUE(eventually([] { return window()->isActiveWindow(); }));
    QTest::keyClick(window(), Qt::Key_Escape);
    EXPECT_TRUE(eventually([] { return !the<QLabel>("histogram")->isVisible(); }));
}

TEST_F(Reading, AMarkerThatAnotherReaderChangedIsNotOverwritten)
{
    openCase();
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1; }));
    {
        CaseStore other(store_);
        Marker marker = other.markers(test::kCase).front();
        marker.note = "by the other reader";
        other.saveMarker(test::kCase, marker);
    }
    press(window(), "undo");  // would delete it
    ASSERT_TRUE(eventually([] { return the<QLabel>("warning")->text().contains("another reader"); }));
    ASSERT_EQ(stored().size(), 1U);
    EXPECT_EQ(stored()[0].note, "by the other reader");
    EXPECT_EQ(cell(0, 6), "by the other reader");
    screenshot("conflict");
}

TEST_F(Reading, SlicesProjectionAndPeelingFollowTheMouse)
{
    openCase();
    auto* overview = the<QWidget>("overview");
    const double before = station();
    click("overview", QPoint(overview->width() * 2 / 3, overview->height() / 2));
    ASSERT_TRUE(eventually([&] { return std::abs(station() - before) > 50; }));
    screenshot("jumped");
    auto* window_choice = the<QComboBox>("window");
    window_choice->setFocus();
    QTest::keyClick(window_choice, Qt::Key_Down);
    EXPECT_EQ(window_choice->currentText(), "soft-tissue");
    const double width = the<QWidget>("coronal")->width();
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    EXPECT_FALSE(the<QWidget>("endoscopic")->isVisible());
    ASSERT_TRUE(eventually([&] { return the<QWidget>("coronal")->width() > 2 * width; }));
    screenshot("enlarged");
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    EXPECT_TRUE(the<QWidget>("endoscopic")->isVisible());
    const QImage plain = the<QWidget>("endoscopic")->grab().toImage();
    auto* peel = the<QComboBox>("peel");
    peel->setFocus();
    QTest::keyClick(peel, Qt::Key_Down);
    ASSERT_TRUE(eventually([&] { return the<QWidget>("endoscopic")->grab().toImage() != plain; }));
    screenshot("peeled");
    QTest::mouseClick(the<QWidget>("peelCircle"), Qt::LeftButton, {},
                      QPoint(8, the<QWidget>("peelCircle")->height() / 2));
    const auto hover = [](QPoint at) { QTest::mouseMove(the<QWidget>("endoscopic"), at); };
    // The ring around the circle is the same light grey at its left and right end.
    const auto circleIsAt = [](QPoint at) {
        const QImage image = the<QWidget>("endoscopic")->grab().toImage();
        const int radius = int(0.3 * std::min(image.width(), image.height()));
        for (const int side : {-1, 1}) {
            bool ring = false;
            for (int n = -2; n <= 2; ++n)
                ring = ring || qGray(image.pixel(at.x() + side * radius + n, at.y())) > 200;
            if (!ring)
                return false;
        }
        return true;
    };
    for (const QPoint by : {QPoint(-80, -80), QPoint(80, 80)}) {
        const QPoint at = middle("endoscopic") + by;
        hover(at);
        EXPECT_TRUE(eventually([&] { return circleIsAt(at); })) << at.x() << ", " << at.y();
    }
    screenshot("lens");
}

TEST_F(Reading, WhatWasSeenIsCountedPaintedListedAndKept)
{
    const auto seen = [] { return the<QLabel>("seen")->text().section(' ', 0, 0).toDouble(); };
    const auto picture = [] { return the<QWidget>("endoscopic")->grab().toImage(); };
    openCase();
    ASSERT_TRUE(eventually([&] { return seen() > 0; }));
    for (int n = 0; n < 30; ++n)
        QTest::keyClick(window(), Qt::Key_Plus);
    const double before = seen();
    press(window(), "forward");
    ASSERT_TRUE(eventually([] { return station() > 250; }));
    press(window(), "stop");
    ASSERT_TRUE(eventually([&] { return seen() > before + 10; }));
    settle();
    // Ahead nothing was seen earlier; behind the wall was, and is painted.
    QTest::keyClick(window(), Qt::Key_V);
    settle();
    QTest::keyClick(window(), Qt::Key_R);
    settle();
    const auto green = [&] {
        const QImage image = picture();
        int count = 0;
        for (int y = 0; y < image.height(); y += 4)
            for (int x = 0; x < image.width(); x += 4) {
                const QColor c = image.pixelColor(x, y);
                count += c.green() > 40 && c.green() > c.red() * 5 / 4 ? 1 : 0;
            }
        return double(count) * 16 / (image.width() * image.height());
    };
    EXPECT_TRUE(eventually([&] { return green() > 0.2; })) << green();
    screenshot("seen");
    QTest::keyClick(window(), Qt::Key_V);
    EXPECT_TRUE(eventually([&] { return green() < 0.02; })) << green();

    QTest::mouseClick(the<QTabWidget>("lists")->tabBar(), Qt::LeftButton, {},
                      the<QTabWidget>("lists")->tabBar()->tabRect(1).center());
    auto* list = the<QTableWidget>("unseen");
    ASSERT_TRUE(eventually([&] { return list->rowCount() > 0; }));
    for (int row = 1; row < list->rowCount(); ++row)
        EXPECT_LE(list->item(row - 1, 0)->text().toDouble(), list->item(row, 0)->text().toDouble());
    const int last = list->rowCount() - 1;
    const double there = list->item(last, 0)->text().toDouble();
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualItemRect(list->item(last, 0)).center());
    EXPECT_TRUE(eventually([&] { return std::abs(station() - there) < 40; })) << station() << " for " << there;
    screenshot("unseen");
    settle();
    const double kept = seen();
    window()->close();
    ASSERT_TRUE(eventually([] { return window() == nullptr; }));
    openCase();
    EXPECT_TRUE(eventually([&] { return seen() >= kept; })) << seen() << " after " << kept;
    press(window(), "forgetSeen");
    EXPECT_TRUE(eventually([&] { return seen() < before + 1; })) << seen();
}

TEST_F(Reading, MarkersOfAFileAreLoadedInOneStepAndSaved)
{
    openCase();
    for (const QPoint by : {QPoint(90, 60), QPoint(-60, 60)}) {
        const int before = markers()->rowCount();
        click("endoscopic", middle("endoscopic") + by, Qt::ShiftModifier);
        ASSERT_TRUE(eventually([&] { return markers()->rowCount() == before + 1 && settled(); }));
    }
    const auto choose = [](const char* name, const QString& file) {
        auto* dialog = the<QFileDialog>(name);
        emit dialog->fileSelected(file);  // how Qt's own dialog is used is Qt's business
        dialog->reject();
    };
    const std::filesystem::path file = store_ / "list.json";
    QTest::keyClick(window(), Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
    choose("saveMarkers", file.c_str());
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file); }));
    auto list = nlohmann::json::parse(readFile(file));
    ASSERT_EQ(list["markers"].size(), 2U);
    for (auto& marker : list["markers"])
        marker["note"] = "from the file";
    replaceFile(file, list.dump());
    QTest::keyClick(window(), Qt::Key_O, Qt::ControlModifier);
    choose("loadMarkers", file.c_str());
    const auto notes = [&](const char* note) { return cell(0, 6) == note && cell(1, 6) == note && settled(); };
    ASSERT_TRUE(eventually([&] { return notes("from the file"); })) << the<QLabel>("warning")->text().toStdString();
    EXPECT_EQ(stored()[1].note, "from the file");
    QTest::mouseClick(markers()->viewport(), Qt::LeftButton, {},
                      markers()->visualItemRect(markers()->item(1, 0)).center());
    QTest::keyClick(window(), Qt::Key_I);
    auto* box = the<QMessageBox>("markerInformation");
    EXPECT_TRUE(box->text().contains("from the file") && box->text().contains("supine"));
    screenshot("information");
    box->close();
    press(window(), "undo");
    EXPECT_TRUE(eventually([&] { return notes(""); })) << "one undo takes both back";
}

TEST_F(Reading, CorrectionsGoToThePipelineAndTheNewResultIsTakenOver)
{
    openCase();
    auto* lists = the<QTabWidget>("lists");
    QTest::mouseClick(lists->tabBar(), Qt::LeftButton, {}, lists->tabBar()->tabRect(2).center());
    auto* bridges = the<QTableWidget>("bridges");
    ASSERT_TRUE(eventually([&] { return bridges->rowCount() == 1; }));
    QTest::mouseClick(bridges->viewport(), Qt::LeftButton, {}, bridges->visualItemRect(bridges->item(0, 0)).center());
    EXPECT_TRUE(eventually([] { return std::abs(station() - 180) < 3; }));
    const auto judged = [&] { return bridges->item(0, 3)->text(); };
    press(window(), "rejectBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "rejected, anna"; })) << judged().toStdString();
    press(window(), "confirmBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "confirmed, anna"; }));
    QTest::keyClick(window(), Qt::Key_End);
    settle();
    press(window(), "correctCut");
    click("coronal", middle("coronal"));
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
    window()->close();
    ASSERT_TRUE(eventually([] { return window() == nullptr; }));
    EXPECT_NE(surface(), before);
}

TEST_F(Reading, AFilmIsMadeOrCancelledAndThePictureShowsHowItIsMade)
{
    openCase();
    const QImage plain = the<QWidget>("endoscopic")->grab().toImage();
    QTest::keyClick(window(), Qt::Key_O);
    ASSERT_TRUE(eventually([&] { return the<QWidget>("endoscopic")->grab().toImage() != plain; }));
    QTest::keyClick(the<QSlider>("angle"), Qt::Key_End);
    screenshot("structure");
    QTest::keyClick(window(), Qt::Key_O);
    const auto folder = store_ / "cases" / test::kCase / "pictures";
    const auto files = [&] {
        std::error_code none;
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none))
            names.push_back(entry.path().filename().string());
        return names;
    };
    for (int n = 0; n < 30; ++n)
        QTest::keyClick(window(), Qt::Key_Plus);
    auto* bar = the<QProgressBar>("filmBar");
    QTest::keyClick(window(), Qt::Key_M, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return bar->isVisible() && bar->value() > 5; }));
    press(window(), "filmCancel");
    EXPECT_TRUE(eventually([&] { return files().empty(); })) << "nothing is left of it";
    QTest::keyClick(window(), Qt::Key_End);
    the<QDoubleSpinBox>("station")->setValue(60);
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 60) < 2; }));
    QTest::keyClick(window(), Qt::Key_M, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return bar->isVisible(); }));
    ASSERT_TRUE(eventually([&] { return !bar->isVisible(); }));
    ASSERT_EQ(files(), std::vector<std::string>{"2.ogv"});
    EXPECT_EQ(readFile(folder / "2.ogv").substr(0, 4), "OggS");
    EXPECT_GT(std::filesystem::file_size(folder / "2.ogv"), 10000U);
}

TEST_F(Reading, ACaseDeletedUnderItsReaderIsSaidSo)
{
    openCase();
    {
        CaseStore other(store_);
        other.database().write([](soci::session& sql) {
            for (const char* table : {"jobs", "steps", "markers", "instances", "scans"})
                sql << std::string("DELETE FROM ") + table + " WHERE case_id = 'c1'";
            sql << "DELETE FROM cases WHERE id = 'c1'";
        });
    }
    EXPECT_TRUE(eventually([] { return the<QLabel>("warning")->text().startsWith("This case was deleted"); }));
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    settle();
    EXPECT_EQ(markers()->rowCount(), 0) << "nothing is shown as saved that is not";
    screenshot("deleted");
}

}  // namespace
}  // namespace vicon::viewer
