// What a reader set is found in the next case, in the same program and in the next one; the place is the case's.
#include <QAbstractSpinBox>
#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QLabel>
#include <QProcess>
#include <QSettings>
#include <QSlider>
#include <QTabWidget>
#include <algorithm>

#include "reading.h"
#include "test_colon.h"

namespace vicon::viewer {
namespace {

namespace fs = std::filesystem;
using test::Reading;

constexpr const char* kOtherCase = "c3";
constexpr const char* kOtherPatient = "PH-3";
constexpr const char* kOtherScan = "s5";
constexpr const char *kStoreVariable = "VICON_TEST_STORE", *kSettingsVariable = "VICON_TEST_SETTINGS";

/// A second case that can be read, of two scans as well.
void addOtherCase(const fs::path& folder)
{
    CaseStore store(folder);
    CaseRecord record;
    record.id = kOtherCase;
    record.patient = {kOtherPatient, "Third^Clara", "19700304", "F"};
    record.study.uid = "1.2.5";
    record.study.date = "20260103";
    int number = 0;
    for (const auto& [id, position] : {std::pair(kOtherScan, "HFS"), std::pair("s6", "HFP")}) {
        ScanRecord scan;
        scan.id = id;
        scan.case_id = record.id;
        scan.series.number = ++number;
        scan.series.uid = record.study.uid + "." + std::to_string(number);
        scan.series.patient_position = position;
        fs::create_directories(store.scanFolder(record.id, id));
        store.addScan(record, scan, {}, false);
        test::TestColon().write(store.scanFolder(record.id, id));
        store.writeScanFile(record.id, id);
    }
}

ReadingServices servicesForBoth(const fs::path& folder)
{
    ReadingServices services = test::servicesFor(folder);
    services.worklist = [before = services.worklist](CaseStore& store, const WorklistPageWanted& wanted) {
        WorklistPage page = before(store, wanted);
        for (WorklistCase& row : page.cases)
            if (row.record.id == kOtherCase) {
                row.state = WorkState::done;
                row.reason.clear();
                for (WorklistScan& scan : row.scans) {
                    scan.state = WorkState::done;
                    scan.reason.clear();
                }
            }
        return page;
    };
    return services;
}

class ReaderSettings : public Reading {
protected:
    void SetUp() override
    {
        if (inTheNextProgram()) {
            QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, qEnvironmentVariable(kSettingsVariable));
            store_ = qEnvironmentVariable(kStoreVariable).toStdString();
            services_ = servicesForBoth(store_);
            openRoom(services_);
            return;
        }
        Reading::SetUp();
        room_.reset();
        addOtherCase(store_);
        services_ = servicesForBoth(store_);
        openRoom(services_);
    }
    static bool inTheNextProgram() { return qEnvironmentVariableIsSet(kStoreVariable); }
    /// This test again, as a program of its own on the same store and the same settings.
    void runTheNextProgram() const
    {
        ASSERT_EQ(room_, nullptr) << "its window is closed";
        const auto* self = testing::UnitTest::GetInstance()->current_test_info();
        QProcess next;
        QProcessEnvironment variables = QProcessEnvironment::systemEnvironment();
        variables.insert(kStoreVariable, QString::fromStdString(store_.string()));
        QDir settings = QFileInfo(QSettings().fileName()).dir();
        settings.cdUp();
        variables.insert(kSettingsVariable, settings.path());
        next.setProcessEnvironment(variables);
        next.setProcessChannelMode(QProcess::ForwardedChannels);
        next.start(QCoreApplication::applicationFilePath(),
                   {QString("--gtest_filter=%1.%2").arg(self->test_suite_name(), self->name())});
        ASSERT_TRUE(eventually([&] { return next.state() == QProcess::NotRunning; }));
        EXPECT_EQ(next.exitStatus(), QProcess::NormalExit);
        EXPECT_EQ(next.exitCode(), 0) << "in a program of its own";
    }

    static QAction* action(const char* title)
    {
        for (QAction* one : window()->findChildren<QAction*>())
            if (one->text().startsWith(title))
                return one;
        return nullptr;
    }
    static double slider(const char* name) { return the<QSlider>(name)->value(); }
    static void jumpTo(double station_mm)
    {
        the<QDoubleSpinBox>("station")->setValue(station_mm);
        press(window(), "jump");
        ASSERT_TRUE(eventually([&] { return std::abs(station() - station_mm) < 2; }));
    }
    static void choosePeeling(const char* preset)
    {
        auto* peel = the<QComboBox>("peel");
        peel->setFocus();
        QTest::keyClick(peel, Qt::Key_Home);
        while (peel->currentData().toString() != preset)
            QTest::keyClick(peel, Qt::Key_Down);
        the<QWidget>("endoscopic")->setFocus();
    }
    static void tick(const char* box)
    {
        auto* widget = the<QWidget>(box);
        QTest::mouseClick(widget, Qt::LeftButton, {}, QPoint(8, widget->height() / 2));
    }
    static void setFlightAndTranslucency();
    static void setViews();
    static void expectAllOfIt(const char* where);
};

void ReaderSettings::setFlightAndTranslucency()
{
    choosePeeling("fat");
    for (int n = 0; n < 7; ++n)
        QTest::keyClick(the<QSlider>("peelOffset"), Qt::Key_Right);
    tick("peelCircle");
    tick("peelOver");
    QTest::keyClick(the<QSlider>("angle"), Qt::Key_End);
    key(Qt::Key_Plus);
    key(Qt::Key_G);
    ASSERT_EQ(the<QComboBox>("mode")->currentText(), "guided");
}

void ReaderSettings::setViews()
{
    key(Qt::Key_K, Qt::ShiftModifier);
    for (const char* look : {"Light: far", "Wall: bone", "Light: less between"})
        action(look)->trigger();
    key(Qt::Key_F8);
    key(Qt::Key_F8, Qt::ShiftModifier);
    key(Qt::Key_F6);
    key(Qt::Key_H);
    key(Qt::Key_5);
    key(Qt::Key_Y);
    key(Qt::Key_V);
    showList(1);
    QTest::keyClick(the<QAbstractSpinBox>("leastUnseen"), Qt::Key_Up);
    key(Qt::Key_U);
    key(Qt::Key_B, Qt::ShiftModifier);
    key(Qt::Key_C);
}

void ReaderSettings::expectAllOfIt(const char* where)
{
    SCOPED_TRACE(where);
    EXPECT_EQ(the<QComboBox>("peel")->currentData().toString(), "fat");
    EXPECT_EQ(slider("peelOffset"), 7);
    for (const char* box : {"peelCircle", "peelOver", "paintSeen"})
        EXPECT_TRUE(the<QAbstractButton>(box)->isChecked()) << box;
    EXPECT_EQ(slider("angle"), 120);
    EXPECT_EQ(slider("speed"), 35);
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
    EXPECT_FALSE(the<QAction>("tagging")->isChecked());
    EXPECT_FALSE(the<QAction>("ambientOcclusion")->isChecked());
    for (const char* on : {"Light: far", "Wall: bone", "Unfolded cube", "Band", "Both scans"})
        EXPECT_TRUE(action(on)->isChecked()) << on;
    EXPECT_GT(the<QWidget>("coronal")->width(), the<QWidget>("axial")->width()) << "the large slice";
    EXPECT_EQ(the<QComboBox>("window")->currentText(), "soft-tissue");
    EXPECT_TRUE(the<QAction>("tracks")->isChecked());
    EXPECT_EQ(the<QTabWidget>("lists")->currentIndex(), 1);
    EXPECT_EQ(the<QDoubleSpinBox>("leastUnseen")->value(), 301);
    EXPECT_TRUE(eventually([] { return drawn("cube") && drawn("band") && drawn("besideEndoscopic"); }));
}

TEST_F(ReaderSettings, AreFoundInAnotherCaseOfThisProgramAndOfTheNextAndThePlaceIsTheCases)
{
    constexpr double kPlace_mm = 150;
    if (!inTheNextProgram()) {
        openCase();
        window()->resize(1700, 1000);
        waitUntilQuiet();
        jumpTo(kPlace_mm);
        key(Qt::Key_R);
        setFlightAndTranslucency();
        setViews();
        waitUntilQuiet();
        expectAllOfIt("where it was set");
        screenshot("reader_settings_set");
        closeCase();
    }
    for (const char* program : {"this program", "the next program"}) {
        if (inTheNextProgram() == (std::string(program) == "this program"))
            continue;
        openCase(kOtherPatient);
        expectAllOfIt((std::string("in the other case, ") + program).c_str());
        EXPECT_NEAR(station(), 0, 2) << "where this case begins: " << program;
        screenshot(inTheNextProgram() ? "reader_settings_next_program" : "reader_settings_other_case");
        closeCase();
        openCase();
        expectAllOfIt((std::string("in the first case again, ") + program).c_str());
        EXPECT_NEAR(station(), kPlace_mm, 3) << program;
        closeCase();
    }
    if (inTheNextProgram())
        return;
    room_.reset();
    runTheNextProgram();
}

TEST_F(ReaderSettings, OnlyThePlaceIsKeptWithTheCase)
{
    openCase();
    jumpTo(60);
    setFlightAndTranslucency();
    setViews();
    waitUntilQuiet();
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForScan();
    closeCase();
    room_.reset();
    QSettings settings;
    settings.beginGroup(QString("place/") + test::kCase);
    const QStringList known{"scan", "to_rectum", test::kSupine, test::kProne};
    for (const QString& name : settings.allKeys())
        EXPECT_TRUE(known.contains(name)) << name.toStdString() << " is the reader's";
    EXPECT_FALSE(settings.allKeys().isEmpty());
}

TEST_F(ReaderSettings, GoWithTheReaderToTheOtherScan)
{
    openCase();
    jumpTo(100);
    setFlightAndTranslucency();
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForScan();
    ASSERT_TRUE(the<QComboBox>("scan")->currentText().startsWith("prone"));
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
    EXPECT_EQ(the<QComboBox>("peel")->currentData().toString(), "fat");
    EXPECT_EQ(slider("speed"), 35);
    EXPECT_NEAR(station(), 100, 5) << "at the same place";
}

TEST_F(ReaderSettings, OfAnEarlierReleaseThatLieWithTheCaseAreTakenUp)
{
    QSettings().setValue(QString("place/%1/peel").arg(test::kCase), "fat");
    QSettings().setValue(QString("place/%1/mode").arg(test::kCase), 1);
    QSettings().setValue(QString("place/%1/%2").arg(test::kCase, test::kSupine), 80.0);
    openCase();
    EXPECT_EQ(the<QComboBox>("peel")->currentData().toString(), "fat");
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
    EXPECT_NEAR(station(), 80, 3);
    closeCase();
    openCase(kOtherPatient);
    EXPECT_EQ(the<QComboBox>("peel")->currentData().toString(), "fat") << "the reader's from now on";
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
}

TEST_F(ReaderSettings, AreFoundInACaseThatIsOpenedBesideAndWhatIsClosedLastTakesNothingBack)
{
    openCase();
    choosePeeling("fat");
    QMainWindow* first = window();
    const auto other = [&]() -> QMainWindow* {
        for (QWidget* widget : QApplication::topLevelWidgets())
            if (widget != first && widget->objectName() == "reading")
                return qobject_cast<QMainWindow*>(widget);
        return nullptr;
    };
    startOpening(kOtherPatient);
    ASSERT_TRUE(eventually([&] { return other() && !other()->findChild<QLabel*>("where")->text().isEmpty(); }));
    auto* peel = other()->findChild<QComboBox*>("peel");
    EXPECT_EQ(peel->currentData().toString(), "fat") << "though the first case is still open";
    waitUntilQuiet();
    test::activate(other(), peel);
    QTest::keyClick(peel, Qt::Key_Home);
    ASSERT_EQ(peel->currentData().toString(), "");
    other()->close();
    ASSERT_TRUE(eventually([&] { return !other(); }));
    closeCase();
    openCase();
    EXPECT_EQ(the<QComboBox>("peel")->currentData().toString(), "") << "as it was set last";
}

using TwoCases = ReaderSettings;

TEST_F(TwoCases, EachCountsTheTimeOfItsOwnWindowsAlone)
{
    constexpr int kRead_s = 4;
    const auto read_s = [](const QWidget* in) {
        const QStringList parts = in->findChild<QLabel*>("readingTime")->text().split(':');
        return parts.value(0).toInt() * 60 + parts.value(1).toInt();
    };
    openCase();
    QMainWindow* first = window();
    startOpening(kOtherPatient);
    QMainWindow* other = nullptr;
    for (QWidget* widget : QApplication::topLevelWidgets())
        if (widget != first && widget->objectName() == "reading")
            other = qobject_cast<QMainWindow*>(widget);
    ASSERT_NE(other, nullptr);
    ASSERT_TRUE(eventually([&] { return !other->findChild<QLabel*>("where")->text().isEmpty(); }));
    waitUntilQuiet();
    const auto readIn = [&](QWidget* reading, const char* view, QWidget* active) {
        auto* picture = reading->findChild<QWidget*>(view);
        test::activate(active, picture);
        const int until_s = read_s(reading) + kRead_s;
        ASSERT_TRUE(eventually([&] {
            QTest::mouseMove(picture, picture->rect().center());
            return read_s(reading) >= until_s;
        }));
    };
    const int before_s = read_s(first);
    ASSERT_NO_FATAL_FAILURE(readIn(other, "endoscopic", other));
    EXPECT_LE(read_s(first) - before_s, 1) << "the second in which it was left";
    // A window of its own for a second screen is the case's as well.
    ASSERT_NO_FATAL_FAILURE(test::activate(first, first->findChild<QWidget*>("endoscopic")));
    QTest::keyClick(first, Qt::Key_F2);
    auto* slice = first->findChild<QWidget*>("axial");
    ASSERT_TRUE(eventually([&] { return slice->window() != first; }));
    const int other_s = read_s(other);
    ASSERT_NO_FATAL_FAILURE(readIn(first, "axial", slice->window()));
    EXPECT_LE(read_s(other) - other_s, 1);
    other->close();
    ASSERT_TRUE(eventually([&] { return QApplication::topLevelWidgets().indexOf(other) < 0; }));
    closeCase();
}

}  // namespace
}  // namespace vicon::viewer
