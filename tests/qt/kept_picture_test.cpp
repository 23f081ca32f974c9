// The picture that is saved or copied is the one that is read, as it is seen.
#include <QApplication>
#include <QClipboard>
#include <QStatusBar>

#include "measuring.h"

namespace vicon::viewer {
namespace {

using test::Measuring;

class KeptPicture : public Measuring {
protected:
    void SetUp() override
    {
        Measuring::SetUp();
        key(Qt::Key_F6);  // the large slice is read in
        waitUntilQuiet();
    }
    /// What Ctrl+S writes.
    QImage saved()
    {
        const auto file = store_ / "cases" / test::kCase / "pictures" / (std::to_string(++saved_) + ".png");
        key(Qt::Key_S, Qt::ControlModifier);
        EXPECT_TRUE(eventually([&] { return said().contains("Picture saved") && std::filesystem::exists(file); }))
            << warning();
        return QImage(QString::fromStdString(file.string())).convertToFormat(QImage::Format_RGB32);
    }
    static QImage body(const QImage& kept, const char* view)
    {
        const int height = the<QWidget>(view)->height();
        return kept.copy(0, kept.height() - height, kept.width(), height);
    }
    static QImage seen(const char* view) { return pictureOf(view).convertToFormat(QImage::Format_RGB32); }
    static QImage words(const QImage& kept, const char* view)
    {
        return kept.copy(0, 0, kept.width(), kept.height() - the<QWidget>(view)->height());
    }
    static void doubleClick(const char* view)
    {
        QTest::mouseClick(the<QWidget>(view), Qt::LeftButton, {}, middle(view));
        QTest::mouseDClick(the<QWidget>(view), Qt::LeftButton, {}, middle(view));
        waitUntilQuiet();
    }
    int saved_ = 0;
};

TEST_F(KeptPicture, IsThatOfTheEnlargedViewAtThePlaceThatIsShown)
{
    click("axial", middle("axial"));  // the keyboard's marks go
    waitUntilQuiet();
    EXPECT_EQ(body(saved(), "axial"), seen("axial")) << "the view that is read in";
    doubleClick("endoscopic");
    ASSERT_FALSE(the<QWidget>("axial")->isVisible());
    key(Qt::Key_End);
    waitUntilQuiet();
    const QImage kept = saved();
    kept.save(VICON_SCREENSHOTS "/kept_picture_enlarged.png");
    const auto within = [](const QImage& image) {  // the ring of the keyboard is not kept
        constexpr int kRing_px = 2;
        return image.copy(image.rect().adjusted(kRing_px, kRing_px, -kRing_px, -kRing_px));
    };
    EXPECT_EQ(within(body(kept, "endoscopic")), within(seen("endoscopic")));
    key(Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(QApplication::clipboard()->image().convertToFormat(QImage::Format_RGB32), kept);
}

TEST_F(KeptPicture, HasTheLineThatIsMeasuredInIt)
{
    measuredBetween("axial", middle("axial"), middle("axial") + QPoint(80, 40));
    waitUntilQuiet();
    const QImage kept = saved();
    kept.save(VICON_SCREENSHOTS "/kept_picture_measured.png");
    EXPECT_NE(body(kept, "axial"), the<PictureView>("axial")->image().convertToFormat(QImage::Format_RGB32));
    EXPECT_EQ(body(kept, "axial"), seen("axial"));
}

TEST_F(KeptPicture, IsThatOfTheViewWithTheKeyboardWithoutItsMarksAndNamesTheScanThatThisShows)
{
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideAxial"); }));
    waitUntilQuiet();
    const QImage read = saved();
    const QImage without = seen("besideAxial");
    the<QWidget>("besideAxial")->setFocus(Qt::TabFocusReason);
    waitUntilQuiet();
    ASSERT_NE(seen("besideAxial"), without) << "it shows that it has the keyboard";
    const QImage kept = saved();
    kept.save(VICON_SCREENSHOTS "/kept_picture_beside.png");
    EXPECT_EQ(body(kept, "besideAxial"), without);
    EXPECT_NE(words(kept, "besideAxial"),
              words(read, "axial").copy(0, 0, kept.width(), words(kept, "besideAxial").height()))
        << "the other scan's";
}

}  // namespace
}  // namespace vicon::viewer
