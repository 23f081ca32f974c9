#include <QProgressBar>
#include <QTableWidget>

#include "reading.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

TEST_F(Reading, CorrectionsGoToThePipelineAndTheNewResultIsTakenOver)
{
    openCase();
    showList(2);
    auto* bridges = the<QTableWidget>("bridges");
    ASSERT_TRUE(eventually([&] { return bridges->rowCount() == 1; }));
    clickRow(bridges, 0);
    EXPECT_TRUE(eventually([] { return std::abs(station() - 180) < 3; }));
    const auto judged = [&] { return bridges->item(0, 3)->text(); };
    press(window(), "rejectBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "rejected, anna"; })) << judged().toStdString();
    press(window(), "confirmBridge");
    EXPECT_TRUE(eventually([&] { return judged() == "confirmed, anna"; }));
    key(Qt::Key_End);
    settle();
    press(window(), "correctCut");
    click("coronal", middle("coronal"));
    ASSERT_TRUE(eventually([] { return the<QProgressBar>("redo")->isVisible(); }));
    screenshot("corrected");
    ASSERT_TRUE(eventually([] { return !the<QProgressBar>("redo")->isVisible(); }));
    // What was seen is kept with the surface that it was seen on; the new one is another.
    const auto surface = [&] {
        for (const auto& entry : std::filesystem::directory_iterator(store_ / "cases" / test::kCase / "reading"))
            return readFile(entry.path()).substr(0, readFile(entry.path()).find('\n'));
        return std::string();
    };
    const std::filesystem::path reading = store_ / "cases" / test::kCase / "reading";
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(reading) && !surface().empty(); }));
    const std::string before = surface();
    waitForScan();
    EXPECT_LT(length() - station(), 10) << "the eye is where it was";
    closeCase();
    EXPECT_NE(surface(), before);
}

}  // namespace
}  // namespace vicon::viewer
