// The report's form beside the views: from markers to a signed report, by keyboard and mouse.
#include "report_form.h"

#include <QCheckBox>
#include <QClipboard>
#include <QDialog>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QInputDialog>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTableWidget>

#include "test_colon.h"

namespace vicon::viewer {
namespace {

using test::Form;

TEST_F(Form, IsSignedByKeyboardAloneForANormalStudy)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    EXPECT_FALSE(the<QPushButton>("reportSign")->isEnabled());
    EXPECT_THAT(the<QLabel>("reportMissing")->text().toStdString(), testing::HasSubstr("category"));
    ASSERT_NO_FATAL_FAILURE(sayNormal());
    EXPECT_EQ(nameOf(said().colon_category->category), "C1");
    EXPECT_EQ(said().technique, "Low dose, tagged.") << "as the site has it";
    EXPECT_EQ(said().preparation, Grade::good);
    screenshot("form-normal");
    ASSERT_NO_FATAL_FAILURE(sign());
    EXPECT_EQ(reportStatus(*store(), test::kCase).state, ReportState::final);
    EXPECT_FALSE(the<QPlainTextEdit>("impression")->isEnabled());
    EXPECT_FALSE(the<QPushButton>("reportSign")->isVisible());
    screenshot("form-signed");
}

// The time is that of the keystroke-level model: 0.28 s a stroke, an average typist's 40 words a minute, and 1.35 s of
// thought before each of the five commands (Card, Moran, Newell, Communications of the ACM 23:7, 1980).
TEST_F(Form, OfANormalStudyTakesLessThanAMinuteAtTheKeyboardOfASlowTypist)
{
    constexpr double kStroke_s = 0.28, kThought_s = 1.35, kCommands = 5, kSlow = 2, kMost_s = 60;
    measureQuality();
    strokes_ = 2;  // Ctrl+R
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_NO_FATAL_FAILURE(tabTo("indication"));
    write("Screening, no symptoms.");
    type(Qt::Key_Tab);
    ASSERT_TRUE(
        eventually([&] { return !said().indication.empty() && the<QPushButton>("reportNormal")->isEnabled(); }));
    type(Qt::Key_L, Qt::AltModifier);
    ASSERT_TRUE(eventually([&] { return the<QPushButton>("reportSign")->isEnabled(); }));
    ASSERT_NO_FATAL_FAILURE(sign());
    EXPECT_EQ(reportStatus(*store(), test::kCase).state, ReportState::final);
    EXPECT_EQ(nameOf(said().colon_category->category), "C1");
    const double time_s = kStroke_s * strokes_ + kThought_s * kCommands;
    RecordProperty("strokes", strokes_);
    RecordProperty("seconds", std::to_string(time_s));
    std::printf("%d strokes, %.1f s; a typist half as fast %.1f s\n", strokes_, time_s, kSlow * time_s);
    EXPECT_LT(kSlow * time_s, kMost_s);
}

TEST_F(Form, FillsInWhatIsKnownAndLeavesWhatWasSaid)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    EXPECT_THAT(the<QPlainTextEdit>("technique")->placeholderText().toStdString(),
                testing::HasSubstr("supine (120 kV"));
    ASSERT_NO_FATAL_FAILURE(tabTo("indication"));
    for (const QChar c : QString("pain"))
        QTest::keyClick(QApplication::focusWidget(), c.toLatin1());
    type(Qt::Key_Tab);
    ASSERT_TRUE(eventually([&] { return said().indication == "pain" && the<QPushButton>("reportFill")->isEnabled(); }));
    type(Qt::Key_I, Qt::AltModifier);
    ASSERT_TRUE(eventually([&] { return said().reading_minutes.has_value(); })) << warning();
    EXPECT_EQ(said().indication, "pain");
    EXPECT_THAT(said().technique, testing::HasSubstr("supine (120 kV"));
    EXPECT_FALSE(said().preparation) << "that is the reader's to say";
    EXPECT_FALSE(said().colon_category);
    screenshot("form-filled");
}

TEST_F(Form, IsOpenedAgainByAnAmendmentThatCanBeTakenBack)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_NO_FATAL_FAILURE(sayNormal());
    ASSERT_NO_FATAL_FAILURE(sign());
    press(window(), "reportAmend");
    QInputDialog* why = nullptr;
    ASSERT_TRUE(dialog("whyAmend", &why));
    why->setTextValue("a word was missing");
    why->accept();
    window()->activateWindow();
    ASSERT_TRUE(eventually([] { return state().contains("amendment") && ready(); }));
    auto* impression = the<QPlainTextEdit>("impression");
    QTest::mouseClick(impression->viewport(), Qt::LeftButton);
    QTest::keyClicks(impression, "Normal.");
    type(Qt::Key_Tab);
    ASSERT_TRUE(eventually([&] { return said().impression == "Normal." && ready(); }));
    press(window(), "reportCancel");
    ASSERT_TRUE(eventually([] { return state().contains("signed") && ready(); }));
    EXPECT_EQ(said().impression, "");
    EXPECT_EQ(the<QPlainTextEdit>("impression")->toPlainText(), "");
}

TEST_F(Form, MakesAFindingOfMarkersAndKeepsWhatIsSaidOfIt)
{
    key(Qt::Key_2);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    const double at = stored()[0].station_mm;
    ASSERT_NO_FATAL_FAILURE(openForm());
    EXPECT_THAT(the<QLabel>("looseMarkers")->text().toStdString(), testing::HasSubstr("m1"));
    type(Qt::Key_N, Qt::AltModifier);
    ASSERT_TRUE(eventually([&] { return the<QTableWidget>("findings")->rowCount() == 1; })) << warning();
    EXPECT_THAT(found().at(0).markers, testing::ElementsAre("m1"));
    ASSERT_NO_FATAL_FAILURE(choose("morphology", 1));
    ASSERT_TRUE(eventually([&] { return found()[0].morphology == Morphology::sessile; }));
    ASSERT_NO_FATAL_FAILURE(tabTo("findingSize"));
    QTest::keyClicks(QApplication::focusWidget(), "12.5");
    type(Qt::Key_Tab);
    ASSERT_TRUE(eventually([&] { return found()[0].read_size_mm == 12.5; }));
    ASSERT_NO_FATAL_FAILURE(tabTo("findingNote"));
    QTest::keyClicks(QApplication::focusWidget(), "1 of 2, N");  // commands of the window elsewhere
    type(Qt::Key_Tab);
    ASSERT_TRUE(eventually([&] { return found()[0].note == "1 of 2, N"; }));
    EXPECT_EQ(stored().size(), 1U);
    EXPECT_TRUE(eventually([] { return the<QLabel>("colonCategoryReason")->text().contains("C3"); }));
    EXPECT_TRUE(eventually([] { return the<QLabel>("findingPicture")->isVisible(); }));
    screenshot("form-finding");
    type(Qt::Key_Escape);
    key(Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2; }));
    clickRow(the<QTableWidget>("findings"), 0);
    EXPECT_TRUE(eventually([&] { return std::abs(station() - at) < 40; })) << "flies there";
    press(window(), "findingRemove");
    ASSERT_TRUE(eventually([&] { return found().empty(); }));
    EXPECT_EQ(stored().size(), 1U) << "its marker stays";
}

TEST_F(Form, ShowsAFindingWhereItsLeadingMarkerIsByNow)
{
    key(Qt::Key_2);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    ASSERT_NO_FATAL_FAILURE(openForm());
    type(Qt::Key_N, Qt::AltModifier);
    const auto* picture = the<QLabel>("findingPicture");
    const auto shown = [&] { return picture->pixmap(Qt::ReturnByValue).toImage(); };
    ASSERT_TRUE(eventually([&] { return picture->isVisible() && !shown().isNull(); })) << warning();
    waitUntilQuiet();
    const QImage before = shown();
    screenshot("form-finding-before");
    {  // by another reader
        CaseStore other(store_);
        Marker marker = stored()[0];
        marker.view.reset();
        marker.station_mm = 150;
        marker.position_mm = test::TestColon().skeleton.at(marker.station_mm).position_mm + Vector3{0, 0, 8};
        other.saveMarker(test::kCase, marker);
    }
    EXPECT_TRUE(eventually([&] { return picture->isVisible() && !shown().isNull() && shown() != before; }));
    waitUntilQuiet();
    screenshot("form-finding-moved");
    const QImage moved = shown();
    {  // a note is not seen in it
        CaseStore other(store_);
        Marker marker = stored()[0];
        marker.note = "flat";
        other.saveMarker(test::kCase, marker);
    }
    ASSERT_TRUE(eventually([] { return cell(0, 6) == "flat"; }));
    EXPECT_TRUE(picture->isVisible()) << "it stays";
    waitUntilQuiet();
    EXPECT_EQ(shown(), moved);
}

TEST_F(Form, CountsEveryClickOnANumbersArrowHoweverFast)
{
    key(Qt::Key_1);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    ASSERT_NO_FATAL_FAILURE(openForm());
    press(window(), "findingAdd");
    ASSERT_TRUE(eventually([] { return the<QTableWidget>("findings")->rowCount() == 1 && ready(); })) << warning();
    auto* size = the<QDoubleSpinBox>("findingSize");
    for (int n = 1; n <= 8; ++n) {
        size->stepUp();
        QCoreApplication::processEvents();  // what was saved meanwhile is shown
    }
    ASSERT_TRUE(eventually(ready));
    EXPECT_EQ(found().at(0).read_size_mm, 8);
    EXPECT_EQ(size->value(), 8);
}

TEST_F(Form, LeadsFromTheMeasuredSizeToWholeMillimetres)
{
    key(Qt::Key_1);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    CaseStore store(store_);
    const Marker before = stored()[0];
    Marker after = before;
    after.size = MarkerSize{.straight_mm = 7.2, .from_mm = before.position_mm, .to_mm = before.position_mm};
    store.editMarkers(test::kCase, {{before, after}});
    ASSERT_NO_FATAL_FAILURE(openForm());
    press(window(), "findingAdd");
    auto* size = the<QDoubleSpinBox>("findingSize");
    ASSERT_TRUE(eventually([&] { return ready() && size->text().contains("7.2"); })) << size->text().toStdString();
    size->stepUp();
    EXPECT_EQ(size->value(), 8);
}

TEST_F(Form, AsksWhyWhereTheChosenCategoryIsNotTheProposedOne)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_NO_FATAL_FAILURE(choose("distension-rectum-supine", 1));
    ASSERT_TRUE(eventually([] { return the<QPushButton>("reportNormal")->isEnabled(); }));
    form()->setFocus();
    ASSERT_NO_FATAL_FAILURE(choose("colonCategoryChoice", 1));  // C0
    EXPECT_EQ(QApplication::focusWidget()->objectName(), "colonCategoryWhy");
    EXPECT_FALSE(said().colon_category) << "not without a reason";
    QTest::keyClicks(QApplication::focusWidget(), "stool everywhere");
    type(Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return said().colon_category.has_value(); }));
    EXPECT_EQ(nameOf(said().colon_category->category), "C0");
    EXPECT_EQ(said().colon_category->why, "stool everywhere");
}

TEST_F(Form, NamesMarkersOfNoFindingBeforeItIsSigned)
{
    key(Qt::Key_2);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    ASSERT_NO_FATAL_FAILURE(openForm());
    type(Qt::Key_A, Qt::AltModifier);
    ASSERT_TRUE(eventually([&] { return said().extracolonic_category && ready(); }));
    form()->setFocus();
    ASSERT_NO_FATAL_FAILURE(choose("colonCategoryChoice", 1));  // C0
    QTest::keyClicks(QApplication::focusWidget(), "stool everywhere");
    type(Qt::Key_Return);
    ASSERT_TRUE(eventually([] { return the<QPushButton>("reportSign")->isEnabled(); }))
        << the<QLabel>("reportMissing")->text().toStdString();
    ASSERT_NO_FATAL_FAILURE(sign());
    EXPECT_THAT(question_, testing::HasSubstr("0 findings, colon C0"));
    EXPECT_THAT(question_, testing::HasSubstr("Markers not assigned to a finding: m1."));
}

TEST_F(Form, KeepsWhatAnotherReaderSaidFirst)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    Assessment other;
    other.impression = "somebody else's";
    saveAssessment(*store(), test::kCase, {}, other);
    ASSERT_NO_FATAL_FAILURE(choose("preparation", 1));
    EXPECT_TRUE(eventually([] { return !warning().empty(); }));
    EXPECT_EQ(the<QPlainTextEdit>("impression")->toPlainText(), "somebody else's");
    EXPECT_FALSE(said().preparation);
}

TEST_F(Form, ListsWhatLiesOutsideTheColon)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_NO_FATAL_FAILURE(tabTo("extracolonicOrgan"));
    QTest::keyClicks(QApplication::focusWidget(), "kidney");
    type(Qt::Key_Tab);
    QTest::keyClicks(QApplication::focusWidget(), "cyst of 20 mm");
    type(Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return said().extracolonic.size() == 1; }));
    EXPECT_EQ(said().extracolonic[0].organ, "kidney");
    EXPECT_EQ(said().extracolonic[0].category, ExtracolonicCategory::e1);
    ASSERT_TRUE(eventually([] { return the<QTableWidget>("extracolonic")->rowCount() == 1 && ready(); }));
    clickRow(the<QTableWidget>("extracolonic"), 0);
    press(window(), "extracolonicRemove");
    EXPECT_TRUE(eventually([&] { return said().extracolonic.empty(); }));
}

TEST_F(Form, ShowsItsPagesAndGivesItsText)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    type(Qt::Key_P, Qt::AltModifier);
    QDialog* pages = nullptr;
    ASSERT_TRUE(dialog("reportPreview", &pages));
    EXPECT_THAT(pages->windowTitle().toStdString(), testing::HasSubstr("2 page"));
    EXPECT_TRUE(eventually([&] { return pagesAreDrawn(pages); }));
    pages->close();
    window()->activateWindow();
    ASSERT_TRUE(eventually(ready));
    press(window(), "reportCopy");
    EXPECT_TRUE(eventually([] { return QApplication::clipboard()->text() == "the report of c1"; }));
}

TEST_F(Form, TakesTheListsPlaceInANarrowWindowAndGivesItBack)
{
    constexpr int kLeastPicture_px = 400;
    const QSize screen(1366, 738);  // of 1366 x 768 with a window's title
    window()->resize(screen);
    ASSERT_TRUE(eventually([&] { return window()->size() == screen; }));
    waitUntilQuiet();
    const int before_px = the<QWidget>("endoscopic")->width();
    for (const char* time : {"first", "again"}) {
        ASSERT_NO_FATAL_FAILURE(openForm());
        waitUntilQuiet();
        screenshot("form_1366");
        EXPECT_EQ(window()->size(), screen);
        EXPECT_GE(the<QWidget>("endoscopic")->width(), kLeastPicture_px);
        EXPECT_FALSE(the<QWidget>("overview")->isVisible());
        key(Qt::Key_R, Qt::ControlModifier);
        ASSERT_TRUE(eventually([] { return the<QWidget>("overview")->isVisible(); }));
        EXPECT_TRUE(the<QWidget>("lists")->isVisible());
        waitUntilQuiet();
        EXPECT_NEAR(the<QWidget>("endoscopic")->width(), before_px, 8) << time;
    }
    const int side_px = the<QWidget>("overview")->width();
    ASSERT_NO_FATAL_FAILURE(openForm());
    closeCase();
    openCase();
    window()->resize(screen);
    waitUntilQuiet();
    EXPECT_NEAR(the<QWidget>("overview")->width(), side_px, side_px / 10) << "closed with the form, opened without";
    const QSize large(1920, 1080);
    window()->resize(large);
    ASSERT_NO_FATAL_FAILURE(openForm());
    EXPECT_TRUE(the<QWidget>("overview")->isVisible()) << "there is room for both";
}

TEST_F(Form, LosesNoWordThatWasBeingTypedWhenTheWindowCloses)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_NO_FATAL_FAILURE(tabTo("indication"));
    QTest::keyClicks(QApplication::focusWidget(), "Screening.");
    closeCase();
    EXPECT_EQ(said().indication, "Screening.");
}

}  // namespace
}  // namespace vicon::viewer
