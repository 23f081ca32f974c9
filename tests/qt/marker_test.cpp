#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>
#include <QTableWidget>
#include <atomic>
#include <thread>

#include "reading.h"
#include "vicon/cases/finding_facts.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

/// One marker, yellow, seen from where the case opens.
class WithMarker : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        openCase();
        key(Qt::Key_2);
        click("endoscopic", middle("endoscopic") + QPoint(90, 60));
        ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    }

    static bool reads(const char* position)
    {
        return eventually([&] { return the<QComboBox>("scan")->currentText().startsWith(position); });
    }
    /// The same finding in the other scan, which is read then; both are paired.
    void pairWithOther()
    {
        openOther();
        click("endoscopic", middle("endoscopic") + QPoint(90, 60), Qt::ShiftModifier);
        ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2; }));
        EXPECT_EQ(cell(1, 1), "prone");
        clickRow(markers(), 1);
        press(window(), "markerPair");
        clickRow(markers(), 0);
        ASSERT_TRUE(eventually([&] { return paired(true); }));
    }
    bool paired(bool both) const
    {
        const auto all = stored();
        return settled() && (partnerNames(all[0]) == all[1].id) == both && (partnerNames(all[1]) == all[0].id) == both;
    }
    void undo(const char* button) const
    {
        ASSERT_TRUE(eventually([&] { return the<QPushButton>(button)->isEnabled(); }));
        press(window(), button);
    }
};

TEST_F(WithMarker, FliesBackToTheViewThatWasSavedWithIt)
{
    ASSERT_EQ(stored().size(), 1U);
    EXPECT_EQ(stored()[0].color, MarkerColor::yellow);
    EXPECT_TRUE(stored()[0].view.has_value());
    EXPECT_EQ(stored()[0].scan_id, test::kSupine);
    screenshot("marker");
    const double seen_from = station();
    key(Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2; }));
    clickRow(markers(), 0);
    EXPECT_TRUE(eventually([&] { return std::abs(station() - seen_from) < 2; })) << "at " << station();
}

TEST_F(WithMarker, GetsANoteAndAnotherColourAndLosesItByUndo)
{
    const auto* note = markers()->item(0, 6);
    QTest::mouseClick(markers()->viewport(), Qt::LeftButton, {}, markers()->visualItemRect(note).center());
    QTest::mouseDClick(markers()->viewport(), Qt::LeftButton, {}, markers()->visualItemRect(note).center());
    auto* editor = markers()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    QTest::keyClicks(editor, "6 mm, sessile");
    QTest::keyClick(editor, Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return stored()[0].note == "6 mm, sessile" && settled(); }));
    auto* color = the<QComboBox>("markerColor");
    color->setFocus();
    QTest::keyClick(color, Qt::Key_Up);
    const auto is = [&](MarkerColor wanted) {
        return eventually([&] { return stored()[0].color == wanted && settled(); });
    };
    ASSERT_TRUE(is(MarkerColor::red));
    undo("undo");
    ASSERT_TRUE(is(MarkerColor::yellow));
    undo("redo");
    ASSERT_TRUE(is(MarkerColor::red));
    closeCase();
    openCase();
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1; }));
    EXPECT_EQ(cell(0, 6), "6 mm, sessile");
}

TEST_F(WithMarker, IsPairedAndPartedInOneStep)
{
    pairWithOther();
    undo("undo");
    ASSERT_TRUE(eventually([&] { return paired(false); }));
    undo("redo");
    ASSERT_TRUE(eventually([&] { return paired(true); }));
    EXPECT_EQ(cell(0, 4), cell(1, 0));
}

TEST_F(WithMarker, OfAPairBothAreShownSideBySide)
{
    pairWithOther();
    key(Qt::Key_C);
    const bool both = eventually([] { return drawn("besideEndoscopic") && drawn("besideAxial"); });
    screenshot("beside");
    ASSERT_TRUE(both);
    const auto beside = [] { return pictureOf("besideEndoscopic"); };
    waitUntilQuiet();
    const QImage first_shown = beside();
    press(window(), "stepOn");
    ASSERT_TRUE(eventually([&] { return beside() != first_shown; })) << "it moves with the other";
    waitUntilQuiet();
    const QImage along_the_path = beside();
    clickRow(markers(), 1);
    ASSERT_TRUE(eventually([&] { return beside() != along_the_path; }));
    screenshot("paired");
}

TEST_F(WithMarker, AClickBesideReadsOnInTheOtherScanAndTheCaseOpensSo)
{
    openOther();
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
    const double place = station();
    waitUntilQuiet();
    click("besideEndoscopic", middle("besideEndoscopic"));
    ASSERT_TRUE(reads("supine"));
    EXPECT_NEAR(station(), place, 1) << "the two are the same colon";
    closeCase();
    openCase();
    EXPECT_TRUE(the<QWidget>("besideEndoscopic")->isVisible()) << "side by side as it was left";
    EXPECT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
}

TEST_F(WithMarker, OfTheOtherScanTakesTheReaderThereAndIsDeleted)
{
    pairWithOther();
    key(Qt::Key_X);
    ASSERT_TRUE(reads("supine"));
    waitForScan();
    clickRow(markers(), 1);
    ASSERT_TRUE(reads("prone"));
    press(window(), "markerRemove");
    ASSERT_TRUE(eventually([&] { return stored().size() == 1 && settled(); }));
    // What is left moves into its row, and is not chosen by that.
    clickRow(markers(), 0);
    EXPECT_TRUE(reads("supine"));
}

TEST_F(WithMarker, IsDeletedByTheKeyOnceAndNoOtherWithIt)
{
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([&] { return stored().size() == 2 && settled(); }));
    clickRow(markers(), 0);
    key(Qt::Key_Delete);
    ASSERT_TRUE(eventually([&] { return stored().size() == 1 && settled(); }));
    EXPECT_FALSE(the<QPushButton>("markerRemove")->isEnabled());
    key(Qt::Key_Delete);
    waitUntilQuiet();
    EXPECT_EQ(stored().size(), 1U);
}

TEST_F(Reading, ASizeIsMeasuredBetweenTwoClicksAndKeptWithTheMarkerBesideIt)
{
    openCase();
    const QPoint first = middle("endoscopic") + QPoint(90, 60), second = first + QPoint(70, 30);
    click("endoscopic", first, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    waitUntilQuiet();
    const QImage without_line = pictureOf("endoscopic");
    key(Qt::Key_M);
    click("endoscopic", first);
    click("endoscopic", second);
    ASSERT_TRUE(eventually([&] { return stored()[0].size.has_value() && settled(); }));
    const auto size = stored()[0].size.value();
    EXPECT_GT(size.straight_mm, 1);
    EXPECT_GE(size.along_mm.value(), size.straight_mm - 1e-9);
    EXPECT_EQ(cell(0, 5), QString::number(largestDiameter_mm(size), 'f', 1));
    if (size.plane) {
        EXPECT_GE(size.plane->diameter_mm, size.straight_mm - 0.5);
    }
    screenshot("measured");
    EXPECT_NE(pictureOf("endoscopic"), without_line);
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") == without_line; }));
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return !stored()[0].size.has_value(); }));
}

TEST_F(Reading, NoSizeReachesFromOneScanToAnother)
{
    openCase();
    const QPoint first = middle("endoscopic") + QPoint(90, 60), second = first + QPoint(70, 30);
    key(Qt::Key_M);
    click("endoscopic", first);
    key(Qt::Key_X);
    const auto said = [] { return window()->statusBar()->currentMessage(); };
    ASSERT_TRUE(eventually([&] { return said().startsWith("The same place"); })) << "the other scan is there";
    waitForScan();
    click("endoscopic", first);
    EXPECT_TRUE(said().contains("the other end"))
        << "the end in the scan before does not count: " << said().toStdString();
    click("endoscopic", second);
    EXPECT_TRUE(eventually([] { return window()->statusBar()->currentMessage().contains("straight"); }));
}

TEST_F(Reading, TheToolChosenLastTakesTheClick)
{
    openCase();
    click("endoscopic", middle("endoscopic") + QPoint(90, 60), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    const Point3 before = stored()[0].position_mm;
    clickRow(markers(), 0);
    waitUntilQuiet();
    press(window(), "markerMove");
    key(Qt::Key_3);
    click("endoscopic", middle("endoscopic") + QPoint(-60, 60));
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2 && settled(); }));
    EXPECT_EQ(stored()[0].position_mm, before) << "placed, not moved";
    EXPECT_EQ(stored()[1].color, MarkerColor::green);
}

TEST_F(Reading, MarkersOfAFileAreLoadedInOneStepAndSaved)
{
    openCase();
    for (const QPoint by : {QPoint(90, 60), QPoint(-60, 60)}) {
        const int before = markers()->rowCount();
        click("endoscopic", middle("endoscopic") + by, Qt::ShiftModifier);
        ASSERT_TRUE(eventually([&] { return markers()->rowCount() == before + 1 && settled(); }));
    }
    const std::filesystem::path file = store_ / "list.json";
    key(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
    chooseFile("saveMarkers", file.c_str());
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file); }));
    auto list = nlohmann::json::parse(readFile(file));
    ASSERT_EQ(list["markers"].size(), 2U);
    // No list of completions opens over the buttons, where it would take the first click on them.
    ASSERT_TRUE(eventually([] { return !window()->findChild<QFileDialog*>("saveMarkers"); }));
    key(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
    auto* dialog = the<QFileDialog>("saveMarkers");
    // Once the folder is read, on another thread, completions are there at the letter that is typed.
    dialog->setDirectory(store_.c_str());
    const auto* listed = dialog->findChild<QListView*>("listView");
    ASSERT_TRUE(eventually([&] { return listed->model()->rowCount(listed->rootIndex()) > 0; }));
    QTest::keyClicks(dialog->findChild<QLineEdit*>("fileNameEdit"), QString((store_ / "lis").c_str()));
    waitUntilQuiet();
    EXPECT_EQ(QApplication::activePopupWidget(), nullptr);
    dialog->reject();
    window()->activateWindow();
    ASSERT_TRUE(eventually([] { return window()->isActiveWindow(); }));
    for (auto& marker : list["markers"])
        marker["note"] = "from the file";
    replaceFile(file, list.dump());
    key(Qt::Key_O, Qt::ControlModifier);
    chooseFile("loadMarkers", file.c_str());
    const auto notes = [&](const char* note) { return cell(0, 6) == note && cell(1, 6) == note && settled(); };
    ASSERT_TRUE(eventually([&] { return notes("from the file"); })) << warning();
    EXPECT_EQ(stored()[1].note, "from the file");
    clickRow(markers(), 1);
    key(Qt::Key_I);
    auto* box = the<QMessageBox>("markerInformation");
    EXPECT_TRUE(box->text().contains("from the file") && box->text().contains("supine"));
    screenshot("information");
    box->close();
    press(window(), "undo");
    EXPECT_TRUE(eventually([&] { return notes(""); })) << "one undo takes both back";
}

/// Its file of markers is never read to its end.
class EndlessMarkerFile : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        room_.reset();
        services_.import_markers = [this](CaseStore&, const std::string&, const std::filesystem::path&,
                                          Progress& wanted) {
            begun_ = true;
            while (!wanted.cancelled() && !over_)
                std::this_thread::yield();
            wanted.check();
            return std::vector<MarkerEdit>();
        };
        openRoom(services_);
    }
    void TearDown() override
    {
        over_ = true;
        Reading::TearDown();
    }

    std::atomic<bool> begun_ = false, over_ = false;
};

TEST_F(EndlessMarkerFile, IsGivenUpByEscAndMarkersStayAsTheyWere)
{
    openCase();
    click("endoscopic", middle("endoscopic"), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    const auto before = toJson(stored());
    const std::filesystem::path file = store_ / "list.json";
    replaceFile(file, before.dump());
    key(Qt::Key_O, Qt::ControlModifier);
    chooseFile("loadMarkers", file.c_str());
    ASSERT_TRUE(eventually([&] { return begun_.load(); }));
    EXPECT_FALSE(settled());
    EXPECT_TRUE(window()->statusBar()->currentMessage().contains("Esc"));
    window()->activateWindow();
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([] { return settled(); })) << "markers can be changed again";
    EXPECT_EQ(warning(), "");
    EXPECT_EQ(window()->statusBar()->currentMessage(), "Given up; nothing was changed.");
    EXPECT_EQ(toJson(stored()), before);
}

}  // namespace
}  // namespace vicon::viewer
