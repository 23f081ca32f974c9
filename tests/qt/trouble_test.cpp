#include <QLabel>
#include <QTableWidget>

#include "reading.h"

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
