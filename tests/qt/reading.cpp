#include "reading.h"

#include <QAbstractScrollArea>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QSettings>
#include <QStatusBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QWindow>
#include <algorithm>
#include <utility>

#include "widgets/picture_view.h"
#include "widgets/under_way.h"

namespace vicon::viewer::test {
namespace {

/// It speaks in order: when it has shown one more window, of a pixel, what it had to say before was heard.
/// QGuiApplication::sync() would not do: another thread hears it.
bool windowSystemHasSpoken()
{
    QWindow last;
    last.setFlags(Qt::ToolTip | Qt::BypassWindowManagerHint | Qt::WindowDoesNotAcceptFocus);
    last.setGeometry(0, 0, 1, 1);
    last.show();
    return QTest::qWaitFor([&last] { return last.isExposed(); });
}

}  // namespace

std::unique_ptr<Display> Reader::display_;
std::unique_ptr<support::TemporaryFolder> Reader::folder_;
std::unique_ptr<QApplication> Reader::application_;

void Reader::SetUpTestSuite()
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

void Reader::TearDownTestSuite()
{
    application_.reset();
    folder_.reset();
    display_.reset();
}

void Reading::SetUp()
{
    store_ = *folder_ / testing::UnitTest::GetInstance()->current_test_info()->name();
    QSettings().clear();
    makeStore(store_);
    services_ = servicesFor(store_);
    openRoom(services_);
}

void Reader::openRoom(const ReadingServices& services, const std::string& case_id)
{
    room_ = makeReadingRoom(services, case_id);
    room_->show();
    ASSERT_TRUE(eventually([&] { return cases()->rowCount() > 0; }));
}

bool Reader::quiet()
{
    constexpr int kMost_ms = 100;  // an event may cause the next one without end
    const int begun = UnderWay::begun();
    if (UnderWay::count() > 0)
        return false;
    if (!windowSystemHasSpoken())
        return false;
    QCoreApplication::processEvents(QEventLoop::AllEvents, kMost_ms);
    return UnderWay::count() == 0 && UnderWay::begun() == begun;
}

void Reader::waitUntilQuiet()
{
    EXPECT_TRUE(eventually(quiet)) << UnderWay::count() << " still under way";
}

void Reader::waitUntilAtRest()
{
    constexpr int kPictures = 5;  // in a flight they are millimetres apart
    const auto* view = the<PictureView>("endoscopic");
    qint64 last = 0;
    double there = -1;
    int same = 0;
    EXPECT_TRUE(eventually([&] {
        if (std::exchange(last, view->image().cacheKey()) != last)
            same = std::exchange(there, pictureStation()) == there ? same + 1 : 0;
        return same == kPictures || quiet();
    }));
}

QTableWidget* Reader::cases() const
{
    return room_->findChild<QTableWidget*>("cases");
}

QMainWindow* Reader::window()
{
    for (QWidget* widget : QApplication::topLevelWidgets())
        if (widget->objectName() == "reading")
            return qobject_cast<QMainWindow*>(widget);
    return nullptr;
}

void Reader::press(QWidget* in, const char* name)
{
    auto* button = in->findChild<QPushButton*>(name);
    ASSERT_NE(button, nullptr) << name;
    ASSERT_TRUE(button->isEnabled()) << name;
    QTest::mouseClick(button, Qt::LeftButton);
}

void Reader::click(const char* view, QPoint at, Qt::KeyboardModifiers modifiers)
{
    QTest::mouseClick(the<QWidget>(view), Qt::LeftButton, modifiers, at);
}

void Reader::drag(const char* view, QPoint from, QPoint to, Qt::MouseButton button)
{
    auto* widget = the<QWidget>(view);
    QTest::mousePress(widget, button, {}, from);
    // QTest's own moves have no button down, and come by way of the display: on a busy machine after the release.
    for (int n = 1; n <= 4; ++n) {
        const QPoint at = from + (to - from) * n / 4;
        QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, button, {});
        QApplication::sendEvent(widget, &move);
    }
    QTest::mouseRelease(widget, button, {}, to);
}

void Reader::key(int which, Qt::KeyboardModifiers modifiers)
{
    QTest::keyClick(window(), Qt::Key(which), modifiers);
}

QPoint Reader::middle(const char* view)
{
    return the<QWidget>(view)->rect().center();
}

void Reader::showList(int which)
{
    QTabBar* bar = the<QTabWidget>("lists")->tabBar();
    QTest::mouseClick(bar, Qt::LeftButton, {}, bar->tabRect(which).center());
}

QTableWidget* Reader::markers()
{
    return the<QTableWidget>("markers");
}

void Reader::clickRow(QTableWidget* table, int row, int column)
{
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, table->visualItemRect(table->item(row, column)).center());
}

bool Reader::settled()
{
    return the<QWidget>("markerTable")->isEnabled();
}

QString Reader::cell(int row, int column)
{
    return markers()->item(row, column)->text();
}

std::string Reader::warning()
{
    return the<QLabel>("warning")->text().toStdString();
}

QString Reader::said()
{
    return window()->statusBar()->currentMessage();
}

bool Reader::pagesAreDrawn(const QWidget* preview)
{
    const QImage pages = preview->findChild<QAbstractScrollArea*>("reportPages")->viewport()->grab().toImage();
    const QRgb beside = pages.pixel(0, 0), paper = qRgb(255, 255, 255);
    for (int y = 0; y < pages.height(); ++y)
        for (int x = 0; x < pages.width(); ++x)
            if (pages.pixel(x, y) != beside && pages.pixel(x, y) != paper)
                return true;
    return false;
}

void Reader::chooseFile(const char* dialog, const QString& file)
{
    auto* asked = the<QFileDialog>(dialog);
    emit asked->fileSelected(file);  // how Qt's own dialog is used is Qt's business
    asked->reject();
    window()->activateWindow();
}

void Reader::startOpening(const char* patient_id)
{
    constexpr int kIdColumn = 1;
    for (int row = 0; row < cases()->rowCount(); ++row)
        if (cases()->item(row, kIdColumn)->text() == patient_id) {
            clickRow(cases(), row);
            break;  // the newest of the patient's
        }
    press(room_.get(), "open");
    ASSERT_NE(window(), nullptr);
}

void Reader::openCase(const char* patient_id)
{
    startOpening(patient_id);
    waitForScan();
}

void Reader::openOther()
{
    auto* scan = the<QComboBox>("scan");
    the<QLabel>("where")->clear();
    scan->setFocus();
    QTest::keyClick(scan, Qt::Key_Down);
    waitForScan();
}

void Reader::waitForScan()
{
    ASSERT_NO_FATAL_FAILURE(waitForPictures());
    waitUntilQuiet();
}

void Reader::waitForPictures()
{
    ASSERT_TRUE(eventually([] { return !the<QLabel>("where")->text().isEmpty(); })) << warning();
    ASSERT_TRUE(eventually([] { return drawn("endoscopic") && drawn("overview") && drawn("coronal"); })) << warning();
    ASSERT_TRUE(eventually([] { return pictureIsThere(); })) << warning();
    // The first picture does not wait for ambient occlusion.
    ASSERT_TRUE(eventually([] { return the<QWidget>("endoscopic")->property("shaded").toBool(); })) << warning();
    window()->activateWindow();
}

void Reader::closeCase()
{
    window()->close();
    ASSERT_TRUE(eventually([] { return window() == nullptr; }));
}

QImage Reader::pictureOf(const char* view)
{
    return the<QWidget>(view)->grab().toImage();
}

bool Reader::drawn(const char* view)
{
    const QImage image = pictureOf(view);
    const int x = image.width() / 2, y = image.height() / 2;
    for (int n = 1; n < std::min(x, y) / 2; ++n)
        if (image.pixel(x + n, y) != image.pixel(x, y))
            return true;
    return false;
}

double Reader::pictureStation()
{
    return the<QWidget>("endoscopic")->accessibleDescription().section(' ', 0, 0).toDouble();
}

bool Reader::pictureIsThere()
{
    constexpr double kRounding_mm = 1.5;
    return !the<QWidget>("endoscopic")->accessibleDescription().isEmpty() &&
           std::abs(pictureStation() - station()) < kRounding_mm;
}

double Reader::station()
{
    return the<QLabel>("where")->text().section(' ', 0, 0).toDouble();
}

double Reader::length()
{
    const QString text = the<QLabel>("where")->text();
    return station() + text.section(", ", 1).section(' ', 0, 0).toDouble();
}

void Reader::screenshot(const char* name) const
{
    waitUntilQuiet();
    screenshotNow(name);
}

void Reader::screenshotNow(const char* name) const
{
    QWidget* of = window() ? static_cast<QWidget*>(window()) : room_.get();
    of->grab().save(QString(VICON_SCREENSHOTS "/%1.png").arg(name));
}

std::vector<Marker> Reader::stored(const char* case_id) const
{
    CaseStore store(store_);
    return store.markers(case_id);
}

}  // namespace vicon::viewer::test
