// What a reader's work says of the study: what was missed of each scan, and how long it was read.
#include <QElapsedTimer>

#include "report_form.h"

namespace vicon::viewer {
namespace {

using test::Form;
using test::kProne;
using test::kSupine;
using testing::HasSubstr;
using testing::Not;

/// In this session the supine scan alone is opened; the prone one was read before.
class FormAfterReading : public Form {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        findColons();
        supine_ = test::reviewAllBut(store_, kSupine, supine_missed_mm_);
        prone_ = test::reviewAllBut(store_, kProne, prone_missed_mm_);
        openCase();
    }
    static std::string missed() { return the<QLabel>("reportMissed")->text().toStdString(); }

    std::vector<double> supine_missed_mm_{120}, prone_missed_mm_{120, 240};
    test::SeenWall supine_, prone_;
};

class FormAfterAllWasReviewed : public FormAfterReading {
protected:
    FormAfterAllWasReviewed()
    {
        supine_missed_mm_.clear();
        prone_missed_mm_.clear();
    }
};

TEST_F(FormAfterReading, TellsTheMissedRegionsOfEachScanAndAsksBeforeItIsSigned)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_TRUE(eventually([] { return the<QLabel>("reportMissed")->isVisible(); }));
    const auto both = testing::AllOf(HasSubstr("supine, series 1: 1 missed region of 300 mm² or more"),
                                     HasSubstr("prone, series 2: 2 missed regions of 300 mm² or more"));
    EXPECT_THAT(missed(), both);
    screenshot("form-missed");
    ASSERT_NO_FATAL_FAILURE(sayNormal());
    ASSERT_NO_FATAL_FAILURE(sign());
    EXPECT_THAT(question_, both);
    EXPECT_THAT(question_, HasSubstr("Sign it all the same?"));
    EXPECT_EQ(reportStatus(*store(), test::kCase).state, ReportState::final) << "asked, not refused";
}

TEST_F(FormAfterAllWasReviewed, SaysThatNothingWasMissed)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_NO_FATAL_FAILURE(sayNormal());
    ASSERT_NO_FATAL_FAILURE(sign());
    EXPECT_THAT(question_, HasSubstr("supine, series 1: no missed region of 300 mm² or more; 100.0 % reviewed"));
    EXPECT_THAT(question_, HasSubstr("prone, series 2: no missed region"));
    EXPECT_THAT(question_, Not(HasSubstr("all the same")));
}

TEST_F(Form, SaysOfAScanThatNobodyLookedAtThatItIsNotReviewed)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    const auto* missed = the<QLabel>("reportMissed");
    EXPECT_TRUE(eventually([&] { return missed->text().contains("prone, series 2: not reviewed"); }))
        << missed->text().toStdString();
}

TEST_F(FormAfterReading, CountsTheWallOfScansThatWereReadEarlier)
{
    ASSERT_NO_FATAL_FAILURE(openForm());
    type(Qt::Key_I, Qt::AltModifier);
    ASSERT_TRUE(eventually([&] { return said().coverage_percent.has_value(); })) << warning();
    const double both = 100 * (supine_.seen_mm2 + prone_.seen_mm2) / (supine_.whole_mm2 + prone_.whole_mm2);
    const double supine = 100 * supine_.seen_mm2 / supine_.whole_mm2;
    ASSERT_GT(supine - both, 0.4) << "they can be told apart";
    EXPECT_NEAR(*said().coverage_percent, both, 0.2) << "of the open scan a little more may be seen by now";
}

TEST_F(Form, TakesTheTimeOfReadingWithoutPauses)
{
    constexpr int kPause_ms = 15000;
    constexpr double kMinute_s = 60, kRounding_min = 0.11;  // it is said in tenths, and goes on
    const auto shown_s = [] {
        const QStringList parts = the<QLabel>("readingTime")->text().split(':');
        return parts.value(0).toInt() * kMinute_s + parts.value(1).toInt();
    };
    ASSERT_TRUE(eventually([&] {
        QTest::mouseMove(the<QWidget>("endoscopic"), middle("endoscopic"));
        return shown_s() > 0;
    }));
    QApplication::setActiveWindow(nullptr);  // another program is in front
    const double before_s = shown_s();
    QElapsedTimer away;
    away.start();
    ASSERT_TRUE(eventually([&] { return away.hasExpired(kPause_ms); }));
    EXPECT_EQ(QApplication::activeWindow(), nullptr);
    EXPECT_LE(shown_s() - before_s, 2);
    QApplication::setActiveWindow(window());
    ASSERT_NO_FATAL_FAILURE(openForm());
    type(Qt::Key_I, Qt::AltModifier);
    ASSERT_TRUE(eventually([&] { return said().reading_minutes.has_value(); })) << warning();
    EXPECT_NEAR(*said().reading_minutes, shown_s() / kMinute_s, kRounding_min) << "what the window's clock says";
}

}  // namespace
}  // namespace vicon::viewer
