// Words, the banner, the guide: what tells a reader where he is.
#include <QApplication>
#include <QClipboard>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QScrollBar>
#include <QTabWidget>
#include <QTextBlock>
#include <QTextBrowser>

#include "guide/guide.h"
#include "guide/guide_tool.h"
#include "reading.h"
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
        EXPECT_TRUE(QString(kGuideText).contains("\n## " + heading + "\n")) << heading.toStdString();
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
