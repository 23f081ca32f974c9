// A small synthetic study that went through the pipeline, read with the program's own services.
#include <QComboBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>

#include "study_walk.h"

namespace vicon::viewer::test {
namespace {

using SmallStudy = StudyWalk;

TEST_F(SmallStudy, IsReadInBothScansAndAllIsBackAfterReopening)
{
    const auto made = support::runVicon("phantom " + (*folder_ / "study").string() +
                                        " --size 160x160x134 --no-folds --gap 0 --seed 3");
    ASSERT_EQ(made.exit_code, 0) << made.output;
    openStore(preparedStore("small-study", *folder_ / "study", *folder_ / "small"), "study");
    openCase(patient_id_.c_str());
    screenshot("opened");
    fastest();
    ASSERT_NO_FATAL_FAILURE(markAndEdit());
    ASSERT_NO_FATAL_FAILURE(measure());
    ASSERT_NO_FATAL_FAILURE(keepPictureAndMarkers());
    EXPECT_NE(cell(0, 3), "") << "the part of the colon";

    // The same finding in the other scan; one undo parts the two again.
    clickRow(markers(), 0);
    const double there = station();
    key(Qt::Key_X);
    ASSERT_TRUE(eventually([] { return the<QComboBox>("scan")->currentText().startsWith("prone"); }));
    waitForScan();
    EXPECT_LT(std::abs(station() / length() - 0.6), 0.1) << "the corresponding place of " << there;
    place(Qt::Key_2, {60, 60});
    clickRow(markers(), 2);
    press(window(), "markerPair");
    clickRow(markers(), 0);
    const auto partner = [&](std::size_t n) { return stored(case_id_.c_str())[n].extra.value("pair", ""); };
    ASSERT_TRUE(eventually([&] { return partner(0) == "m3" && partner(2) == "m1" && settled(); })) << warning();
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return partner(0).empty() && partner(2).empty() && settled(); }));
    press(window(), "redo");
    ASSERT_TRUE(eventually([&] { return partner(0) == "m3" && partner(2) == "m1" && settled(); }));
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic") && drawn("besideTransverse"); }));
    screenshot("paired");
    key(Qt::Key_X);
    ASSERT_TRUE(eventually([] { return the<QComboBox>("scan")->currentText().startsWith("supine"); }));
    key(Qt::Key_R);
    ASSERT_NO_FATAL_FAILURE(writeReport());
    ASSERT_NO_FATAL_FAILURE(closeAndReopen());
    EXPECT_TRUE(the<QWidget>("besideEndoscopic")->isVisible());
    EXPECT_EQ(stored(case_id_.c_str()).size(), 3U);
}

}  // namespace
}  // namespace vicon::viewer::test
