#include <QComboBox>
#include <QDoubleSpinBox>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>

#include "reading.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

TEST_F(Reading, FliesToTheCaecumAndBackAndIsWhereItWasAfterReopening)
{
    openCase();
    screenshot("opened");
    EXPECT_NEAR(station(), 0, 2);
    for (int n = 0; n < 30; ++n)
        key(Qt::Key_Plus);
    press(window(), "forward");
    ASSERT_TRUE(eventually([] { return station() > 60; }));
    screenshot("flying");
    press(window(), "stop");
    const double stopped = station();
    settle();
    EXPECT_NEAR(station(), stopped, 1);
    key(Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2; }));
    screenshot("caecum");
    EXPECT_EQ(the<QPushButton>("about")->text(), "To rectum") << "it looks into the colon, ready for the way back";
    key(Qt::Key_Space);
    ASSERT_TRUE(eventually([] { return length() - station() > 60; }));
    auto* spin = the<QDoubleSpinBox>("station");
    spin->setFocus();
    spin->selectAll();
    QTest::keyClicks(spin, "150");
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 150) < 2; }));
    closeCase();
    openCase();
    EXPECT_NEAR(station(), 150, 2);
    EXPECT_EQ(the<QPushButton>("about")->text(), "To rectum");
}

TEST_F(Reading, GuidedFlightIsSteeredByKeysAndComesBackWhenLetGo)
{
    openCase();
    key(Qt::Key_G);
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
    QTest::keyPress(window(), Qt::Key_W);
    ASSERT_TRUE(eventually([] { return station() > 40; }));
    QTest::keyRelease(window(), Qt::Key_W);
    screenshot("guided");
    const double let_go = station();
    settle();
    EXPECT_LT(std::abs(station() - let_go), 40) << "nothing pulls it any more";
}

TEST_F(Reading, AFilmIsMadeOrCancelledAndThePictureShowsHowItIsMade)
{
    openCase();
    const QImage plain = pictureOf("endoscopic");
    key(Qt::Key_O);
    ASSERT_TRUE(eventually([&] { return pictureOf("endoscopic") != plain; }));
    QTest::keyClick(the<QSlider>("angle"), Qt::Key_End);
    screenshot("structure");
    key(Qt::Key_O);
    const auto folder = store_ / "cases" / test::kCase / "pictures";
    const auto files = [&] {
        std::error_code none;
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none))
            names.push_back(entry.path().filename().string());
        return names;
    };
    for (int n = 0; n < 30; ++n)
        key(Qt::Key_Plus);
    auto* bar = the<QProgressBar>("filmBar");
    key(Qt::Key_M, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return bar->isVisible() && bar->value() > 5; }));
    press(window(), "filmCancel");
    EXPECT_TRUE(eventually([&] { return files().empty(); })) << "nothing is left of it";
    key(Qt::Key_End);
    the<QDoubleSpinBox>("station")->setValue(60);
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 60) < 2; }));
    key(Qt::Key_M, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return bar->isVisible(); }));
    ASSERT_TRUE(eventually([&] { return !bar->isVisible(); }));
    ASSERT_EQ(files(), std::vector<std::string>{"2.ogv"});
    EXPECT_EQ(readFile(folder / "2.ogv").substr(0, 4), "OggS");
    EXPECT_GT(std::filesystem::file_size(folder / "2.ogv"), 10000U);
}

}  // namespace
}  // namespace vicon::viewer
