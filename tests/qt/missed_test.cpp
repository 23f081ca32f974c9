// What was missed is gone through by a key, highlighted, ticked off, and the time of reading is kept.
#include <QLabel>
#include <QStatusBar>
#include <QTabWidget>
#include <QTableWidget>

#include "reading.h"
#include "vicon/cases/audit_trail.h"

namespace vicon::viewer {
namespace {

using test::Reading;

/// A reader who has reviewed all of the supine scan but the wall within 12 mm of two places of it.
class Missing : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        test::reviewAllBut(store_, test::kSupine, {120, 240});
        openCase();
        window()->resize(1600, 1000);
        waitUntilQuiet();
    }
    static QTableWidget* list() { return the<QTableWidget>("unseen"); }
    static bool ticked(int row)
    {
        const QTableWidgetItem* item = list()->item(row, 0);
        EXPECT_TRUE(item) << "the list has no row " << row;
        return item && item->text() == QString(QChar(0x2713));
    }
    /// Of the endoscopic picture, as a share.
    static double orange()
    {
        const QImage image = pictureOf("endoscopic");
        int count = 0;
        for (int y = 0; y < image.height(); y += 2)
            for (int x = 0; x < image.width(); x += 2) {
                const QColor c = image.pixelColor(x, y);
                count += c.red() > 90 && c.green() * 10 < c.red() * 7 && c.blue() * 5 < c.red() * 2;
            }
        return double(count) * 4 / (image.width() * image.height());
    }
    /// Of a picture: wall tinted as reviewed, as a share.
    static double green(const char* view)
    {
        const QImage image = pictureOf(view);
        int count = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const QColor c = image.pixelColor(x, y);
                count += c.green() > 50 && c.green() * 10 > c.red() * 12;
            }
        return double(count) / (image.width() * image.height());
    }
    /// Reads on until the reading is worth a line of the audit trail, and closes the case.
    std::string lookedAtInAudit() const
    {
        const auto read_s = [] {
            const QStringList parts = the<QLabel>("readingTime")->text().split(':');
            return parts.size() == 2 ? parts[0].toInt() * 60 + parts[1].toInt() : 0;
        };
        EXPECT_TRUE(eventually([&] {
            QTest::mouseMove(the<QWidget>("endoscopic"), middle("endoscopic"));
            return read_s() >= 6;
        }));
        closeCase();
        CaseStore store(store_);
        for (const AuditLine& line : auditTrail(store, test::kCase))
            if (line.event == "scan read" && line.scan_id == test::kSupine)
                return line.detail.substr(line.detail.rfind("; ") + 2);
        return "no line";
    }
    static QString said() { return window()->statusBar()->currentMessage(); }
};

TEST_F(Missing, RegionsAreListedWithPicturesVisitedByAKeyAndTickedOffWhenReviewed)
{
    ASSERT_TRUE(eventually([] { return list()->rowCount() == 2; })) << list()->rowCount();
    for (const int row : {0, 1}) {
        EXPECT_GE(list()->item(row, 3)->text().toDouble(), 300);
        EXPECT_TRUE(eventually([&] { return !list()->item(row, 0)->icon().isNull(); })) << "its picture";
        EXPECT_FALSE(ticked(row));
    }
    EXPECT_LT(orange(), 0.001);
    key(Qt::Key_F3);
    EXPECT_EQ(the<QTabWidget>("lists")->currentIndex(), 1);
    ASSERT_TRUE(eventually([] { return std::abs(station() - 120) < 45; })) << station();
    EXPECT_TRUE(eventually([] { return orange() > 0.005; })) << "highlighted: " << orange();
    EXPECT_TRUE(said().contains("1 of 2")) << said().toStdString();
    screenshot("missed_region");
    EXPECT_TRUE(eventually([] { return ticked(0); })) << "looked at for long enough";
    EXPECT_FALSE(ticked(1));
    key(Qt::Key_F3);
    ASSERT_TRUE(eventually([] { return std::abs(station() - 240) < 45; })) << station();
    // It lies across a fold: from one side less than four fifths of it are to be seen.
    key(Qt::Key_P);
    for (int n = 0; n < 24 && !ticked(1); ++n) {
        key(n % 12 == 11 ? Qt::Key_R : n % 12 < 3 ? Qt::Key_Comma : Qt::Key_Period);
        EXPECT_TRUE(eventually([] { return pictureIsThere(); }));
        waitUntilQuiet();
    }
    EXPECT_TRUE(ticked(1));
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([] { return orange() < 0.001; })) << orange();
    key(Qt::Key_F3);
    EXPECT_TRUE(eventually([] { return said().contains("No region of 300"); })) << said().toStdString();
    EXPECT_GT(the<QLabel>("seen")->text().section(' ', 0, 0).toDouble(), 95);
    EXPECT_EQ(lookedAtInAudit(), "2 of 2 missed regions looked at") << "kept with time and coverage";
}

TEST_F(Missing, TheListThatIsGoneThroughStaysWhileRegionsAreReviewed)
{
    // The key asks for the list while the one of the opening, and the one of its panel, may still be on their way.
    key(Qt::Key_F3);
    ASSERT_TRUE(eventually([] { return said().contains("1 of 2"); })) << said().toStdString();
    ASSERT_TRUE(eventually([] { return ticked(0); })) << "looked at for long enough";
    waitUntilQuiet();
    EXPECT_EQ(list()->rowCount(), 2);
    EXPECT_TRUE(ticked(0));
    EXPECT_FALSE(ticked(1));
}

TEST_F(Missing, WhatWasLookedAtIsCountedOnceHoweverOftenItIsListed)
{
    ASSERT_TRUE(eventually([] { return list()->rowCount() == 2; })) << list()->rowCount();
    for (const char* which : {"1 of 2", "2 of 2"}) {
        key(Qt::Key_F3);
        ASSERT_TRUE(eventually([&] { return said().contains(which); })) << said().toStdString();
        waitUntilQuiet();
    }
    ASSERT_TRUE(eventually([] { return ticked(0); })) << "looked at for long enough";
    press(window(), "listUnseen");
    waitUntilQuiet();
    ASSERT_LT(list()->rowCount(), 2) << "the first one is reviewed by now";
    EXPECT_EQ(lookedAtInAudit(), "2 of 2 missed regions looked at");
}

TEST_F(Missing, TheNextOneThatIsAskedForInOneScanIsNotSoughtInTheOther)
{
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic"); }));
    waitUntilQuiet();
    QStringList all;
    const QObject listener;
    QObject::connect(window()->statusBar(), &QStatusBar::messageChanged, &listener,
                     [&](const QString& words) { all << words; });
    key(Qt::Key_F3);
    key(Qt::Key_X);  // the other scan is read at once; the list of the first one was on its way
    waitForScan();
    EXPECT_TRUE(all.filter("is missed").empty()) << all.join("; ").toStdString();
    EXPECT_TRUE(all.filter("Missed region").empty()) << all.join("; ").toStdString();
}

TEST_F(Missing, TheProjectionIsPaintedFromTheFrontAndWhatIsForgottenIsNot)
{
    EXPECT_GT(green("overview"), 0.03);
    screenshot("reviewed_projection");
    showList(1);
    press(window(), "forgetSeen");
    EXPECT_TRUE(eventually([] { return green("overview") < 0.015; })) << green("overview") << ": what is in view now";
}

TEST_F(Missing, AThumbnailIsNoLookAtARegion)
{
    ASSERT_TRUE(eventually([] { return list()->rowCount() == 2 && !list()->item(1, 0)->icon().isNull(); }));
    const double before = the<QLabel>("seen")->text().section(' ', 0, 0).toDouble();
    key(Qt::Key_Period);
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
    waitUntilQuiet();
    EXPECT_FALSE(ticked(0));
    EXPECT_FALSE(ticked(1));
    EXPECT_NEAR(the<QLabel>("seen")->text().section(' ', 0, 0).toDouble(), before, 0.2);
}

}  // namespace
}  // namespace vicon::viewer
