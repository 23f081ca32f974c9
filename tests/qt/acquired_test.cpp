// What is clicked and measured is what is shown, and is measured as acquired.
#include <QAction>

#include "reading.h"
#include "slices/slice_view.h"
#include "test_colon.h"
#include "vicon/cases/case_store.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

/// Tagged fluid fills the colon from a station on; cleansed densities know nothing of it.
class AsAcquired : public Reading {
protected:
    static constexpr double kPool_mm = 14, kVoxel_mm = 2;

    void SetUp() override
    {
        Reading::SetUp();
        fill(test::kSupine);
        fill(test::kProne);
        openCase();
        window()->resize(1600, 1000);
        key(Qt::Key_Home);
        ASSERT_TRUE(eventually([] { return station() < 2 && pictureIsThere(); }));
        waitUntilQuiet();
    }
    void fill(const char* scan) const
    {
        test::TestColon colon;
        const auto folder = CaseStore(store_).scanFolder(test::kCase, scan);
        scan_files::writeVolume(folder / "cleansed.mha", colon.volume, scan_files::Packing::raw);
        for (std::size_t n = 0; n < colon.volume.voxels.size(); ++n)
            if (colon.inside.voxels[n] != kOutside &&
                stationOf(colon.volume.grid.pointAt(colon.volume.grid.indexOf(n))) > kPool_mm)
                colon.volume.voxels[n] = 500;
        scan_files::writeVolume(folder / "volume.mha", colon.volume, scan_files::Packing::raw);
    }
    double stationOf(Point3 p) const { return path_.nearest(p).station_mm; }
    static void showAcquired(bool on)
    {
        if (the<QAction>("acquired")->isChecked() != on)
            key(Qt::Key_K, Qt::ControlModifier);
        waitUntilQuiet();
    }
    /// The station of a marker that is set there.
    double marked(QPoint at, const char* view = "endoscopic")
    {
        const int before = markers()->rowCount();
        click(view, at, Qt::ShiftModifier);
        EXPECT_TRUE(eventually([&] { return markers()->rowCount() == before + 1 && settled(); })) << warning();
        return stationOf(stored().back().position_mm);
    }
    static bool cleansed() { return the<QAction>("cleansed")->isChecked(); }

    const Skeleton path_ = test::TestColon().skeleton;
};

TEST_F(AsAcquired, ClicksFromInsideLandOnTheWallThatIsShown)
{
    showAcquired(true);
    screenshot("pool_as_acquired");
    EXPECT_NEAR(marked(middle("endoscopic")), kPool_mm, kVoxel_mm) << "on the fluid that is shown";
    showAcquired(false);
    EXPECT_GT(marked(middle("endoscopic")), kPool_mm + 5) << "on the wall behind it";
}

TEST_F(AsAcquired, SizesOfAWallAsAcquiredJoinThePlacesThatAreShown)
{
    showAcquired(true);
    marked(middle("endoscopic"));
    key(Qt::Key_M);
    click("endoscopic", middle("endoscopic") - QPoint(40, 0));
    click("endoscopic", middle("endoscopic") + QPoint(40, 0));
    ASSERT_TRUE(eventually([&] { return stored()[0].size.has_value() && settled(); }))
        << said().toStdString() << warning();
    const MarkerSize size = stored()[0].size.value();
    EXPECT_NEAR(stationOf(size.from_mm), kPool_mm, kVoxel_mm);
    EXPECT_NEAR(stationOf(size.to_mm), kPool_mm, kVoxel_mm);
    EXPECT_FALSE(size.along_mm) << "no way over a surface that is not shown";
    screenshot("measured_as_acquired");
}

TEST_F(AsAcquired, OverFluidNothingIsTakenOfTheWallBehindIt)
{
    showAcquired(true);
    key(Qt::Key_T);
    drag("endoscopic", middle("endoscopic"), middle("endoscopic") + QPoint(40, 0));
    EXPECT_TRUE(eventually([] { return warning().find("too little tissue") != std::string::npos; })) << warning();
    key(Qt::Key_Escape);
    key(Qt::Key_M, Qt::ShiftModifier);
    click("endoscopic", middle("endoscopic"));
    EXPECT_TRUE(eventually([] { return warning().find("Click on its two ends") != std::string::npos; })) << warning();
}

TEST_F(AsAcquired, WhatIsMeasuredInSlicesIsShownAsAcquired)
{
    for (const auto& [which, with] : {std::pair(Qt::Key_M, Qt::NoModifier), std::pair(Qt::Key_M, Qt::ShiftModifier),
                                      std::pair(Qt::Key_T, Qt::NoModifier)}) {
        key(Qt::Key_Escape);
        const QImage acquired = pictureOf("axial");
        key(Qt::Key_K);
        ASSERT_TRUE(cleansed());
        ASSERT_TRUE(eventually([&] { return pictureOf("axial") != acquired; }));
        key(which, with);
        EXPECT_FALSE(cleansed());
        EXPECT_NE(warning().find("as acquired"), std::string::npos) << "said: " << warning();
        EXPECT_TRUE(eventually([&] { return pictureOf("axial") == acquired; }));
        key(Qt::Key_K);
        EXPECT_FALSE(cleansed()) << "not while one measures";
    }
}

TEST_F(AsAcquired, AnEndIsDraggedOnSlicesAsAcquired)
{
    const QPoint first = middle("axial") + QPoint(-30, 0), second = middle("axial") + QPoint(30, 0);
    key(Qt::Key_M);
    click("axial", first);
    click("axial", second);
    ASSERT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString();
    screenshot("before_cleansing");
    key(Qt::Key_K);
    ASSERT_TRUE(cleansed());
    waitUntilQuiet();
    drag("axial", second, second + QPoint(20, 0));
    EXPECT_FALSE(cleansed());
    EXPECT_NE(warning().find("as acquired"), std::string::npos) << warning();
}

/// With the other scan beside.
class AsAcquiredBeside : public AsAcquired {
protected:
    void SetUp() override
    {
        AsAcquired::SetUp();
        key(Qt::Key_C);
        ASSERT_TRUE(eventually([] { return drawn("besideAxial") && drawn("besideEndoscopic"); }));
        waitUntilQuiet();
    }
};

TEST_F(AsAcquiredBeside, ClicksFromInsideLandOnTheWallThatIsShownThere)
{
    showAcquired(true);
    EXPECT_NEAR(marked(middle("besideEndoscopic"), "besideEndoscopic"), kPool_mm, kVoxel_mm) << "on the fluid";
    EXPECT_EQ(stored().back().scan_id, test::kProne);
    key(Qt::Key_M);
    click("besideEndoscopic", middle("besideEndoscopic") - QPoint(40, 0));
    click("besideEndoscopic", middle("besideEndoscopic") + QPoint(40, 0));
    ASSERT_TRUE(eventually([&] { return stored()[0].size.has_value() && settled(); })) << said().toStdString();
    EXPECT_NEAR(stationOf(stored()[0].size.value().from_mm), kPool_mm, kVoxel_mm);
    EXPECT_FALSE(stored()[0].size.value().along_mm) << "no way over a surface that is not shown";
    EXPECT_FALSE(stored()[0].size.value().in_slice);
    showAcquired(false);
    EXPECT_GT(marked(middle("besideEndoscopic"), "besideEndoscopic"), kPool_mm + 5) << "on the wall behind it";
}

TEST_F(AsAcquiredBeside, MeasuringShowsBothScansSlicesAsAcquiredAgain)
{
    const QPoint first = middle("besideAxial") + QPoint(-30, 30), second = first + QPoint(60, 0);
    const QImage acquired = pictureOf("axial"), acquired_beside = pictureOf("besideAxial");
    key(Qt::Key_K);
    ASSERT_TRUE(eventually([&] { return pictureOf("besideAxial") != acquired_beside; }));
    key(Qt::Key_M);
    EXPECT_FALSE(cleansed());
    EXPECT_NE(warning().find("as acquired"), std::string::npos) << "said: " << warning();
    EXPECT_TRUE(eventually([&] { return pictureOf("besideAxial") == acquired_beside; }));
    EXPECT_TRUE(eventually([&] { return pictureOf("axial") == acquired; }));
    click("besideAxial", first);
    click("besideAxial", second);
    ASSERT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString();
    key(Qt::Key_K);
    ASSERT_TRUE(cleansed());
    waitUntilQuiet();
    drag("besideAxial", second, second + QPoint(20, 0));
    EXPECT_FALSE(cleansed());
    EXPECT_NE(warning().find("as acquired"), std::string::npos) << warning();
}

}  // namespace
}  // namespace vicon::viewer
