#include "whole_reading.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QTabWidget>
#include <QTableWidget>

#include "vicon/cases/report_versions.h"

namespace fs = std::filesystem;

namespace vicon::viewer::test {
namespace {

constexpr int kPatience_ms = 120000;
// Of a picture that is still worth looking at: the view from inside beside both scans' slices, at 1366.
constexpr int kLeastSide_px = 150;
constexpr double kPlace = 0.4;  // of the colon's length
constexpr int kMissedList = 1, kMarkerList = 0;
// In the view that is read in, from where its cross is: the wall beside the way.
constexpr QPoint kOneEnd{24, 16}, kOtherEnd{48, 32};

/// Before the names of its pictures.
std::string nameOf(const WalkOf& walk, const char* hands)
{
    return std::string(walk.phantom ? "phantom" : "scan") + "-" + std::to_string(walk.screen.width()) +
           (walk.slices_first ? "-2d-" : "-3d-") + hands;
}

}  // namespace

void WholeReading::SetUp()
{
    if (!GetParam().phantom)
        VICON_NEEDS_DATA("ctc-prone");
    patience_ms = kPatience_ms;
    copy_ = *folder_ / nameOf(GetParam(), hands());
    openStore(GetParam().phantom ? preparedStore("phantom", phantomStudy(), copy_)
                                 : preparedStore("ctc-prone", support::sharedData("ctc-prone"), copy_),
              copy_.filename());
}

void WholeReading::TearDown()
{
    if (HasFailure() && room_)
        screenshotNow("failed");
    StudyReader::TearDown();
    fs::remove_all(copy_);
}

QAction* WholeReading::actionOf(const QString& entry)
{
    for (auto* action : window()->findChildren<QAction*>())
        if (action->text() == entry)
            return action;
    return nullptr;
}

QWidget* WholeReading::shownDialog(const char* name)
{
    for (QWidget* widget : QApplication::topLevelWidgets())
        if (widget->objectName() == name && widget->isVisible())
            return widget;
    return nullptr;
}

bool WholeReading::formIsReady()
{
    return the<QPushButton>("reportPreview")->isEnabled();
}

bool WholeReading::has(int count) const
{
    return eventually([&] { return markers()->rowCount() == count && settled(); });
}

void WholeReading::look(const std::string& step, std::initializer_list<const char*> views)
{
    waitUntilQuiet();
    screenshotNow(step);
    EXPECT_EQ(window()->size(), GetParam().screen) << step;
    for (const char* name : views) {
        const auto* view = the<QWidget>(name);
        ASSERT_TRUE(view->isVisible()) << step << ": " << name;
        EXPECT_GE(std::min(view->width(), view->height()), kLeastSide_px) << step << ": " << name;
        EXPECT_EQ(view->visibleRegion().boundingRect().size(), view->size()) << step << ": " << name << " is cut";
    }
}

void WholeReading::readAll()
{
    ASSERT_NO_FATAL_FAILURE(openFirst());
    ASSERT_TRUE(eventually([] { return window() != nullptr; }));
    ASSERT_NO_FATAL_FAILURE(waitForScan());
    window()->resize(GetParam().screen);
    ASSERT_TRUE(eventually([] { return window()->size() == GetParam().screen; })) << "it does not fit this screen";
    waitUntilQuiet();
    ASSERT_NO_FATAL_FAILURE(lookAround());
    ASSERT_NO_FATAL_FAILURE(markAndMeasure());
    ASSERT_NO_FATAL_FAILURE(lookAtAllOfTheWall());
    ASSERT_NO_FATAL_FAILURE(lookAsAcquired());
    ASSERT_NO_FATAL_FAILURE(goThroughWhatWasMissed());
    if (GetParam().phantom) {
        ASSERT_NO_FATAL_FAILURE(readTheOtherScan());
    }
    ASSERT_NO_FATAL_FAILURE(report());
    ASSERT_NO_FATAL_FAILURE(command("Close"));
    ASSERT_TRUE(eventually([] { return window() == nullptr; }));
    CaseStore store(store_);
    EXPECT_EQ(reportStatus(store, case_id_).state, ReportState::final);
    EXPECT_EQ(store.markers(case_id_).size(), GetParam().phantom ? 2U : 1U);
}

/// Some of the way by flight or slice by slice, as the reader reads first; and back from the caecum.
void WholeReading::lookAround()
{
    constexpr double kWay_mm = 60;
    // Also where it is the usual one: it is kept for the reader, who read the last study otherwise.
    ASSERT_NO_FATAL_FAILURE(command(GetParam().slices_first ? "Hanging: 2D first" : "Hanging: 3D first"));
    waitUntilQuiet();
    look("opened", {"endoscopic", "axial", "coronal", "sagittal", "overview"});
    if (GetParam().slices_first)
        while (!HasFailure() && station() < kWay_mm) {
            const double before = station();
            ASSERT_NO_FATAL_FAILURE(scroll("axial", 8));
            ASSERT_TRUE(eventually([&] { return station() > before; })) << "the lumen is followed";
        }
    ASSERT_NO_FATAL_FAILURE(command("Fly or stop"));
    ASSERT_TRUE(eventually([] { return station() > 2 * kWay_mm; })) << "the flight, or the cine";
    ASSERT_NO_FATAL_FAILURE(command("Fly or stop"));
    ASSERT_NO_FATAL_FAILURE(command("Jump to the caecum"));
    ASSERT_TRUE(eventually([] { return length() - station() < 2; })) << "and turned about";
    ASSERT_NO_FATAL_FAILURE(scroll(first(), 8));
    ASSERT_TRUE(eventually([] { return length() - station() > 2 && pictureIsThere(); })) << "towards the rectum";
    ASSERT_NO_FATAL_FAILURE(command("Reverse the flight"));
}

void WholeReading::markAndMeasure()
{
    ASSERT_NO_FATAL_FAILURE(goTo(length() * kPlace));
    waitUntilQuiet();
    ASSERT_NO_FATAL_FAILURE(command("Red marker at the next click"));
    ASSERT_NO_FATAL_FAILURE(pick(first(), {kOneEnd}));
    ASSERT_TRUE(has(1)) << warning();
    waitUntilQuiet();
    look("marked", {"endoscopic", "axial", "overview"});
    ASSERT_NO_FATAL_FAILURE(command("Measure between two clicks"));
    // A slice's cross is at the marker by now.
    const bool in_slice = GetParam().slices_first;
    ASSERT_NO_FATAL_FAILURE(pick(first(), {in_slice ? QPoint() : kOneEnd, in_slice ? kOneEnd : kOtherEnd}));
    ASSERT_TRUE(eventually([&] { return stored(case_id_.c_str()).back().size.has_value() && settled(); })) << warning();
    look("measured", {"endoscopic", "axial", "overview"});
    ASSERT_NO_FATAL_FAILURE(command("Back to the view; ends tool and warning"));
}

void WholeReading::lookAtAllOfTheWall()
{
    ASSERT_NO_FATAL_FAILURE(command("Unfolded cube"));
    ASSERT_TRUE(eventually([] { return the<QWidget>("cube")->isVisible() && drawn("cube"); }));
    look("cube", {"endoscopic", "cube"});
    const QImage before = pictureOf("cube");
    ASSERT_NO_FATAL_FAILURE(pick("cube", {{-80, 16}}));
    EXPECT_TRUE(eventually([&] { return pictureOf("cube") != before; })) << "it looks there";
    waitUntilQuiet();
    ASSERT_NO_FATAL_FAILURE(command("Unfolded cube"));
    EXPECT_EQ(QApplication::focusWidget()->objectName(), first()) << "what was put away gives the keyboard back";
    ASSERT_NO_FATAL_FAILURE(command("Band (colon cut open)"));
    ASSERT_TRUE(eventually([] { return the<QWidget>("band")->isVisible() && drawn("band"); }));
    look("band", {first(), "band"});
    const double there = station();
    ASSERT_NO_FATAL_FAILURE(pick("band", {{160, 16}}));
    EXPECT_TRUE(eventually([&] { return std::abs(station() - there) > 2; })) << "it goes there";
    waitUntilQuiet();
    ASSERT_NO_FATAL_FAILURE(command("Band (colon cut open)"));
    ASSERT_NO_FATAL_FAILURE(command("Back to the view; ends tool and warning"));
}

void WholeReading::lookAsAcquired()
{
    for (const auto& [entry, step] : {std::pair("Without tagging (cleansed)", "cleansed"),
                                      std::pair("Wall as acquired (fluid and stool stand)", "acquired")}) {
        ASSERT_NO_FATAL_FAILURE(command(entry));
        EXPECT_TRUE(actionOf(entry)->isChecked());
        look(step, {"endoscopic", "axial"});
        ASSERT_NO_FATAL_FAILURE(command(entry));
        EXPECT_FALSE(actionOf(entry)->isChecked());
    }
}

void WholeReading::goThroughWhatWasMissed()
{
    ASSERT_NO_FATAL_FAILURE(command("Next missed region"));
    auto* list = the<QTableWidget>("unseen");
    ASSERT_TRUE(eventually([&] { return list->rowCount() > 2 && list->currentRow() == 0; })) << list->rowCount();
    look("missed", {"endoscopic", "axial"});
    ASSERT_NO_FATAL_FAILURE(pressButton("nextMissed"));
    ASSERT_TRUE(eventually([&] { return list->currentRow() == 1; }));
    waitUntilQuiet();
    const double second = station();
    ASSERT_NO_FATAL_FAILURE(command("Back to the view; ends tool and warning"));
    ASSERT_NO_FATAL_FAILURE(chooseLine(kMissedList, "unseen", 0));
    ASSERT_TRUE(eventually([&] { return station() != second && pictureIsThere(); }));
    ASSERT_NO_FATAL_FAILURE(command("Back to the view; ends tool and warning"));
}

void WholeReading::readTheOtherScan()
{
    ASSERT_NO_FATAL_FAILURE(chooseLine(kMarkerList, "markers", 0));
    ASSERT_TRUE(eventually([] { return std::abs(station() - length() * kPlace) < 20 && pictureIsThere(); }));
    const QString read = the<QComboBox>("scan")->currentText();
    ASSERT_NO_FATAL_FAILURE(command("Back to the view; ends tool and warning"));
    ASSERT_NO_FATAL_FAILURE(command("Both scans side by side"));
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic") && drawn("besideAxial"); })) << warning();
    EXPECT_EQ(the<QWidget>("besideAxial")->height() > the<QWidget>("besideEndoscopic")->height(),
              GetParam().slices_first)
        << "what is read in is the largest of the other scan, too";
    look("both-scans", {"endoscopic", "besideEndoscopic"});
    ASSERT_NO_FATAL_FAILURE(command("Other scan"));
    ASSERT_TRUE(eventually([&] { return the<QComboBox>("scan")->currentText() != read; }));
    waitForScan();
    ASSERT_NO_FATAL_FAILURE(command("Red marker at the next click"));
    ASSERT_NO_FATAL_FAILURE(pick(first(), {kOneEnd}));
    ASSERT_TRUE(has(2)) << warning();
    ASSERT_NO_FATAL_FAILURE(command("Back to the view; ends tool and warning"));
    ASSERT_NO_FATAL_FAILURE(pairBoth());
    ASSERT_NO_FATAL_FAILURE(command("Both scans side by side"));
    ASSERT_TRUE(eventually([] { return !the<QWidget>("beside")->isVisible(); }));
    ASSERT_NO_FATAL_FAILURE(command("Back to the view; ends tool and warning"));
}

void WholeReading::pairBoth()
{
    constexpr int kPairList = 4;
    ASSERT_NO_FATAL_FAILURE(chooseLine(kPairList, "pairs", 0));
    waitUntilQuiet();
    look("pairs", {"endoscopic", "besideEndoscopic"});
    ASSERT_NO_FATAL_FAILURE(pressButton("pairConfirm"));
    ASSERT_TRUE(eventually([&] {
        const auto all = stored(case_id_.c_str());
        return settled() && !all[0].partners.empty() && !all[1].partners.empty();
    }));
}

void WholeReading::report()
{
    constexpr int kSize_mm = 8;
    ASSERT_NO_FATAL_FAILURE(command("Report: findings, categories, signature"));
    ASSERT_TRUE(eventually([] { return the<QPushButton>("findingAdd")->isEnabled() && formIsReady(); })) << warning();
    ASSERT_NO_FATAL_FAILURE(pressButton("findingAdd"));
    ASSERT_TRUE(eventually([] { return the<QTableWidget>("findings")->rowCount() == 1 && formIsReady(); }));
    ASSERT_NO_FATAL_FAILURE(choose("morphology", 1));
    ASSERT_NO_FATAL_FAILURE(sayNumber("findingSize", kSize_mm));
    EXPECT_TRUE(eventually([] {
        return formIsReady() && the<QTableWidget>("findings")->item(0, 3)->text().toDouble() == kSize_mm;
    })) << the<QTableWidget>("findings")->item(0, 3)->text().toStdString();
    ASSERT_NO_FATAL_FAILURE(pressButton("reportAccept"));
    ASSERT_TRUE(eventually([] { return the<QPushButton>("reportSign")->isEnabled() && formIsReady(); }))
        << the<QLabel>("reportMissing")->text().toStdString();
    ASSERT_NO_FATAL_FAILURE(pressButton("reportFill"));
    ASSERT_TRUE(eventually(formIsReady));
    const auto* scrolled = the<QWidget>("reportForm")->findChild<QScrollArea*>();
    EXPECT_LE(scrolled->widget()->width(), scrolled->viewport()->width()) << "the form is wide enough for its parts";
    look("form", {"endoscopic", "reportForm"});
    ASSERT_NO_FATAL_FAILURE(preview());
    ASSERT_NO_FATAL_FAILURE(pressButton("reportSign"));
    ASSERT_TRUE(eventually([] { return shownDialog("confirmSigning") != nullptr; }));
    shownDialog("confirmSigning")->grab().save(QString(VICON_SCREENSHOTS "/%1-question.png").arg(name_.c_str()));
    ASSERT_NO_FATAL_FAILURE(sign(shownDialog("confirmSigning")));
    ASSERT_TRUE(eventually([] { return the<QPushButton>("reportAmend")->isVisible() && formIsReady(); })) << warning();
    window()->activateWindow();
    EXPECT_NE(QApplication::focusWidget(), the<QComboBox>("scan")) << "the next key would choose another scan";
    look("signed", {"endoscopic", "reportForm"});
}

void WholeReading::preview()
{
    ASSERT_NO_FATAL_FAILURE(pressButton("reportPreview"));
    ASSERT_TRUE(eventually([] { return shownDialog("reportPreview") != nullptr; })) << warning();
    QWidget* pages = shownDialog("reportPreview");
    ASSERT_TRUE(eventually([&] { return pagesAreDrawn(pages); }));
    EXPECT_LE(pages->height(), GetParam().screen.height()) << "it does not fit this screen";
    pages->grab().save(QString(VICON_SCREENSHOTS "/%1-preview.png").arg(name_.c_str()));
    ASSERT_NO_FATAL_FAILURE(leafThrough(pages));
    ASSERT_TRUE(eventually([] { return shownDialog("reportPreview") == nullptr; }));
    window()->activateWindow();
    ASSERT_TRUE(eventually([] { return formIsReady() && QApplication::focusWidget(); }));
}

}  // namespace vicon::viewer::test
