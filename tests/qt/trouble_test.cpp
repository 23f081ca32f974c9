#include <gmock/gmock.h>
#include <soci/soci.h>
#include <sys/resource.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>
#include <csignal>

#include "reading.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

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
    key(Qt::Key_Escape);
    EXPECT_EQ(warning(), "");
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
    waitUntilQuiet();
    EXPECT_EQ(markers()->rowCount(), 0) << "nothing is shown as saved that is not";
    screenshot("deleted");
}

/// No file of this process may grow beyond a size, as on a disk that is full; given back at the end.
class FullDisk {
public:
    FullDisk()
    {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit none = before_;
        none.rlim_cur = 0;
        setrlimit(RLIMIT_FSIZE, &none);
    }
    ~FullDisk()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, SIG_DFL);
    }

private:
    rlimit before_{};
};

TEST_F(Reading, OnAFullDiskNothingIsShownAsSavedAndWhatWasSavedStays)
{
    openCase();
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    {
        const FullDisk full;
        click("endoscopic", middle("endoscopic") + QPoint(-60, 60), Qt::ShiftModifier);
        ASSERT_TRUE(eventually([] { return !warning().empty() && settled(); }));
        EXPECT_EQ(markers()->rowCount(), 1);
        EXPECT_THAT(warning(), testing::HasSubstr("disk"));
        key(Qt::Key_S, Qt::ControlModifier);  // a picture
        waitUntilQuiet();
        EXPECT_THAT(warning(), testing::Not(testing::HasSubstr("saved:")));
    }
    screenshot("full_disk");
    EXPECT_EQ(stored().size(), 1U);
    // When there is room again, the same reader goes on.
    click("endoscopic", middle("endoscopic") + QPoint(-60, 60), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2 && settled(); })) << warning();
    EXPECT_EQ(stored().size(), 2U);
}

TEST_F(Reading, AMissingOrDamagedFileIsNamedAndTheOtherScanCanBeRead)
{
    const auto folder = store_ / "cases" / test::kCase / test::kSupine;
    std::filesystem::remove(folder / "segments.mha");
    startOpening();
    ASSERT_TRUE(eventually([] { return !warning().empty(); }));
    EXPECT_THAT(warning(), testing::HasSubstr("segments.mha"));
    EXPECT_THAT(warning(), testing::HasSubstr("vicon work"));
    screenshot("missing");
    auto* scan = the<QComboBox>("scan");
    scan->setFocus();
    QTest::keyClick(scan, Qt::Key_Down);
    waitForScan();
    EXPECT_EQ(warning(), "");
    closeCase();
    replaceFile(folder / "segments.mha", "no volume");
    QSettings().clear();
    startOpening();
    ASSERT_TRUE(eventually([] { return !warning().empty(); }));
    EXPECT_THAT(warning(), testing::HasSubstr("segments.mha"));
}

TEST_F(Reading, OfTwoReadersOfACaseEachSeesTheOthersWorkAndNeitherLosesHis)
{
    openCase();
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    // The other reader has a worklist and a window of his own.
    const auto others_room = makeReadingRoom(test::servicesFor(store_), test::kCase);
    const auto others = [&]() -> QMainWindow* {
        for (QWidget* widget : QApplication::topLevelWidgets())
            if (widget->objectName() == "reading" && widget != window())
                return qobject_cast<QMainWindow*>(widget);
        return nullptr;
    };
    QMainWindow* mine = window();
    ASSERT_TRUE(eventually([&] { return others() != nullptr; }));
    QMainWindow* his = others() == mine ? window() : others();
    auto* list = his->findChild<QTableWidget*>("markers");
    ASSERT_TRUE(eventually([&] { return list->rowCount() == 1; }));
    ASSERT_TRUE(eventually([&] { return !his->findChild<QLabel*>("where")->text().isEmpty(); }));
    ASSERT_TRUE(eventually([&] { return !his->findChild<QWidget*>("endoscopic")->accessibleDescription().isEmpty(); }));
    // He adds one and deletes mine; I see it, and writing a note to what is gone is refused.
    auto* view = his->findChild<QWidget*>("endoscopic");
    QTest::mouseClick(view, Qt::LeftButton, Qt::ShiftModifier, view->rect().center() + QPoint(-60, 60));
    ASSERT_TRUE(eventually([&] { return stored().size() == 2; }));
    auto* my_list = mine->findChild<QTableWidget*>("markers");
    ASSERT_TRUE(eventually([&] { return my_list->rowCount() == 2; }));
    EXPECT_THAT(mine->findChild<QLabel*>("warning")->text().toStdString(), testing::HasSubstr("nother reader"));
    clickRow(list, 0);
    ASSERT_TRUE(eventually([&] { return his->findChild<QWidget*>("markerTable")->isEnabled(); }));
    press(his, "markerRemove");
    ASSERT_TRUE(eventually([&] { return stored().size() == 1; }));
    press(mine, "undo");  // would delete what he has deleted
    ASSERT_TRUE(eventually([&] {
        return mine->findChild<QLabel*>("warning")->text().contains("another reader") && my_list->rowCount() == 1;
    }));
    EXPECT_EQ(stored().size(), 1U);
    press(his, "undo");  // his own step comes back
    ASSERT_TRUE(eventually([&] { return stored().size() == 2; }));
    EXPECT_TRUE(eventually([&] { return my_list->rowCount() == 2; }));
    his->close();
    ASSERT_TRUE(eventually([&] { return others() == nullptr; }));
}

}  // namespace
}  // namespace vicon::viewer
