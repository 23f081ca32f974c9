#include <soci/soci.h>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QToolButton>

#include <atomic>

#include "reading.h"

namespace vicon::viewer {
namespace {

using test::Reading;

/// The services of a store whose worklist is changed by `change(case's row, scan)` before it is shown.
template <class Change>
ReadingServices withScans(ReadingServices services, Change change)
{
    services.worklist = [change, before = services.worklist](CaseStore& store, const WorklistPageWanted& wanted) {
        WorklistPage page = before(store, wanted);
        for (WorklistCase& row : page.cases)
            for (WorklistScan& scan : row.scans)
                change(row, scan);
        return page;
    };
    return services;
}

TEST_F(Reading, WorklistSearchesFiltersAndRetriesAFailedCase)
{
    const auto shown = [&](int count) { return eventually([&] { return cases()->rowCount() == count; }); };
    auto* search = room_->findChild<QLineEdit*>("search");
    const auto reason = [&] { return room_->findChild<QLabel*>("reason")->text(); };
    QTest::keyClicks(search, "bert");
    EXPECT_TRUE(shown(1));
    const auto says_why = [&] { return reason() == "supine: the series has a gap of 40 mm"; };
    EXPECT_TRUE(eventually(says_why)) << "what was found is chosen";
    search->clear();
    QTest::keyClicks(search, "anna");
    QTest::keyClick(search, Qt::Key_Return);  // at once: what was chosen before is not opened
    ASSERT_TRUE(eventually([] { return window() != nullptr; }));
    EXPECT_TRUE(window()->windowTitle().contains("Anna")) << window()->windowTitle().toStdString();
    closeCase();
    search->clear();
    auto* state = room_->findChild<QComboBox*>("state");
    state->setCurrentIndex(state->findText("failed"));
    ASSERT_TRUE(shown(1));
    clickRow(cases(), 0);
    EXPECT_TRUE(eventually(says_why));
    EXPECT_FALSE(room_->findChild<QPushButton*>("open")->isEnabled());
    screenshot("worklist");
    press(room_.get(), "retry");
    EXPECT_TRUE(shown(0)) << "it is no longer failed";
    state->setCurrentIndex(state->findText("done"));
    ASSERT_TRUE(eventually([&] { return shown(1) && cases()->item(0, 6)->text() == "not adequate: prone"; }));
    EXPECT_GT(cases()->columnWidth(6), cases()->fontMetrics().horizontalAdvance("poor: prone"));
    EXPECT_TRUE(cases()->item(0, 6)->toolTip().contains("collapsed over 38 mm"));
    state->setCurrentIndex(state->findText("queued"));
    EXPECT_TRUE(eventually([&] { return shown(1) && cases()->item(0, 4)->text() == "queued"; }));
}

TEST_F(Reading, TheWorklistOpensAsLargeAsItWasLeft)
{
    const QSize left(820, 460);
    room_->resize(left);
    waitUntilQuiet();
    room_->close();
    openRoom(services_);
    EXPECT_EQ(room_->size(), left);
}

TEST_F(Reading, ALongWorklistIsTurnedPageByPageAndACaseBesideThePageIsOpenedAndKeptUpToDate)
{
    constexpr int kMore = 250, kPage = 100;
    {
        CaseStore store(store_);
        store.database().write([](soci::session& sql) {
            for (int n = 0; n < kMore; ++n) {
                const std::string id = "m" + std::to_string(1000 + n), uid = "1.2." + id;  // bound: they must live on
                sql << "INSERT INTO cases (id, study_uid, patient_id, patient_name, birth_date, sex, study, flags,"
                       " created) VALUES (:id, :uid, :patient, 'Many', '', 'F', '{}', '[]', '2099-01-01')",
                    soci::use(id), soci::use(uid), soci::use(id);
            }
        });
    }
    std::atomic<bool> ready = false;
    auto services = test::servicesFor(store_);
    services.worklist_case = [&, list = services.worklist](CaseStore& store, const std::string& id) {
        WorklistCase row = list(store, {.words = id}).cases.at(0);
        for (WorklistScan& scan : row.scans)
            scan.state = ready ? WorkState::done : WorkState::running;
        return std::optional(row);
    };
    room_.reset();
    openRoom(services, test::kCase);
    const auto shows = [&](const char* newest, int count) {
        return eventually([&] { return cases()->rowCount() == count && cases()->item(0, 1)->text() == newest; });
    };
    ASSERT_TRUE(shows("m1249", kPage));
    ASSERT_TRUE(eventually([] { return window() != nullptr; })) << "it is the oldest";
    EXPECT_FALSE(warning().empty());
    ready = true;
    waitForScan();
    closeCase();
    const auto* place = room_->findChild<QLabel*>("page");
    EXPECT_FALSE(room_->findChild<QPushButton*>("newer")->isEnabled());
    press(room_.get(), "older");
    ASSERT_TRUE(shows("m1149", kPage));
    EXPECT_EQ(place->text(), "101 to 200");
    press(room_.get(), "older");
    ASSERT_TRUE(shows("m1049", kMore + 2 - 2 * kPage));
    EXPECT_FALSE(room_->findChild<QPushButton*>("older")->isEnabled());
    press(room_.get(), "newer");
    ASSERT_TRUE(shows("m1149", kPage));
    QTest::keyClicks(room_->findChild<QLineEdit*>("search"), "anna");
    ASSERT_TRUE(eventually([&] { return cases()->rowCount() == 1; })) << "searched in all of it";
    EXPECT_FALSE(place->isVisible());
    room_.reset();  // before what its services refer to
}

TEST_F(Reading, AScanThatItsCorrectionsSpoiledIsRetriedWithoutThem)
{
    std::atomic<bool> retried = false;
    auto services = withScans(test::servicesFor(store_), [&](const WorklistCase& row, WorklistScan& scan) {
        if (row.record.id == test::kCase && !retried) {
            scan.reason = "no colon: the longest run of gas is 61 mm long";
            scan.corrected = scan.record.id == test::kProne;
        }
    });
    services.retry = [&](CaseStore&, const std::string&) { retried = true; };
    room_.reset();
    openRoom(services);
    QTest::keyClicks(room_->findChild<QLineEdit*>("search"), "anna");
    ASSERT_TRUE(eventually([&] { return cases()->rowCount() == 1; }));
    EXPECT_FALSE(room_->findChild<QPushButton*>("open")->isEnabled());
    const QStringList reasons = room_->findChild<QLabel*>("reason")->text().split('\n');
    ASSERT_EQ(reasons.size(), 2);
    EXPECT_FALSE(reasons[0].contains("Retry"));
    EXPECT_TRUE(reasons[1].contains("61 mm long (corrected; Retry forgets its corrections)"));
    press(room_.get(), "retry");
    EXPECT_TRUE(eventually([&] { return room_->findChild<QPushButton*>("open")->isEnabled(); }));
    EXPECT_FALSE(room_->findChild<QPushButton*>("retry")->isEnabled());
    room_.reset();  // before what its services refer to
}

TEST_F(Reading, AWorklistThatIsStillTheSameIsNotReadAgain)
{
    std::atomic<int> asked = 0, read = 0, version = 0;
    auto services = withScans(test::servicesFor(store_), [&](const WorklistCase& row, WorklistScan& scan) {
        if (row.record.id == test::kFailedCase)
            scan.organ = version == 0 ? Organ() : Organ("aorta");
    });
    services.worklist = [&, before = services.worklist](CaseStore& store, const WorklistPageWanted& wanted) {
        ++read;
        return before(store, wanted);
    };
    services.worklist_version = [&](CaseStore&) {
        ++asked;
        return std::to_string(version);
    };
    const auto room = makeReadingRoom(services, {});
    auto* table = room->findChild<QTableWidget*>("cases");
    ASSERT_TRUE(eventually([&] { return asked >= 3; }));
    EXPECT_EQ(read, 1);
    const auto scans = [&] { return table->item(0, 3)->text() + "; " + table->item(1, 3)->text(); };
    EXPECT_FALSE(scans().contains("(")) << scans().toStdString();
    version = 1;
    EXPECT_TRUE(eventually([&] { return scans().contains("supine (aorta)"); })) << scans().toStdString();
    EXPECT_EQ(read, 2);
}

TEST_F(Reading, AnEmptyWorklistSaysWhatToDoAndOneInWhichNothingIsFoundToo)
{
    auto empty = services_;
    empty.worklist = [](CaseStore&, const WorklistPageWanted&) { return WorklistPage(); };
    empty.receiver = "VICON (reading-host, port 11112)";
    const auto room = makeReadingRoom(empty, {});
    room->show();
    auto* said = room->findChild<QLabel*>("hint");
    ASSERT_TRUE(eventually([&] { return said->text().contains("vicon import"); }));
    EXPECT_TRUE(said->isVisible());
    for (const std::string& part : {store_.string(), empty.receiver, std::string("vicon receive")})
        EXPECT_TRUE(said->text().contains(part.c_str())) << part;
    room->grab().save(VICON_SCREENSHOTS "/worklist_empty.png");

    auto* hint = room_->findChild<QLabel*>("hint");
    auto* search = room_->findChild<QLineEdit*>("search");
    EXPECT_FALSE(hint->isVisible());
    QTest::keyClicks(search, "nobody");
    EXPECT_TRUE(eventually([&] { return hint->isVisible(); }));
    EXPECT_TRUE(hint->text().contains("No case is found by \"nobody\".")) << hint->text().toStdString();
    screenshot("worklist_nothing_found");
    search->clear();
    EXPECT_TRUE(eventually([&] { return !hint->isVisible(); }));
    const QToolButton* cross = search->findChild<QToolButton*>();  // which clears it: while it fades out it is not gone
    EXPECT_TRUE(eventually([&] { return cross->property("opacity").toDouble() == 0; }));
}

TEST_F(Reading, AScanThatBecomesReadyWhileItsCaseIsReadIsOffered)
{
    std::atomic<bool> ready = false;
    const auto services = withScans(test::servicesFor(store_), [&ready](const WorklistCase&, WorklistScan& scan) {
        if (scan.record.id == test::kProne && !ready)
            scan.state = WorkState::running;
    });
    room_.reset();
    openRoom(services);
    openCase();
    auto* scans = the<QComboBox>("scan");
    ASSERT_EQ(scans->count(), 1);
    key(Qt::Key_X);
    EXPECT_EQ(warning(), "This case has no other scan that can be read.");
    ready = true;
    ASSERT_TRUE(eventually([&] { return scans->count() == 2; }));
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForScan();
    EXPECT_TRUE(scans->currentText().startsWith("prone"));
    room_.reset();  // before what its services refer to
}

TEST_F(Reading, ACaseOpenedTooEarlyIsReadAsSoonAsItCanBe)
{
    std::atomic<bool> ready = false;
    const auto services = withScans(test::servicesFor(store_), [&ready](const WorklistCase& row, WorklistScan& scan) {
        scan.state = ready && row.record.id == test::kCase ? WorkState::done : WorkState::running;
    });
    room_.reset();
    openRoom(services, test::kCase);
    ASSERT_TRUE(eventually([] { return window() != nullptr; }));
    EXPECT_FALSE(warning().empty());
    ready = true;
    waitForScan();
    EXPECT_EQ(warning(), "");
    room_.reset();
}

TEST_F(Reading, OpeningCanBeCancelledAndTheScanThatIsOpenStays)
{
    startOpening();
    ASSERT_TRUE(eventually([] { return the<QWidget>("opening")->isVisible(); }));
    press(window(), "openingCancel");
    EXPECT_TRUE(eventually([] { return window() == nullptr; })) << "nothing was open in it";
    openCase();
    EXPECT_FALSE(the<QWidget>("opening")->isVisible());
    auto* scan = the<QComboBox>("scan");
    const QString open = scan->currentText();
    scan->setFocus();
    QTest::keyClick(scan, Qt::Key_Down);
    ASSERT_TRUE(the<QWidget>("opening")->isVisible());
    press(window(), "openingCancel");
    EXPECT_EQ(scan->currentText(), open);
    waitUntilQuiet();
    EXPECT_EQ(scan->currentText(), open) << "what was read meanwhile is not shown";
    key(Qt::Key_End);
    EXPECT_TRUE(eventually([] { return length() - station() < 2; }));
}

}  // namespace
}  // namespace vicon::viewer
