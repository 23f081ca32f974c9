// Pages, files and signatures of a report take long: the button that began one gives it up, and pages nobody waits for
// hold up no window.
#include <QStatusBar>
#include <QTableWidget>
#include <atomic>
#include <thread>

#include "report_form.h"
#include "vicon/core/progress.h"

namespace vicon::viewer {
namespace {

using test::Form;
using testing::HasSubstr;

/// A report that is never done: it ends only when it is told that nobody wants it.
class EndlessReport : public Form {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        findColons();
        room_.reset();
        const auto endless = [this](const Progress& wanted) {
            ++begun_;
            while (!wanted.cancelled() && !over_)
                std::this_thread::yield();
            given_up_ += wanted.cancelled() ? 1 : 0;
            wanted.check();
        };
        services_.reporting.pdf = [endless](CaseStore&, const std::string&, Progress& wanted) {
            endless(wanted);
            return std::string();
        };
        services_.reporting.sign = [endless](CaseStore&, const std::string&, Progress& wanted) {
            endless(wanted);
            return ReportVersion();
        };
        services_.report = [endless](CaseStore&, const std::string&, Progress& wanted) {
            endless(wanted);
            return std::filesystem::path();
        };
        openRoom(services_);
    }
    void TearDown() override
    {
        over_ = true;
        Form::TearDown();
        EXPECT_EQ(begun_, given_up_);
    }
    bool isBegun(int times = 1)
    {
        return eventually([&] { return begun_ == times; });
    }
    static QString label(const char* button) { return the<QPushButton>(button)->text().remove('&'); }
    static QString said() { return window()->statusBar()->currentMessage(); }

    std::atomic<int> begun_ = 0, given_up_ = 0;
    std::atomic<bool> over_ = false;  ///< the test
};

TEST_F(EndlessReport, ItsPagesAreGivenUpByTheButtonThatAskedForThem)
{
    openCase();
    ASSERT_NO_FATAL_FAILURE(openForm());
    for (const int times : {1, 2}) {
        press(window(), "reportPreview");
        ASSERT_TRUE(isBegun(times));
        ASSERT_TRUE(eventually([] { return label("reportPreview") == "Stop"; }));
        screenshotNow("form-stop-pages");
        press(window(), "reportPreview");
        EXPECT_EQ(label("reportPreview"), "Preview") << "at once";
        EXPECT_TRUE(eventually([&] { return given_up_ == times; }));
    }
    waitUntilQuiet();
    EXPECT_THAT(said().toStdString(), HasSubstr("not drawn"));
    EXPECT_EQ(warning(), "");
    press(window(), "reportCopy");
    EXPECT_TRUE(eventually([] { return said().contains("clipboard"); })) << "the form goes on";
}

TEST_F(EndlessReport, ItsPagesAreGivenUpByTheKeyThatAskedForThem)
{
    openCase();
    ASSERT_NO_FATAL_FAILURE(openForm());
    type(Qt::Key_P, Qt::AltModifier);
    ASSERT_TRUE(isBegun());
    type(Qt::Key_P, Qt::AltModifier);
    EXPECT_TRUE(eventually([&] { return given_up_ == 1 && label("reportPreview") == "Preview"; }));
}

TEST_F(EndlessReport, ItsPagesDoNotKeepTheWindow)
{
    openCase();
    ASSERT_NO_FATAL_FAILURE(openForm());
    press(window(), "reportPreview");
    ASSERT_TRUE(isBegun());
    closeCase();
    EXPECT_EQ(given_up_, 1);
}

TEST_F(EndlessReport, ItsSignatureIsGivenUpByItsButtonAndNothingIsSigned)
{
    openCase();
    measureQuality();
    ASSERT_NO_FATAL_FAILURE(openForm());
    ASSERT_NO_FATAL_FAILURE(sayNormal());
    type(Qt::Key_G, Qt::AltModifier);
    QMessageBox* box = nullptr;
    ASSERT_TRUE(dialog("confirmSigning", &box));
    QTest::keyClick(box, Qt::Key_Return);
    ASSERT_TRUE(isBegun());
    window()->activateWindow();
    ASSERT_TRUE(eventually([] { return label("reportSign") == "Stop signing"; }));
    screenshotNow("form-stop-signing");
    press(window(), "reportSign");
    ASSERT_TRUE(eventually([] { return label("reportSign") == "Sign ..." && ready(); }));
    EXPECT_THAT(said().toStdString(), HasSubstr("nothing was signed"));
    EXPECT_EQ(warning(), "");
    EXPECT_TRUE(reportStatus(*store(), test::kCase).open());
}

TEST_F(EndlessReport, ItsFileIsGivenUpByTheSameKey)
{
    openCase();
    key(Qt::Key_P, Qt::ControlModifier);
    ASSERT_TRUE(isBegun());
    key(Qt::Key_P, Qt::ControlModifier);
    EXPECT_TRUE(eventually([] { return said().contains("nothing was written"); }));
    EXPECT_EQ(warning(), "");
}

TEST_F(EndlessReport, ItsFileIsGivenUpInTheWorklist)
{
    auto* report = room_->findChild<QPushButton*>("report");
    for (int row = 0; row < cases()->rowCount(); ++row)
        for (int column = 0; column < cases()->columnCount(); ++column)
            if (const auto* item = cases()->item(row, column); item && item->text() == "PH-1")
                cases()->selectRow(row);
    ASSERT_TRUE(eventually([&] { return report->isEnabled(); }));
    press(room_.get(), "report");
    ASSERT_TRUE(isBegun());
    EXPECT_EQ(report->text(), "Stop");
    press(room_.get(), "report");
    EXPECT_TRUE(eventually([&] {
        return report->text() == "Report" &&
               room_->findChild<QLabel*>("message")->text().contains("nothing was written");
    }));
}

}  // namespace
}  // namespace vicon::viewer
