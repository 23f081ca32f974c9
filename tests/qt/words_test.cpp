// Words, the banner, the guide: what tells a reader where he is.
#include <QApplication>
#include <QClipboard>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QScrollBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QTextBlock>
#include <QTextBrowser>

#include "guide/guide.h"
#include "guide/guide_tool.h"
#include "reading.h"
#include "vicon/cases/case_store.h"
#include "widgets/picture_view.h"

namespace vicon::viewer {
namespace {

using test::Reading;

/// What stands at the top of the open guide.
std::string guideAt(QWidget* window)
{
    auto* text = window->findChild<QTextBrowser*>("guideText");
    return text ? text->textCursor().block().text().toStdString() : "";
}

int listNamed(const char* title)
{
    for (QWidget* window : QApplication::topLevelWidgets())
        if (auto* lists = window->findChild<QTabWidget*>("lists"))
            for (int n = 0; n < lists->count(); ++n)
                if (lists->tabText(n).remove('&') == title)
                    return n;
    return -1;
}

TEST_F(Reading, OneBannerNamesPatientAndScanAndPicturesThatLeaveTheWindowSayItThemselves)
{
    openCase();
    const auto* banner = the<QLabel>("banner");
    for (const char* some : {"Phantom", "PH-1", "1960", "supine"})
        EXPECT_TRUE(banner->text().contains(some)) << banner->text().toStdString();
    EXPECT_TRUE(window()->windowTitle().contains("PH-1"));
    key(Qt::Key_C, Qt::ControlModifier);
    const QImage copied = QApplication::clipboard()->image();
    const QImage shown = pictureOf("endoscopic");
    EXPECT_EQ(copied.width(), shown.width());
    const int line_px = copied.height() - shown.height();
    ASSERT_GT(line_px, 10) << "a line above the picture";
    int bright = 0;
    for (int y = 0; y < line_px; ++y)
        for (int x = 0; x < copied.width(); ++x)
            bright += qGray(copied.pixel(x, y)) > 150;
    EXPECT_GT(bright, 100) << "with words";
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForScan();
    EXPECT_TRUE(banner->text().contains("prone")) << banner->text().toStdString();
}

TEST_F(Reading, WhatAPersonMustDecideStandsInTheWorklistAndTheBannerUntilItIsSettled)
{
    const std::string first = "series 9 came after scan s1 was marked or reported",
                      second = "the patient ID is also that of case c2, with another name or birth date";
    CaseStore store(store_);
    store.flag(test::kCase, first);
    const auto line = [&] {
        for (int row = 0; row < cases()->rowCount(); ++row)
            if (cases()->item(row, 1)->text() == "PH-1")
                return row;
        return -1;
    };
    constexpr int kState = 4;
    ASSERT_TRUE(eventually([&] { return line() >= 0 && cases()->item(line(), kState)->text() == "done !"; }));
    EXPECT_EQ(cases()->item(line(), kState)->toolTip().toStdString(), "! " + first);
    clickRow(cases(), line());
    EXPECT_TRUE(room_->findChild<QLabel*>("reason")->text().contains(QString::fromStdString(first)));
    openCase();
    const auto* banner = the<QLabel>("banner");
    EXPECT_TRUE(banner->text().contains("! 1 to decide")) << banner->text().toStdString();
    EXPECT_TRUE(banner->toolTip().contains(QString::fromStdString(first)));
    store.flag(test::kCase, second);
    EXPECT_TRUE(eventually([&] { return banner->text().contains("! 2 to decide"); })) << "it came while one reads";
    EXPECT_TRUE(the<QLabel>("warning")->text().contains(QString::fromStdString(second)));
    waitUntilQuiet();
    screenshot("flags");
    store.settleFlag(test::kCase, first);
    store.settleFlag(test::kCase, second);
    EXPECT_TRUE(eventually([&] { return !banner->text().contains("!"); }));
    EXPECT_TRUE(banner->toolTip().isEmpty());
    EXPECT_TRUE(eventually([&] { return cases()->item(line(), kState)->text() == "done"; }));
}

TEST_F(Reading, TheWindowFitsTheScreenAtFirstAndThenOpensAsTheReaderLeftIt)
{
    openCase();
    const QSize screen = window()->screen()->availableSize();
    EXPECT_LE(window()->width(), screen.width());
    EXPECT_LE(window()->height(), screen.height());
    const QSize left(1180, 740);
    window()->resize(left);
    waitUntilQuiet();
    window()->close();
    ASSERT_TRUE(eventually([&] { return !window(); }));
    openCase();
    EXPECT_EQ(window()->size(), left);
}

TEST_F(Reading, ARedMarkerAwayFromAnyWallIsWarnedOf)
{
    openCase();
    window()->resize(1600, 1000);
    waitUntilQuiet();
    key(Qt::Key_Period);
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    EXPECT_EQ(warning(), "") << "on the wall";
    // The cross of a slice is on the centreline: in the middle of the gas.
    the<QWidget>("axial")->setFocus(Qt::TabFocusReason);
    key(Qt::Key_Period);
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
    waitUntilQuiet();
    QTest::keyClick(the<QWidget>("axial"), Qt::Key_Return, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2 && settled(); })) << warning();
    EXPECT_NE(warning().find("from the wall"), std::string::npos) << warning();
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 3 && settled(); }));
    EXPECT_EQ(warning(), "");
}

TEST_F(Reading, F1OpensTheGuideAtWhatTheReaderDoesOrLooksAt)
{
    room_->activateWindow();
    auto* search = room_->findChild<QLineEdit*>("search");
    search->setFocus();
    ASSERT_TRUE(eventually([&] { return QApplication::focusWidget() == search; }));
    QTest::keyClick(search, Qt::Key_F1);
    ASSERT_TRUE(eventually([&] { return room_->findChild<QDialog*>("guide") != nullptr; }));
    EXPECT_EQ(guideAt(room_.get()), "The worklist");
    room_->findChild<QDialog*>("guide")->close();
    openCase();
    const auto leads = [](const char* heading) {
        key(Qt::Key_F1);
        const bool there = eventually([&] { return guideAt(window()) == heading; });
        window()->activateWindow();
        return there;
    };
    key(Qt::Key_M);
    EXPECT_TRUE(leads("Measuring")) << guideAt(window());
    key(Qt::Key_Escape);
    the<QWidget>("peel")->setFocus(Qt::TabFocusReason);
    EXPECT_TRUE(leads("Translucency")) << guideAt(window());
    the<QWidget>("unseen")->setFocus(Qt::TabFocusReason);
    showList(1);
    the<QWidget>("unseen")->setFocus(Qt::TabFocusReason);
    EXPECT_TRUE(leads("Coverage")) << guideAt(window());
    the<QWidget>("axial")->setFocus(Qt::TabFocusReason);
    EXPECT_TRUE(leads("Hangings, and slices first")) << guideAt(window());
    EXPECT_GT(the<QTextBrowser>("guideText")->verticalScrollBar()->value(), 0);
    the<QDialog>("guide")->grab().save(VICON_SCREENSHOTS "/guide.png");
}

TEST_F(Reading, F1OpensTheGuideForPairsAndForTheSliceAcrossTheLumen)
{
    openCase();
    showList(listNamed("Pairs"));
    the<QWidget>("pairs")->setFocus(Qt::TabFocusReason);
    key(Qt::Key_F1);
    EXPECT_TRUE(eventually([] { return guideAt(window()) == "Supine and prone together"; })) << guideAt(window());
    the<QDialog>("guide")->close();
    window()->activateWindow();
    key(Qt::Key_F6);
    waitUntilQuiet();
    auto* across = the<QWidget>("across");
    for (int n = 0; n < 3 && !across->isVisible(); ++n) {
        key(Qt::Key_H);
        waitUntilQuiet();
    }
    ASSERT_TRUE(across->isVisible());
    QTest::mouseMove(across, middle("across"));
    key(Qt::Key_F1);
    EXPECT_TRUE(eventually([] { return guideAt(window()) == "Hangings, and slices first"; })) << guideAt(window());
}

TEST(Guide, HasEveryHeadingThatF1Leads)
{
    for (const QString& heading : GuideTool::headings())
        EXPECT_EQ(guideText().count(QRegularExpression("(^|\n)#+ " + QRegularExpression::escape(heading) + "\n")), 1)
            << heading.toStdString();
}

TEST_F(Reading, TheGuideBeginsWithAFirstCaseInTenStepsAndItsLinksLeadOn)
{
    openCase();
    key(Qt::Key_F1);
    ASSERT_TRUE(eventually([] { return window()->findChild<QDialog*>("guide") != nullptr; }));
    auto* text = the<QTextBrowser>("guideText");
    EXPECT_EQ(text->document()->begin().text(), "A first case in ten steps");
    text->moveCursor(QTextCursor::Start);
    EXPECT_TRUE(text->find("10. Report."));
    ASSERT_TRUE(text->find("From marks to a signed report"));
    EXPECT_GT(text->palette().color(QPalette::Link).lightness(), 128) << "on a dark ground";
    QTest::mouseClick(text->viewport(), Qt::LeftButton, Qt::NoModifier, text->cursorRect().center() - QPoint(20, 0));
    EXPECT_TRUE(eventually([] { return guideAt(window()) == "From marks to a signed report"; })) << guideAt(window());
    EXPECT_GT(text->textCursor().blockFormat().headingLevel(), 0) << "the page itself";
    the<QDialog>("guide")->grab().save(VICON_SCREENSHOTS "/guide_report.png");
    text->verticalScrollBar()->setValue(0);
    the<QDialog>("guide")->grab().save(VICON_SCREENSHOTS "/guide_first_case.png");
    text->moveCursor(QTextCursor::Start);
    window()->activateWindow();
    key(Qt::Key_R, Qt::ControlModifier);
    key(Qt::Key_F1);
    EXPECT_TRUE(eventually([] { return guideAt(window()) == "From marks to a signed report"; })) << guideAt(window());
}

TEST_F(Reading, NothingMakesTheWindowLargerThanASmallScreen)
{
    openCase();
    const QSize screen(1366, 738);  // of 1366 x 768 with a window's title
    window()->resize(screen);
    waitUntilQuiet();
    for (const auto& [which, modifier] : std::vector<std::pair<int, Qt::KeyboardModifier>>{
             {Qt::Key_F5, Qt::NoModifier}, {Qt::Key_B, Qt::ShiftModifier}, {Qt::Key_F8, Qt::NoModifier}}) {
        key(which, modifier);
        waitUntilQuiet();
        EXPECT_LE(window()->minimumSizeHint().height(), screen.height()) << which;
        EXPECT_EQ(window()->size(), screen) << which;
    }
    ASSERT_TRUE(eventually([] { return drawn("axial") && drawn("band"); }));
    screenshot("small_screen");
}

TEST_F(Reading, KeysStandInGroupsOnOnePage)
{
    openCase();
    key(Qt::Key_Question);
    auto* box = the<QDialog>("keys");
    for (const char* group : {"Case", "Edit", "Flight", "View", "Slices", "Help", "In&nbsp;a&nbsp;view"})
        EXPECT_TRUE(the<QLabel>("keysText")->text().contains(QString("<u>%1</u>").arg(group))) << group;
    EXPECT_LE(box->width(), 1366) << "on a small screen";
    box->grab().save(VICON_SCREENSHOTS "/keys.png");
    box->close();
}

}  // namespace
}  // namespace vicon::viewer
