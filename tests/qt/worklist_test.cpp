#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>

#include "reading.h"

namespace vicon::viewer {
namespace {

using test::Reading;

TEST_F(Reading, WorklistSearchesFiltersAndRetriesAFailedCase)
{
    const auto shown = [&] {
        int count = 0;
        for (int row = 0; row < cases()->rowCount(); ++row)
            count += cases()->isRowHidden(row) ? 0 : 1;
        return count;
    };
    auto* search = room_->findChild<QLineEdit*>("search");
    const auto reason = [&] { return room_->findChild<QLabel*>("reason")->text(); };
    QTest::keyClicks(search, "bert");
    EXPECT_EQ(shown(), 1);
    EXPECT_EQ(reason(), "the series has a gap of 40 mm") << "what was found is chosen";
    search->clear();
    QTest::keyClicks(search, "anna");
    QTest::keyClick(search, Qt::Key_Return);
    ASSERT_NE(window(), nullptr);
    closeCase();
    search->clear();
    auto* state = room_->findChild<QComboBox*>("state");
    state->setCurrentIndex(state->findData("failed"));
    ASSERT_EQ(shown(), 1);
    const int failed = cases()->isRowHidden(0) ? 1 : 0;
    clickRow(cases(), failed);
    EXPECT_EQ(reason(), "the series has a gap of 40 mm");
    EXPECT_FALSE(room_->findChild<QPushButton*>("open")->isEnabled());
    screenshot("worklist");
    EXPECT_EQ(cases()->item(1 - failed, 6)->text(), "poor: prone");
    EXPECT_TRUE(cases()->item(1 - failed, 6)->toolTip().contains("collapsed over 38 mm"));
    press(room_.get(), "retry");
    EXPECT_TRUE(eventually([&] { return cases()->item(failed, 4)->text() == "queued"; }));
    EXPECT_EQ(shown(), 0) << "it is no longer failed";
}

TEST_F(Reading, OpeningCanBeCancelledAndTheScanThatIsOpenStays)
{
    startOpening();
    ASSERT_TRUE(eventually([] { return the<QWidget>("opening")->isVisible(); }));
    press(window(), "openingCancel");
    EXPECT_TRUE(eventually([] { return window() == nullptr; })) << "nothing was open in it";
    openCase();
    EXPECT_FALSE(the<QWidget>("opening")->isVisible());
    auto* scan = the<QComboBox>("scan");
    const QString open = scan->currentText();
    scan->setFocus();
    QTest::keyClick(scan, Qt::Key_Down);
    ASSERT_TRUE(the<QWidget>("opening")->isVisible());
    press(window(), "openingCancel");
    EXPECT_EQ(scan->currentText(), open);
    settle();
    EXPECT_EQ(scan->currentText(), open) << "what was read meanwhile is not shown";
    key(Qt::Key_End);
    EXPECT_TRUE(eventually([] { return length() - station() < 2; }));
}

}  // namespace
}  // namespace vicon::viewer
