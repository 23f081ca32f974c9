// Earlier reports beside the case: listed, on the map and in slices, compared; the earlier images at the same place.
#include <gmock/gmock.h>
#include <soci/soci.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QStatusBar>
#include <QTableWidget>

#include "reading.h"
#include "test_colon.h"
#include "vicon/cases/comparisons.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/step_results.h"
#include "vicon/viewer/model/prior_place.h"

namespace vicon::viewer {
namespace {

using test::Reading;
using test::type;

constexpr const char* kEarlierCase = "c0";
constexpr int kPriorList = 3;

class Priors : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        CaseStore store(store_);
        recordColon(store);
        addEarlierImages(store);
        list_.reports = {report()};
    }
    /// The room, with these earlier reports.
    void open()
    {
        room_.reset();
        services_.priors.list = [this](CaseStore&, const std::string&) { return list_; };
        openRoom(services_);
        openCase();
        showList(kPriorList);
        ASSERT_TRUE(
            eventually([&] { return table()->rowCount() == int(list_.reports.size()) || list_.reports.empty(); }));
    }
    /// What the pipeline would have recorded: one part, the whole colon.
    void recordColon(CaseStore& store) const
    {
        const double length = length_mm_;
        const std::string skeleton = toJson(SkeletonFound{.length_mm = length}).dump(),
                          quality = toJson(QualityFound{.parts = {{ColonPart::transverse, 0, length}}}).dump();
        store.database().write([&](soci::session& sql) {
            for (const auto& [step, result] : {std::pair{std::string("skeleton"), &skeleton}, {"quality", &quality}})
                sql << "INSERT INTO steps (case_id, scan_id, step, version, digest, parameters, result, seconds,"
                       " finished) VALUES ('c1', 's1', :step, 1, 'd', '{}', :result, 1, '')",
                    soci::use(step), soci::use(*result);
        });
    }
    void addEarlierImages(CaseStore& store) const
    {
        CaseRecord earlier = store.requireCase(test::kCase);
        earlier.id = kEarlierCase;
        earlier.study.uid = "1.2.1";
        earlier.study.date = "20210315";
        ScanRecord scan{.id = "s9", .case_id = kEarlierCase};
        scan.series.patient_position = "HFS";
        std::filesystem::create_directories(store.scanFolder(kEarlierCase, "s9"));
        store.addScan(earlier, scan, {}, false);
        test::TestColon().write(store.scanFolder(kEarlierCase, "s9"));
    }
    static PriorReport report()
    {
        PriorReport r{.sop_uid = "1.9", .sop_class = "1.2", .series_uid = "1.8", .maker = "VICON"};
        r.study.uid = "1.2.1";
        r.study.date = "20210315";
        PriorFinding f{.uid = "p1", .name = "Finding 1", .kind = FindingKind::polyp, .size_mm = 6.1};
        f.sights.push_back({.part = ColonPart::transverse, .part_fraction = 0.5});
        r.findings = {f};
        return r;
    }
    static QTableWidget* table() { return the<QTableWidget>("priors"); }
    std::vector<Comparison> said() const
    {
        CaseStore store(store_);
        return comparisons(store, test::kCase);
    }
    static Finding findingOf(CaseStore& store, const std::string& id)
    {
        for (const Finding& one : findings(store, test::kCase))
            if (one.id == id)
                return one;
        throw std::runtime_error("no finding " + id);
    }
    /// Pixels of a view that are of the colour of earlier findings.
    static int violet(const char* view)
    {
        const QImage picture = pictureOf(view);
        int count = 0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                count += picture.pixelColor(x, y) == QColor(kPriorColor.red, kPriorColor.green, kPriorColor.blue);
        return count;
    }

    const double length_mm_ = test::TestColon().skeleton.length_mm();
    PriorList list_;
};

TEST_F(Priors, AreListedShownInTheirPlaceAndFlownTo)
{
    ASSERT_NO_FATAL_FAILURE(open());
    EXPECT_EQ(table()->item(0, 0)->text(), "2021-03-15");
    EXPECT_EQ(table()->item(0, 1)->text(), "polyp");
    EXPECT_EQ(table()->item(0, 4)->text(), "none near");
    ASSERT_TRUE(eventually([] { return violet("overview") > 20; }));
    clickRow(table(), 0);
    ASSERT_TRUE(eventually([&] { return std::abs(station() - length_mm_ / 2) < 5; })) << station();
    ASSERT_TRUE(eventually([] { return violet("axial") > 5; })) << "a diamond in the slice";
    EXPECT_TRUE(eventually([] { return violet("endoscopic") > 5; })) << "a ring where its stretch ends";
    screenshot("priors");
}

TEST_F(Priors, AreConfirmedRejectedAndTakenBack)
{
    {
        CaseStore store(store_);
        Marker marker{.scan_id = test::kSupine};
        marker.station_mm = length_mm_ / 2;
        marker.position_mm = test::TestColon().skeleton.at(marker.station_mm).position_mm;
        marker.part = ColonPart::transverse;
        store.saveMarker(test::kCase, marker);
        editFindings(store, test::kCase, {{std::nullopt, Finding{.markers = {"m1"}, .read_size_mm = 8}}});
    }
    ASSERT_NO_FATAL_FAILURE(open());
    ASSERT_TRUE(eventually([] { return table()->item(0, 4)->text() == "f1?"; }))
        << table()->item(0, 4)->text().toStdString();
    EXPECT_FALSE(the<QPushButton>("priorConfirm")->isEnabled()) << "nothing is chosen yet";
    clickRow(table(), 0);
    press(window(), "priorConfirm");
    ASSERT_TRUE(eventually([] { return table()->item(0, 4)->text() == "f1, confirmed"; })) << warning();
    ASSERT_EQ(said().size(), 1u);
    EXPECT_EQ(said()[0].prior_uid, "p1");
    EXPECT_THAT(the<QLabel>("priorWords")->text().toStdString(), testing::HasSubstr("growth is not told"));
    screenshot("priors-confirmed");
    press(window(), "priorReject");
    ASSERT_TRUE(eventually([] { return table()->item(0, 4)->text() == "not f1"; })) << warning();
    press(window(), "priorTakeBack");
    ASSERT_TRUE(eventually([] { return table()->item(0, 4)->text() == "f1?"; })) << warning();
    EXPECT_TRUE(said().empty());
}

TEST_F(Priors, OfWhichTheChosenOneIsConfirmedForTheChosenFindingWhateverOthersChangeMeanwhile)
{
    PriorReport older = list_.reports[0];
    older.sop_uid = "1.7";
    older.study.date = "20190310";
    list_.reports.push_back(older);
    {
        CaseStore store(store_);
        for (const double off_mm : {0.0, 6.0}) {
            Marker marker{.scan_id = test::kSupine, .part = ColonPart::transverse};
            marker.station_mm = length_mm_ / 2 + off_mm;
            marker.position_mm = test::TestColon().skeleton.at(marker.station_mm).position_mm;
            store.saveMarker(test::kCase, marker);
        }
        editFindings(store, test::kCase,
                     {{std::nullopt, Finding{.markers = {"m1"}, .read_size_mm = 8}},
                      {std::nullopt, Finding{.markers = {"m2"}, .read_size_mm = 9}}});
    }
    ASSERT_NO_FATAL_FAILURE(open());
    clickRow(table(), 1);
    auto* today = the<QComboBox>("priorToday");
    const auto chosen = [&] { return today->currentText().toStdString(); };
    ASSERT_EQ(chosen(), "Finding f1");
    today->setFocus();
    type(Qt::Key_Down);
    ASSERT_EQ(chosen(), "Finding f2");
    // Another reader's marker, and another report that was found: all is listed anew.
    PriorReport newest = list_.reports[0];
    newest.sop_uid = "1.6";
    newest.study.date = "20230310";
    list_.reports.insert(list_.reports.begin(), newest);
    const Marker other{.scan_id = test::kSupine, .position_mm = test::TestColon().skeleton.at(20).position_mm};
    CaseStore(store_).saveMarker(test::kCase, other);
    ASSERT_TRUE(eventually([] { return table()->rowCount() == 3; })) << table()->rowCount();
    EXPECT_EQ(chosen(), "Finding f2");
    screenshot("priors-kept");
    press(window(), "priorConfirm");
    ASSERT_TRUE(eventually([&] { return said().size() == 1; })) << warning();
    EXPECT_EQ(said()[0].finding_id, "f2");
    EXPECT_EQ(said()[0].report_uid, "1.7");
    // The chosen finding is gone: no other one is taken for it.
    clickRow(table(), 0);
    today->setFocus();
    type(Qt::Key_Down);
    ASSERT_EQ(chosen(), "Finding f2");
    {
        CaseStore store(store_);
        editFindings(store, test::kCase, {{findingOf(store, "f2"), std::nullopt}});
        store.removeMarker(test::kCase, "m2");
    }
    ASSERT_TRUE(eventually([&] { return today->count() == 1; })) << today->count();
    EXPECT_EQ(chosen(), "");
    EXPECT_FALSE(the<QPushButton>("priorConfirm")->isEnabled());
    today->setFocus();
    type(Qt::Key_Down);
    EXPECT_TRUE(the<QPushButton>("priorConfirm")->isEnabled()) << chosen();
}

TEST_F(Priors, ShowTheEarlierImagesAtTheSamePlaceWithoutAMarker)
{
    ASSERT_NO_FATAL_FAILURE(open());
    the<QWidget>("endoscopic")->setFocus();
    key(Qt::Key_C, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return the<QWidget>("beside")->isVisible() && drawn("besideEndoscopic"); }))
        << warning();
    screenshot("prior-same-place");
    const auto before = stored();
    click("besideEndoscopic", middle("besideEndoscopic"), Qt::ShiftModifier);
    click("besideAxial", middle("besideAxial"), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return settled(); }));
    EXPECT_EQ(stored().size(), before.size()) << "an earlier examination is not marked";
    const auto words = [] { return window()->statusBar()->currentMessage(); };
    key(Qt::Key_M);
    click("besideAxial", middle("besideAxial"));
    click("besideAxial", middle("besideAxial") + QPoint(40, 20));
    EXPECT_TRUE(eventually([&] { return words().contains("straight") && words().contains("not kept"); }))
        << words().toStdString() << warning();
    screenshot("prior-measured");
    EXPECT_EQ(stored().size(), before.size());
    key(Qt::Key_C, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return !the<QWidget>("beside")->isVisible(); }));
}

TEST_F(Priors, SayWhatIsMissing)
{
    list_ = {};
    list_.left_out = {"report 1.9 has this patient ID, but another name or birth date"};
    ASSERT_NO_FATAL_FAILURE(open());
    ASSERT_TRUE(eventually([] { return the<QLabel>("priorWords")->text().contains("another name"); }));
    EXPECT_THAT(the<QLabel>("priorWords")->text().toStdString(), testing::HasSubstr("No earlier report"));
    the<QWidget>("endoscopic")->setFocus();
    key(Qt::Key_C, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return warning().find("no earlier report") != std::string::npos; }));
}

}  // namespace
}  // namespace vicon::viewer
