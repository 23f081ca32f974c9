#include "study_walk.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QSettings>
#include <QSlider>
#include <QTableWidget>
#include <set>

#include "command.h"
#include "reading_services.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::viewer::test {

fs::path preparedStore(const std::string& name, const fs::path& source, const fs::path& copy)
{
    static std::set<std::string> up_to_date;
    const fs::path kept = fs::path(VICON_READING_STORES) / name;
    fs::create_directories(kept);
    if (up_to_date.insert(name).second)
        for (const std::string& arguments : {"import " + source.string(), std::string("work --until-idle")}) {
            const auto result = support::runVicon(arguments + " --store " + kept.string());
            EXPECT_EQ(result.exit_code, 0) << "vicon " << arguments << "\n" << result.output;
        }
    fs::copy(kept, copy, fs::copy_options::recursive);
    return copy;
}

fs::path phantomStudy()
{
    const fs::path study = fs::path(VICON_READING_STORES) / "phantom-study";
    const fs::path whole = fs::path(VICON_READING_STORES) / "phantom-study-is-whole";
    if (!fs::exists(whole)) {
        fs::create_directories(study.parent_path());
        const auto made = support::runVicon("phantom " + study.string() + " --size 256x256x220");
        EXPECT_EQ(made.exit_code, 0) << made.output;
        replaceFile(whole, "");
    }
    return study;
}

void StudyReader::openStore(const fs::path& store, const std::string& name, const fs::path& config)
{
    store_ = store;
    name_ = name;
    CaseStore opened(store);
    const CaseRecord record = opened.cases().at(0);
    case_id_ = record.id;
    patient_id_ = record.patient.id;
    case_folder_ = opened.caseFolder(case_id_);
    for (const Marker& marker : opened.markers(case_id_))  // of somebody who looked at the kept store
        opened.removeMarker(case_id_, marker.id);
    config_ = app::declaredConfig();
    std::string account = support::runCommand("id -un").output;
    account.erase(account.find_last_not_of('\n') + 1);
    config_->set("roles.sign=[\"" + account + "\"]");
    if (!config.empty())
        config_->readFile(config);
    openRoom(app::readingServices(store_, *config_));
}

void StudyReader::fastest() const
{
    auto* speed = the<QSlider>("speed");
    while (speed->value() < speed->maximum())
        key(Qt::Key_Plus);
}

void StudyReader::jumpTo(double station_mm) const
{
    auto* spin = the<QDoubleSpinBox>("station");
    spin->setFocus();
    spin->selectAll();
    QTest::keyClicks(spin, QString::number(station_mm, 'f', 0));
    press(window(), "jump");
    ASSERT_TRUE(eventually([&] { return std::abs(station() - station_mm) < 2; })) << station();
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
}

void StudyReader::flyThereAndBack() const
{
    constexpr int kFlight_ms = 600000;  // a metre at a tenth of a metre a second, on a machine that is very busy
    key(Qt::Key_Home);
    ASSERT_TRUE(eventually([] { return station() < 2; }));
    fastest();
    const double way = length();
    press(window(), "forward");
    double most_ahead_mm = 0;
    const auto flown = [&](auto reached) {
        return QTest::qWaitFor(
            [&] {
                most_ahead_mm = std::max(most_ahead_mm, std::abs(station() - pictureStation()));
                return reached();
            },
            kFlight_ms);
    };
    ASSERT_TRUE(flown([&] { return station() > way / 2; }));
    screenshotNow("on-the-way");
    ASSERT_TRUE(flown([&] { return way - station() < 2; }));
    key(Qt::Key_End);  // turned about, ready for the way back
    screenshot("caecum");
    press(window(), "forward");
    ASSERT_TRUE(flown([&] { return station() < way / 2; }));
    screenshotNow("on-the-way-back");
    ASSERT_TRUE(flown([&] { return station() < 2; }));
    screenshot("rectum");
    // A flight waits for its pictures: no wall passes unshown, however busy the machine is.
    EXPECT_LT(most_ahead_mm, 60);
}

void StudyReader::place(int color_key, QPoint by) const
{
    const int before = markers()->rowCount();
    key(color_key);
    click("endoscopic", middle("endoscopic") + by);
    ASSERT_TRUE(eventually([&] { return markers()->rowCount() == before + 1 && settled(); })) << warning();
}

void StudyReader::writeNote(int row, const QString& note) const
{
    constexpr int kNote = 6;
    clickRow(markers(), row, kNote);
    const auto* item = markers()->item(row, kNote);
    QTest::mouseDClick(markers()->viewport(), Qt::LeftButton, {}, markers()->visualItemRect(item).center());
    auto* editor = markers()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    QTest::keyClicks(editor, note);
    QTest::keyClick(editor, Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return cell(row, kNote) == note && settled(); }));
}

std::vector<std::string> StudyReader::filesIn(const fs::path& folder)
{
    std::error_code none;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder, none))
        names.push_back(entry.path().filename().string());
    return names;
}

void StudyWalk::markAndEdit()
{
    jumpTo(length() * 0.6);
    place(Qt::Key_1, {140, 60});
    writeNote(0, "sessile, on a fold");
    auto* color = the<QComboBox>("markerColor");
    color->setFocus();
    QTest::keyClick(color, Qt::Key_Down);
    const auto colored = [&](MarkerColor which) { return stored(case_id_.c_str())[0].color == which && settled(); };
    ASSERT_TRUE(eventually([&] { return colored(MarkerColor::yellow); }));
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return colored(MarkerColor::red); }));
    press(window(), "redo");
    ASSERT_TRUE(eventually([&] { return colored(MarkerColor::yellow); }));
    screenshot("marked");
    jumpTo(length() * 0.3);
    place(Qt::Key_3, {-60, 40});
    clickRow(markers(), 1);
    press(window(), "markerRemove");
    ASSERT_TRUE(eventually([&] { return stored(case_id_.c_str()).size() == 1 && settled(); }));
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return stored(case_id_.c_str()).size() == 2 && settled(); }));
    // From afar back to the view that was saved with it.
    key(Qt::Key_Home);
    ASSERT_TRUE(eventually([] { return station() < 2; }));
    clickRow(markers(), 0);
    ASSERT_TRUE(eventually([] { return std::abs(station() - length() * 0.6) < 2 && pictureIsThere(); })) << station();
    screenshot("back-at-the-marker");
}

void StudyWalk::measure()
{
    const QPoint first = middle("endoscopic") + QPoint(140, 60);
    key(Qt::Key_M);
    click("endoscopic", first);
    click("endoscopic", first + QPoint(24, 24));
    ASSERT_TRUE(eventually([&] { return stored(case_id_.c_str())[0].size.has_value() && settled(); })) << warning();
    EXPECT_GT(stored(case_id_.c_str())[0].size->straight_mm, 0.5);
    screenshot("measured");
    key(Qt::Key_Escape);
}

void StudyWalk::lookBelowTheWall()
{
    waitUntilQuiet();
    const QImage plain = pictureOf("endoscopic");
    auto* peel = the<QComboBox>("peel");
    peel->setFocus();
    QTest::keyClick(peel, Qt::Key_Down);
    ASSERT_TRUE(eventually([&] { return pictureOf("endoscopic") != plain; }));
    screenshot("peeled");
    peel->setFocus();
    QTest::keyClick(peel, Qt::Key_Up);
    key(Qt::Key_Escape);
}

void StudyWalk::circleAndTakeDensity()
{
    auto* view = the<QWidget>("endoscopic");
    const auto taken = [&] { return stored(case_id_.c_str())[0].density.has_value() && settled(); };
    // Where the wall is thin there is too little tissue behind it, and a reader circles another patch.
    for (const QPoint beside : {QPoint(140, 60), QPoint(-180, 60), QPoint(140, -120), QPoint(-180, -120)}) {
        const QPoint at = middle("endoscopic") + beside;
        key(Qt::Key_Escape);
        key(Qt::Key_T);
        QTest::mousePress(view, Qt::LeftButton, {}, at);
        for (int n = 1; n <= 5; ++n)
            QTest::mouseMove(view, at + QPoint(16 * n, 0));
        QTest::mouseRelease(view, Qt::LeftButton, {}, at + QPoint(80, 0));
        ASSERT_TRUE(eventually([&] { return taken() || !warning().empty(); }));
        if (taken())
            break;
    }
    ASSERT_TRUE(taken()) << warning();
    screenshot("biopsy");
    key(Qt::Key_Escape);
}

void StudyWalk::keepPictureAndMarkers()
{
    key(Qt::Key_S, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return filesIn(case_folder_ / "pictures").size() == 1; })) << warning();
    const fs::path file = store_ / "list.json";
    key(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
    chooseFile("saveMarkers", file.c_str());
    ASSERT_TRUE(eventually([&] { return fs::exists(file); }));
    EXPECT_EQ(nlohmann::json::parse(readFile(file))["markers"].size(), 2U);
}

void StudyWalk::writeReport()
{
    const std::size_t before = filesIn(case_folder_ / "report").size();  // somebody may have read it in the kept store
    key(Qt::Key_P, Qt::ControlModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return filesIn(case_folder_ / "report").size() > before; }, 3 * patience_ms))
        << warning();
    screenshot("reported");
    EXPECT_EQ(warning(), "");
}

namespace {

bool formIsReady()
{
    for (QWidget* widget : QApplication::topLevelWidgets())
        if (auto* button = widget->findChild<QPushButton*>("reportPreview"))
            return button->isEnabled();
    return false;
}

/// What stands before the window.
template <class Dialog>
Dialog* shownDialog(const char* name)
{
    for (QWidget* widget : QApplication::topLevelWidgets())
        if (widget->objectName() == name && widget->isVisible())
            return qobject_cast<Dialog*>(widget);
    return nullptr;
}

}  // namespace

void StudyWalk::sayRead(int finding, const QString& size_mm) const
{
    clickRow(the<QTableWidget>("findings"), finding);
    ASSERT_TRUE(eventually([] { return the<QLabel>("findingPicture")->isVisible(); }));
    auto* size = the<QDoubleSpinBox>("findingSize");
    size->setFocus();
    size->selectAll();
    QTest::keyClicks(size, size_mm);
    QTest::keyClick(size, Qt::Key_Tab);
    ASSERT_TRUE(eventually([&] {
        return the<QTableWidget>("findings")->item(finding, 3)->text().toDouble() == size_mm.toDouble() &&
               formIsReady();
    })) << warning();
}

void StudyWalk::signIt() const
{
    press(window(), "reportSign");
    ASSERT_TRUE(eventually([] { return shownDialog<QMessageBox>("confirmSigning") != nullptr; }));
    QTest::keyClick(shownDialog<QMessageBox>("confirmSigning"), Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return the<QPushButton>("reportAmend")->isVisible() && formIsReady(); })) << warning();
    EXPECT_TRUE(the<QLabel>("reportState")->text().contains(QRegularExpression("signed|amended")));
    window()->activateWindow();
}

void StudyWalk::signReport(int findings)
{
    key(Qt::Key_R, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return the<QPushButton>("findingAdd")->isEnabled() && formIsReady(); })) << warning();
    press(window(), "findingAdd");
    ASSERT_TRUE(eventually([&] { return the<QTableWidget>("findings")->rowCount() == findings && formIsReady(); }))
        << warning();
    for (int finding = 0; finding < findings; ++finding)
        ASSERT_NO_FATAL_FAILURE(sayRead(finding, "8"));
    ASSERT_TRUE(eventually([&] { return the<QLabel>("colonCategoryReason")->text().contains("C2a"); }))
        << the<QLabel>("colonCategoryReason")->text().toStdString();
    press(window(), "reportAccept");
    ASSERT_TRUE(eventually([] { return the<QPushButton>("reportSign")->isEnabled(); }))
        << the<QLabel>("reportMissing")->text().toStdString();
    screenshot("form");
    press(window(), "reportPreview");
    ASSERT_TRUE(eventually([&] { return shownDialog<QWidget>("reportPreview") != nullptr; })) << warning();
    auto* pages = shownDialog<QWidget>("reportPreview");
    ASSERT_TRUE(eventually([&] { return pagesAreDrawn(pages); }));
    pages->grab().save(QString(VICON_SCREENSHOTS "/%1-preview.png").arg(QString::fromStdString(name_)));
    QTest::keyClick(pages, Qt::Key_Escape);
    window()->activateWindow();
    ASSERT_TRUE(eventually(formIsReady));
    ASSERT_NO_FATAL_FAILURE(signIt());
    screenshot("signed");
    EXPECT_EQ(warning(), "");
}

void StudyWalk::awaitArchive(int objects) const
{
    const auto committed = [] {
        const QString state = the<QLabel>("reportState")->text();
        const auto found = QRegularExpression("PACS: (\\d+) committed$").match(state);
        return found.hasMatch() ? found.captured(1).toInt() : 0;
    };
    ASSERT_TRUE(eventually([&] { return committed() >= objects; })) << the<QLabel>("reportState")->text().toStdString();
    screenshot("committed");
}

void StudyWalk::amendReport()
{
    press(window(), "reportAmend");
    ASSERT_TRUE(eventually([] { return shownDialog<QInputDialog>("whyAmend") != nullptr; }));
    auto* why = shownDialog<QInputDialog>("whyAmend");
    QTest::keyClicks(why->findChild<QLineEdit*>(), "measured again");
    QTest::keyClick(why->findChild<QLineEdit*>(), Qt::Key_Return);
    window()->activateWindow();
    ASSERT_TRUE(eventually([] { return the<QPushButton>("reportSign")->isVisible() && formIsReady(); })) << warning();
    ASSERT_NO_FATAL_FAILURE(sayRead(0, "9"));
    ASSERT_TRUE(eventually([] { return the<QPushButton>("reportSign")->isEnabled(); }));
    ASSERT_NO_FATAL_FAILURE(signIt());
    screenshot("amended");
    EXPECT_EQ(warning(), "");
}

void StudyWalk::closeAndReopen()
{
    jumpTo(length() * 0.45);
    auto* level = the<QComboBox>("window");
    level->setFocus();
    QTest::keyClick(level, Qt::Key_Down);
    const QString chosen = level->currentText();
    const QString seen = the<QLabel>("seen")->text(), about = the<QPushButton>("about")->text();
    const double at = station();
    const auto before = stored(case_id_.c_str());
    closeCase();
    openCase(patient_id_.c_str());
    EXPECT_NEAR(station(), at, 1);
    EXPECT_EQ(the<QPushButton>("about")->text(), about) << "the way it was flown last";
    EXPECT_EQ(the<QComboBox>("window")->currentText(), chosen);
    EXPECT_EQ(the<QSlider>("speed")->value(), the<QSlider>("speed")->maximum());
    EXPECT_GE(the<QLabel>("seen")->text().section(' ', 0, 0).toDouble(), seen.section(' ', 0, 0).toDouble());
    ASSERT_TRUE(eventually([&] { return markers()->rowCount() == int(before.size()); }));
    constexpr int kNote = 6;
    for (int row = 0; row < int(before.size()); ++row) {
        EXPECT_EQ(cell(row, 0).toStdString(), before[std::size_t(row)].id);
        EXPECT_EQ(cell(row, kNote).toStdString(), before[std::size_t(row)].note);
    }
    EXPECT_EQ(cell(0, kNote), "sessile, on a fold");
    EXPECT_NE(cell(0, 5), "") << "its size";
    screenshot("reopened");
}

}  // namespace vicon::viewer::test
