// MR: the window shows a signal in its own unit, and says why it lacks what needs densities.
#include <QComboBox>
#include <QMouseEvent>

#include "reading.h"
#include "slices/slice_view.h"
#include "vicon/scan_files/description_file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

class ReadingOfMr : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        for (const char* scan : {test::kSupine, test::kProne}) {
            const auto folder = store_ / "cases" / test::kCase / scan;
            auto description = scan_files::readDescription(folder);
            description.series.modality = "MR";
            description.steps.push_back(
                {.step = "segment",
                 .result = {
                     {"verdict", "colon"}, {"contrast", "dark"}, {"lumen_signal", 40.0}, {"tissue_signal", 420.0}}});
            scan_files::writeDescription(folder, description);
        }
    }
    static std::vector<std::string> windows()
    {
        std::vector<std::string> names;
        for (int n = 0; n < the<QComboBox>("window")->count(); ++n)
            names.push_back(the<QComboBox>("window")->itemText(n).toStdString());
        return names;
    }
};

TEST_F(ReadingOfMr, HasWindowsOfItsOwnAndKeysForThem)
{
    openCase();
    EXPECT_EQ(windows(), (std::vector<std::string>{"whole", "wall", "tissue"}));
    const QImage whole = pictureOf("axial");
    key(Qt::Key_5);
    ASSERT_TRUE(eventually([&] { return pictureOf("axial") != whole && quiet(); }));
    EXPECT_EQ(the<QComboBox>("window")->currentText(), "wall");
    screenshot("mr");
    key(Qt::Key_4);
    ASSERT_TRUE(eventually([&] { return pictureOf("axial") == whole; })) << "the first again";
}

TEST_F(ReadingOfMr, LacksWhatNeedsDensitiesAndSaysWhy)
{
    openCase();
    key(Qt::Key_T);
    EXPECT_NE(warning().find("MR has none"), std::string::npos) << warning();
    EXPECT_FALSE(the<QComboBox>("peel")->isEnabled());
    auto* axial = the<SliceView>("axial");
    QMouseEvent move(QEvent::MouseMove, middle("axial"), axial->mapToGlobal(middle("axial")), Qt::NoButton,
                     Qt::NoButton, {});
    QApplication::sendEvent(axial, &move);
    EXPECT_EQ(axial->readout(), "") << "a signal is no density";
}

TEST_F(Reading, OfCtHasTheWindowsOfCt)
{
    openCase();
    EXPECT_EQ(the<QComboBox>("window")->itemText(0), "colon");
    EXPECT_TRUE(the<QComboBox>("peel")->isEnabled());
}

}  // namespace
}  // namespace vicon::viewer
